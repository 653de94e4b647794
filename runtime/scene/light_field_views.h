#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "runtime/light_field/lens.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/light_field_memory.h"
#include "runtime/scene/light_field_storage.h"
#include "runtime/scene/view_stream.h"
#include "runtime/scene/view_waits.h"
#include "runtime/vulkan/layered_image.h"

namespace gazeloop::scene {

/// The pictures of a light field on the GPU: all of them, or, where they do not fit, those that the
/// last frames asked for, and that the next ones may. The others then wait decoded in a scratch
/// file.
class LightFieldViews {
  public:
    /// Reads all views. Throws SetupError: (BadInput) those of the source; what does not fit
    /// (choose_storage), or that the device cannot hold or decompress; a scratch file's; (NoDevice)
    /// no memory.
    LightFieldViews(const vulkan::Context& context, const LightFieldSource& source,
                    const light_field::Lens& lens, const LightFieldMemory& memory);

    /// An array; view `layer_of(v)` of it is v's picture.
    [[nodiscard]] vk::ImageView image() const { return image_.view(); }

    /// Whether there is something to fetch_ahead().
    [[nodiscard]] bool fetches_ahead() const { return storage_.ahead > 0; }

    /// Loads what is missing of a frame's views, for which it waits until they are read: what is
    /// submitted after this sees them, what was before keeps its own. Throws SetupError (BadInput)
    /// where the scratch file cannot be read.
    void bring(std::span<const std::uint32_t> wanted);
    /// Begins to load what the next frames may ask for, the likeliest first; nothing where that is
    /// not done.
    void fetch_ahead(std::span<const std::uint32_t> likely);

    /// Precondition: the last bring() was asked for the view.
    [[nodiscard]] std::uint32_t layer_of(std::uint32_t view) const {
        return stream_ ? stream_->layer_of(view) : view;
    }

    /// What it takes of the GPU's memory.
    [[nodiscard]] std::uint64_t memory_bytes() const;

    [[nodiscard]] ViewWaits waits() const { return stream_ ? stream_->waits() : ViewWaits{}; }
    /// Which share of the views is resident, and what was loaded until now; none: all are.
    [[nodiscard]] std::optional<std::string> account() const;

  private:
    void load_all(const vulkan::Context& context, const LightFieldSource& source,
                  const LightFieldSource::Prepare& prepare);

    std::uint64_t view_bytes_;
    std::uint32_t views_;
    LightFieldStorage storage_;
    vulkan::LayeredImage image_;
    std::optional<ViewStream> stream_;  ///< none: all are resident, each in the layer of its number
};

}  // namespace gazeloop::scene
