#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/light_field/resident_views.h"
#include "runtime/memory/read_ahead.h"
#include "runtime/memory/scratch_file.h"
#include "runtime/scene/light_field_storage.h"
#include "runtime/scene/view_waits.h"
#include "runtime/vulkan/layer_uploads.h"
#include "runtime/vulkan/layered_image.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::scene {

/// Brings views of a light field from a scratch file into the layers of an image: for a frame that
/// waits for them until they are read, or ahead, while other frames are drawn, on a thread that
/// reads. No frame waits for the device, but where it needs more views at once than may be on their
/// way there. Which views are in which layers follows from what is asked of it, however fast the
/// thread is.
class ViewStream {
  public:
    /// View v begins at v * view_bytes of the file. The image must outlive this.
    ViewStream(const vulkan::Context& context, const vulkan::LayeredImage& image,
               memory::ScratchFile file, std::uint32_t views, std::uint64_t view_bytes,
               const LightFieldStorage& storage);

    /// What is submitted after this finds a frame's views in their layers; what was before, what it
    /// did. Throws SetupError (BadInput) where the file cannot be read.
    void bring(std::span<const std::uint32_t> wanted);
    /// Begins to fetch what the next frames may want, the likeliest first, into layers that the
    /// last wanted views do not take.
    void fetch_ahead(std::span<const std::uint32_t> likely);

    /// Precondition: the last bring() was asked for the view.
    [[nodiscard]] std::uint32_t layer_of(std::uint32_t view) const {
        return resident_.layer_of(view);
    }

    /// Of the buffer that views are copied from.
    [[nodiscard]] std::uint64_t memory_bytes() const { return staging_.size(); }
    [[nodiscard]] const ViewWaits& waits() const { return waits_; }
    /// For people.
    [[nodiscard]] std::string account() const;

  private:
    /// A place for one view in the buffer.
    struct Place {
        std::uint64_t upload = 0;  ///< that copied from it last
        bool taken = false;        ///< a view is being read into it, or waits in it to be copied
    };
    /// A view that was fetched ahead and is not in its layer yet.
    struct OnItsWay {
        light_field::ResidentViews::Load load;
        std::optional<std::uint32_t> place{};  ///< none: nobody reads it yet
        bool unreadable = false;  ///< the thread could not: whoever asks for it finds out why
        bool gone = false;        ///< its layer was given to another
    };

    void begin_to_read();
    void drop_what_went();
    [[nodiscard]] std::uint64_t collect();
    void read(const light_field::ResidentViews::Load& load);
    void stage(std::uint32_t layer, std::uint32_t place);
    void submit_staged();
    [[nodiscard]] std::uint32_t oldest_place() const;
    [[nodiscard]] std::uint32_t free_place();
    [[nodiscard]] std::span<std::byte> memory_of(std::uint32_t place) const {
        return staging_.mapped().subspan(place * view_bytes_, view_bytes_);
    }

    const vulkan::LayeredImage& image_;
    std::uint64_t view_bytes_;
    LightFieldStorage storage_;
    std::uint32_t views_;
    memory::ScratchFile file_;
    vulkan::HostBuffer staging_;
    light_field::ResidentViews resident_;
    std::vector<Place> places_;
    std::vector<OnItsWay> on_their_way_;
    std::vector<vulkan::LayerSource> staged_;
    ViewWaits waits_;
    vulkan::LayerUploads uploads_;
    std::optional<memory::ReadAhead> thread_;  ///< ends before what it reads into
};

}  // namespace gazeloop::scene
