#include "runtime/preview/preview_feed.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "runtime/render/picture.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::preview {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

std::uint32_t reduction_of(const gaze::PerEye<vk::Extent2D>& extents) {
    std::uint32_t longest = 1;
    for (const vk::Extent2D& extent : extents) {
        longest = std::max({longest, extent.width, extent.height});
    }
    return (longest + kMaxSidePx - 1) / kMaxSidePx;
}

vk::Extent2D reduced(const vk::Extent2D& extent, std::uint32_t reduction) {
    return {(extent.width + reduction - 1) / reduction,
            (extent.height + reduction - 1) / reduction};
}

bool shows(std::uint32_t eyes, std::size_t eye) { return (eyes & (1U << eye)) != 0; }

vk::ArrayWrapper1D<vk::Offset3D, 2> corners(const vk::Extent2D& extent) {
    return std::array<vk::Offset3D, 2>{vk::Offset3D(0, 0, 0),
                                       vk::Offset3D(static_cast<std::int32_t>(extent.width),
                                                    static_cast<std::int32_t>(extent.height), 1)};
}

}  // namespace

PreviewFeed::PreviewFeed(const vulkan::Context& context, const Options& options,
                         PreviewMemory& memory)
    : context_(&context),
      options_(options),
      memory_(&memory),
      reduction_(reduction_of(options.extents)) {
    const vk::raii::Device& device = context.device();
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const vk::Extent2D extent = reduced(options.extents[e], reduction_);
        eyes_[e].reduced = vulkan::ColorImage(
            context, extent, options.format,
            // A view must be of some use; this one is never drawn to.
            vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc |
                vk::ImageUsageFlagBits::eColorAttachment);
        eyes_[e].pixels = vulkan::HostBuffer(
            context, vk::DeviceSize{extent.width} * extent.height * kBytesPerPixel,
            vk::BufferUsageFlagBits::eTransferDst);
    }
    next_.blue_first =
        options.format == vk::Format::eB8G8R8A8Srgb || options.format == vk::Format::eB8G8R8A8Unorm;
    pool_ = vk::raii::CommandPool(
        device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                          context.queue_family()));
    commands_ = std::move(vk::raii::CommandBuffers(
        device, vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1))[0]);
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    copied_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));
    thread_ = std::jthread([this](const std::stop_token& stop) { hand_over(stop); });
}

PreviewFeed::~PreviewFeed() {
    thread_.request_stop();
    known_ = std::numeric_limits<std::uint64_t>::max();  // wakes it up
    known_.notify_all();
    thread_.join();
    try {
        // The last copy may still be on the GPU.
        context_->device().waitIdle();
    } catch (const vk::SystemError& error) {
        spdlog::debug("the preview ends on a lost device ({})", error.what());
    }
}

bool PreviewFeed::wanted() const {
    // Every submitted copy has been given by the time that the window asks for one more.
    const std::uint64_t given = memory_->given.load(std::memory_order_acquire);
    return given == copies_ && memory_->asked.load(std::memory_order_acquire) != given;
}

void PreviewFeed::submitted() {
    known_.store(++copies_, std::memory_order_release);
    known_.notify_one();
}

void PreviewFeed::on_rendered(const render::FrameView& view, const gaze::FrameFovea& fovea) {
    if (!wanted()) {
        ++dropped_;
        return;
    }
    const std::uint32_t eyes = memory_->eyes & kBothEyes;
    black_ = false;
    describe(view.index, &fovea, eyes);
    record_copy(view, eyes);
    submitted();
}

/// Black frames follow each other alike, so the window is given a new one whenever it asks: that
/// keeps its title and bars going.
void PreviewFeed::show_black(std::uint64_t frame) {
    if (!wanted()) {
        ++dropped_;
        return;
    }
    black_ = true;
    describe(frame, nullptr, memory_->eyes & kBothEyes);
    context_->device().signalSemaphore(vk::SemaphoreSignalInfo(*copied_, copies_ + 1));
    submitted();
}

void PreviewFeed::describe(std::uint64_t frame, const gaze::FrameFovea* fovea, std::uint32_t eyes) {
    next_.index = frame;
    next_.bars = bars_;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        if (!shows(eyes, e)) {
            next_.pictures[e] = {};
            continue;
        }
        const vk::Extent2D extent = eyes_[e].reduced.extent();
        next_.pictures[e] = {.width_px = extent.width, .height_px = extent.height};
        if (fovea == nullptr) {
            continue;
        }
        const double radius_px = options_.ring_radius_px(eye);
        const auto in_preview = [this](double px) {
            return static_cast<float>(px / static_cast<double>(reduction_));
        };
        const gaze::PixelPosition& position = fovea->eyes[e].position;
        next_.pictures[e].fovea_x_px = in_preview(position.x_px);
        next_.pictures[e].fovea_y_px = in_preview(position.y_px);
        next_.pictures[e].ring_radius_px =
            in_preview(radius_px > 0.0 ? radius_px : render::kRingWithoutDisc_px);
    }
}

void PreviewFeed::record_copy(const render::FrameView& view, std::uint32_t eyes) {
    pool_.reset();
    commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        if (!shows(eyes, e)) {
            continue;
        }
        constexpr auto kColor = vk::ImageAspectFlagBits::eColor;
        using vulkan::Use;
        auto shown = vulkan::TrackedImage::in_use(view.targets[e].image, kColor, Use::ColorTarget);
        auto reduced =
            vulkan::TrackedImage::in_use(eyes_[e].reduced.image(), kColor, Use::CopySource);
        const vk::Extent2D extent = eyes_[e].reduced.extent();
        shown.use(commands_, Use::CopySource);
        reduced.use(commands_, Use::CopyTarget, vulkan::Keep::Nothing);
        const vk::ImageSubresourceLayers layers(kColor, 0, 0, 1);
        commands_.blitImage(
            shown.image(), shown.layout(), reduced.image(), reduced.layout(),
            vk::ImageBlit(layers, corners(options_.extents[e]), layers, corners(extent)),
            reduction_ > 1 ? vk::Filter::eLinear : vk::Filter::eNearest);
        shown.use(commands_, Use::ColorTarget);
        reduced.use(commands_, Use::CopySource);
        commands_.copyImageToBuffer(
            reduced.image(), reduced.layout(), eyes_[e].pixels.buffer(),
            vk::BufferImageCopy(0, 0, 0, layers, {}, vk::Extent3D(extent, 1)));
    }
    const vk::MemoryBarrier2 to_host(Stage::eCopy, Access::eTransferWrite, Stage::eHost,
                                     Access::eHostRead);
    commands_.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    commands_.end();
    const vk::CommandBufferSubmitInfo info(*commands_);
    const vk::SemaphoreSubmitInfo done(*copied_, copies_ + 1, Stage::eAllCommands);
    context_->queue().submit2(vk::SubmitInfo2({}, {}, info, done));
}

void PreviewFeed::on_frame(const frame::FrameRecord& record) {
    frames_[record.index % frames_.size()] = record;
    if (!record.should_render) {
        show_black(record.index);
    }
}

void PreviewFeed::on_gpu(const frame::FrameGpuRecord& record) {
    const frame::FrameRecord& frame = frames_[record.index % frames_.size()];
    if (frame.index == record.index) {
        bars_ = stage_bars(frame, record, options_.passes, options_.display);
    }
}

/// On the feed's own thread. It reads `next_` and the buffers only between a submit and `given`,
/// when the loop's thread leaves them alone.
void PreviewFeed::hand_over(const std::stop_token& stop) {
    for (std::uint64_t copy = 1;; ++copy) {
        known_.wait(copy - 1, std::memory_order_acquire);
        if (stop.stop_requested()) {
            return;
        }
        try {
            const vk::Result finished =
                context_->device().waitSemaphores(vk::SemaphoreWaitInfo({}, *copied_, copy),
                                                  std::numeric_limits<std::uint64_t>::max());
            if (finished != vk::Result::eSuccess) {
                return;
            }
        } catch (const vk::SystemError&) {
            return;  // the loop meets the lost device itself, and says so
        }
        memory_->frame = next_;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            if (next_.pictures[e].width_px == 0) {
                continue;
            }
            const std::span<const std::byte> pixels = eyes_[e].pixels.mapped();
            if (black_) {
                std::fill_n(memory_->pixels[e].begin(), pixels.size(), std::byte{0});
            } else {
                std::memcpy(memory_->pixels[e].data(), pixels.data(), pixels.size());
            }
        }
        memory_->given.store(copy, std::memory_order_release);
    }
}

}  // namespace gazeloop::preview
