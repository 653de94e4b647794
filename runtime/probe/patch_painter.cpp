#include "runtime/probe/patch_painter.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/gaze/direction.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::probe {

vk::Rect2D patch_area(const gaze::EyeView& view) {
    constexpr double kShare = 0.25;
    return patch_area(view, gaze::kStraightAhead, kShare);
}

vk::Rect2D patch_area(const gaze::EyeView& view, const glm::dvec3& direction, double share) {
    const gaze::PixelPosition middle = gaze::project(direction, view);
    const double half = std::max(1.0, 0.5 * share * std::min(view.width_px, view.height_px));
    const auto clamped = [](double px, std::uint32_t size) {
        return static_cast<std::uint32_t>(
            std::clamp(std::round(px), 0.0, static_cast<double>(size)));
    };
    const std::uint32_t left = clamped(middle.x_px - half, view.width_px);
    const std::uint32_t right = clamped(middle.x_px + half, view.width_px);
    const std::uint32_t top = clamped(middle.y_px - half, view.height_px);
    const std::uint32_t bottom = clamped(middle.y_px + half, view.height_px);
    return {{static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
            {right - left, bottom - top}};
}

PatchPainter::PatchPainter(const vulkan::Context& context, std::uint32_t in_flight)
    : context_(&context), slots_(in_flight + 1) {
    const vk::raii::Device& device = context.device();
    for (Slot& slot : slots_) {
        slot.pool = vk::raii::CommandPool(
            device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                              context.queue_family()));
        slot.commands = std::move(vk::raii::CommandBuffers(
            device,
            vk::CommandBufferAllocateInfo(*slot.pool, vk::CommandBufferLevel::ePrimary, 1))[0]);
    }
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    painted_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));
}

PatchPainter::~PatchPainter() {
    try {
        context_->device().waitIdle();
    } catch (const vk::SystemError& error) {
        spdlog::debug("the patch ends on a lost device ({})", error.what());
    }
}

void PatchPainter::paint(const render::FrameView& view, bool white) {
    const Patch patch{{patch_area(view.views[0]), patch_area(view.views[1])}, white ? 1.0F : 0.0F};
    paint(view, {&patch, 1});
}

void PatchPainter::paint(const render::FrameView& view, std::span<const Patch> patches) {
    if (submitted_ >= slots_.size()) {
        // The loop has waited for that frame's passes; the patch that follows them takes no time.
        const std::uint64_t oldest = submitted_ - slots_.size() + 1;
        (void)context_->device().waitSemaphores(vk::SemaphoreWaitInfo({}, *painted_, oldest),
                                                std::numeric_limits<std::uint64_t>::max());
    }
    Slot& slot = slots_[submitted_ % slots_.size()];
    slot.pool.reset();
    slot.commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    using vulkan::Use;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        for (const auto& [areas, light] : patches) {
            if (areas[e].extent.width == 0 || areas[e].extent.height == 0) {
                continue;
            }
            auto shown = vulkan::TrackedImage::in_use(
                view.targets[e].image, vk::ImageAspectFlagBits::eColor, Use::ColorTarget);
            shown.use(slot.commands, Use::ColorTarget);
            const vk::RenderingAttachmentInfo attachment(
                view.targets[e].view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
                vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                vk::ClearColorValue(std::array{light, light, light, 1.0F}));
            slot.commands.beginRendering(vk::RenderingInfo({}, areas[e], 1, 0, attachment));
            slot.commands.endRendering();
        }
    }
    slot.commands.end();
    const vk::CommandBufferSubmitInfo buffer(*slot.commands);
    const vk::SemaphoreSubmitInfo done(*painted_, ++submitted_,
                                       vk::PipelineStageFlagBits2::eAllCommands);
    context_->queue().submit2(vk::SubmitInfo2({}, {}, buffer, done));
}

}  // namespace gazeloop::probe
