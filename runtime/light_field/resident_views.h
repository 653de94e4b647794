#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gazeloop::light_field {

/// Which views of a light field have a layer of the GPU's memory, where there are fewer layers than
/// views. A frame's views come in as it asks for them, and take the layers of those that were asked
/// for longest ago. What is resident follows from the requests alone, so that a replay loads what
/// its run did.
class ResidentViews {
  public:
    struct Load {
        std::uint32_t view = 0;
        std::uint32_t layer = 0;
    };

    /// None is resident. Precondition: 1 <= layers <= views.
    ResidentViews(std::uint32_t views, std::uint32_t layers);

    /// Makes `wanted`, in which a view may be more than once, resident and returns what must be
    /// loaded for that, in the order of the request; valid until the next one. Precondition: no
    /// more different views than there are layers.
    [[nodiscard]] std::span<const Load> request(std::span<const std::uint32_t> wanted);

    /// Precondition: the last request asked for the view, or it is resident still.
    [[nodiscard]] std::uint32_t layer_of(std::uint32_t view) const { return layer_of_[view]; }
    [[nodiscard]] bool is_resident(std::uint32_t view) const { return layer_of_[view] != kNone; }

  private:
    static constexpr std::uint32_t kNone = ~0U;
    [[nodiscard]] std::uint32_t make_room();

    std::vector<std::uint32_t> layer_of_;  ///< by view
    std::vector<std::uint32_t> view_in_;   ///< by layer; kNone: free
    std::vector<std::uint64_t> asked_;     ///< by view: the last request that asked for it
    std::uint64_t request_ = 0;
    std::vector<Load> loads_;
};

}  // namespace gazeloop::light_field
