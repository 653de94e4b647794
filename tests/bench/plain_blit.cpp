#include "tests/bench/plain_blit.h"

#include <array>

#include "runtime/render/passes/log_polar_eye.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

vk::raii::Semaphore make_timeline_semaphore(const vulkan::Context& context) {
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    return {context.device(), vk::SemaphoreCreateInfo({}, &timeline)};
}

std::array<vk::Offset3D, 2> whole(vk::Extent2D extent) {
    return {vk::Offset3D(0, 0, 0), vk::Offset3D(static_cast<std::int32_t>(extent.width),
                                                static_cast<std::int32_t>(extent.height), 1)};
}

}  // namespace

PlainBlit::PlainBlit(const vulkan::Context& context, vk::Extent2D from, vk::Extent2D to,
                     vk::Format format)
    : context_(&context),
      recorder_(context, passes_, true),
      clock_(context),
      from_(context, from, render::kLpFormat,
            vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst |
                vk::ImageUsageFlagBits::eColorAttachment),
      to_(context, to, format,
          vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eColorAttachment),
      from_use_(from_.image(), vk::ImageAspectFlagBits::eColor),
      to_use_(to_.image(), vk::ImageAspectFlagBits::eColor),
      done_(make_timeline_semaphore(context)) {
    recorder_.reset();
    const vk::raii::CommandBuffer& commands = recorder_.begin_untimed();
    from_use_.use(commands, vulkan::Use::CopyTarget, vulkan::Keep::Nothing);
    commands.clearColorImage(
        from_.image(), from_use_.layout(),
        vk::ClearColorValue(std::array<float, 4>{0.5F, 0.25F, 0.125F, 1.0F}),
        vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1));
    from_use_.use(commands, vulkan::Use::CopySource);
    recorder_.submit(*done_, ++rounds_);
    context_->device().waitIdle();
}

void PlainBlit::round(bool keep) {
    recorder_.reset();
    const vk::raii::CommandBuffer& commands = recorder_.begin("blit");
    to_use_.use(commands, vulkan::Use::CopyTarget, vulkan::Keep::Nothing);
    const vk::ImageSubresourceLayers color(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
    commands.blitImage(from_.image(), from_use_.layout(), to_.image(), to_use_.layout(),
                       vk::ImageBlit(color, whole(from_.extent()), color, whole(to_.extent())),
                       vk::Filter::eLinear);
    recorder_.submit(*done_, ++rounds_);
    context_->device().waitIdle();
    frame::FrameGpuRecord record;
    recorder_.collect(clock_, record);
    if (const auto ns = record.passes[0]; keep && ns) {
        ms_.push_back(static_cast<double>(*ns) * 1e-6);
    }
}

double PlainBlit::median_ms() const { return median(ms_); }

}  // namespace gazeloop::bench
