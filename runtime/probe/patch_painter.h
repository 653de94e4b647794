#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/render/frame_view.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::probe {

/// Where the patch lies: a square straight ahead, where the display is sharpest and its rows lie
/// near the middle, a quarter of the picture's shorter side wide; cut where it reaches out of the
/// picture. Precondition: is_valid(view).
[[nodiscard]] vk::Rect2D patch_area(const gaze::EyeView& view);

/// A square about where that direction (unit, in the eye's view frame) is seen, `share` of the
/// picture's shorter side wide; cut as above, so that it may be empty. Precondition: as above.
[[nodiscard]] vk::Rect2D patch_area(const gaze::EyeView& view, const glm::dvec3& direction,
                                    double share);

/// Paints a white or black patch over both eyes' finished pictures, in a submit of its own after
/// the frame's last pass, so that it can still follow the last look at the gaze whatever the method
/// draws.
class PatchPainter {
  public:
    /// The context must outlive this. `in_flight`: frames that the GPU may have unfinished.
    PatchPainter(const vulkan::Context& context, std::uint32_t in_flight);
    PatchPainter(const PatchPainter&) = delete;
    PatchPainter& operator=(const PatchPainter&) = delete;
    ~PatchPainter();

    /// The pictures lie in COLOR_ATTACHMENT_OPTIMAL, and are left there. Allocates nothing. Throws
    /// vk::SystemError.
    void paint(const render::FrameView& view, bool white);
    /// The same in these parts of the pictures, each in one grey: 0 black .. 1 white.
    struct Patch {
        gaze::PerEye<vk::Rect2D> areas;
        float light = 0.0F;
    };
    void paint(const render::FrameView& view, std::span<const Patch> patches);

  private:
    struct Slot {
        vk::raii::CommandPool pool{nullptr};
        vk::raii::CommandBuffer commands{nullptr};
    };

    const vulkan::Context* context_;
    vk::raii::Semaphore painted_{nullptr};  ///< frames painted
    std::uint64_t submitted_ = 0;           ///< frames; the timeline's value
    std::vector<Slot> slots_;
};

}  // namespace gazeloop::probe
