#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/light_field/lens.h"
#include "runtime/light_field/resident_views.h"
#include "runtime/memory/scratch_file.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/light_field_memory.h"
#include "runtime/scene/light_field_storage.h"
#include "runtime/vulkan/layered_image.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::scene {

/// The pictures of a light field on the GPU: all of them, or, where they do not fit, those that the
/// last frames asked for. The others then wait decoded in a scratch file.
class LightFieldViews {
  public:
    /// Reads all views. Throws SetupError: (BadInput) those of the source; what does not fit
    /// (choose_storage), or that the device cannot hold or decompress; a scratch file's; (NoDevice)
    /// no memory.
    LightFieldViews(const vulkan::Context& context, const LightFieldSource& source,
                    const light_field::Lens& lens, const LightFieldMemory& memory);

    /// An array; view `layer_of(v)` of it is v's picture.
    [[nodiscard]] vk::ImageView image() const { return image_.view(); }

    /// Loads what is missing of a frame's views, and waits for it: frames that were submitted
    /// before keep theirs. Throws SetupError (BadInput) where the scratch file cannot be read.
    void bring(std::span<const std::uint32_t> wanted);

    /// Precondition: the last bring() was asked for the view.
    [[nodiscard]] std::uint32_t layer_of(std::uint32_t view) const {
        return resident_.layer_of(view);
    }

    /// What it takes of the GPU's memory.
    [[nodiscard]] std::uint64_t memory_bytes() const;

    /// Which share of the views is resident, and what was loaded until now; none: all are.
    [[nodiscard]] std::optional<std::string> account() const;

  private:
    /// Copies what staging holds into layers.
    void flush(std::vector<vulkan::LayerSource>& staged) const;

    const vulkan::Context& context_;
    std::uint64_t view_bytes_;
    std::uint32_t views_;
    LightFieldStorage storage_;
    vulkan::LayeredImage image_;
    vulkan::HostBuffer staging_;
    std::optional<memory::ScratchFile> scratch_;
    light_field::ResidentViews resident_;

    std::uint64_t loaded_ = 0;
    std::uint64_t waiting_frames_ = 0;
    std::uint64_t most_in_a_frame_ = 0;
};

}  // namespace gazeloop::scene
