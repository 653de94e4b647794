#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gazeloop::light_field {

/// Which views of a light field have a layer of the GPU's memory, where there are fewer layers than
/// views. A frame's views come in as it asks for them, and take the layers of those that were asked
/// for longest ago; between frames, others come in ahead. What is resident follows from the
/// requests alone, so that a replay loads what its run did.
class ResidentViews {
  public:
    struct Load {
        std::uint32_t view = 0;
        std::uint32_t layer = 0;
    };

    /// None is resident. Precondition: 1 <= layers <= views.
    ResidentViews(std::uint32_t views, std::uint32_t layers);

    /// Makes `wanted`, in which a view may be more than once, resident and returns what must be
    /// loaded for that, in the order of the request; valid until the next call. Precondition: no
    /// more different views than there are layers.
    [[nodiscard]] std::span<const Load> request(std::span<const std::uint32_t> wanted);

    /// Makes up to `most` of the views resident that may be asked for next, the likeliest first,
    /// and returns what must be loaded for that; valid until the next call. They take no layer of a
    /// view that the last request asked for, or that is likelier. Once after a request.
    [[nodiscard]] std::span<const Load> fetch_ahead(std::span<const std::uint32_t> likely,
                                                    std::uint32_t most);

    /// Precondition: the view is resident, as those are that the last request asked for.
    [[nodiscard]] std::uint32_t layer_of(std::uint32_t view) const { return layer_of_[view]; }
    [[nodiscard]] bool is_resident(std::uint32_t view) const { return layer_of_[view] != kNone; }
    /// Whether the last request asked for the view.
    [[nodiscard]] bool is_wanted(std::uint32_t view) const {
        return asked_[view] == stamp_of_request();
    }

    /// Views that fetch_ahead() loaded until now, and those of them that a request asked for before
    /// they had gone again.
    [[nodiscard]] std::uint64_t fetched() const { return fetched_; }
    [[nodiscard]] std::uint64_t fetched_and_wanted() const { return fetched_and_wanted_; }

  private:
    static constexpr std::uint32_t kNone = ~0U;
    /// When a view was asked for: requests count by twos, so that what is only likely after one
    /// comes between what it asked for and what any before it did.
    [[nodiscard]] std::uint64_t stamp_of_request() const { return 2 * request_ + 1; }
    [[nodiscard]] std::uint64_t stamp_of_likely() const { return 2 * request_; }
    [[nodiscard]] std::uint32_t layer_to_free() const;
    void load(std::uint32_t view, std::uint32_t layer);

    std::vector<std::uint32_t> layer_of_;  ///< by view
    std::vector<std::uint32_t> view_in_;   ///< by layer; kNone: free
    std::vector<std::uint64_t> asked_;     ///< by view: the stamp of when it was asked for last
    std::vector<bool> ahead_;              ///< by view: fetched ahead, and not asked for since
    std::uint64_t request_ = 0;
    std::uint64_t fetched_ = 0;
    std::uint64_t fetched_and_wanted_ = 0;
    std::vector<Load> loads_;
};

}  // namespace gazeloop::light_field
