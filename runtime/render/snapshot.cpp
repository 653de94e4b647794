#include "runtime/render/snapshot.h"

#include <fmt/core.h>

#include <limits>
#include <system_error>

#include "runtime/render/picture.h"

namespace gazeloop::render {
namespace {

/// Cells that the plan left out hold anything: they are painted black.
void blacken_unshaded(Picture& picture, const foveation::ShadedGrid& grid) {
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        const foveation::Columns& band = grid.bands[y / foveation::kBandRows];
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            if (x < band.first || x >= band.end) {
                picture.pixels[std::size_t{y} * picture.width + x] = {};
            }
        }
    }
}

}  // namespace

Picture picture_of(const vulkan::Context& context, const BufferPicture& buffer) {
    Picture picture = read_back(context, buffer.image->image(), buffer.image->extent(),
                                buffer.image->format(), vk::ImageLayout::eShaderReadOnlyOptimal);
    blacken_unshaded(picture, *buffer.grid);
    return picture;
}

Expected<void> make_snapshot_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("--snapshot {}: the folder cannot be made ({})",
                                                   folder.string(), failure.message())});
    }
    return {};
}

Snapshot::Snapshot(const vulkan::Context& context, const FrameRenderer& renderer)
    : context_(&context), renderer_(&renderer) {
    const vk::raii::Device& device = context.device();
    const RendererConfig& config = renderer.config();
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        copies_[e] = vulkan::ColorImage(
            context, config.extents[e], config.format,
            vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc |
                vk::ImageUsageFlagBits::eSampled);  // views need a use besides copies
    }
    pool_ = vk::raii::CommandPool(
        device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                          context.queue_family()));
    commands_ = std::move(vk::raii::CommandBuffers(
        device, vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1))[0]);
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    copied_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));
}

void Snapshot::on_rendered(const FrameView& view, const gaze::FrameFovea& fovea) {
    // The last copy's commands are in use until it is done.
    if (copies_made_ > 0) {
        (void)context_->device().waitSemaphores(vk::SemaphoreWaitInfo({}, *copied_, copies_made_),
                                                std::numeric_limits<std::uint64_t>::max());
    }
    pool_.reset();
    commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    using Stage = vk::PipelineStageFlagBits2;
    constexpr auto kColor = vk::ImageAspectFlagBits::eColor;
    using vulkan::Use;
    const vk::ImageSubresourceLayers layers(kColor, 0, 0, 1);
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        auto shown = vulkan::TrackedImage::in_use(view.targets[e].image, kColor, Use::ColorTarget);
        auto copy = vulkan::TrackedImage::in_use(copies_[e].image(), kColor, Use::CopyTarget);
        shown.use(commands_, Use::CopySource);
        copy.use(commands_, Use::CopyTarget, vulkan::Keep::Nothing);
        commands_.copyImage(
            shown.image(), shown.layout(), copy.image(), copy.layout(),
            vk::ImageCopy(layers, {}, layers, {}, vk::Extent3D(copies_[e].extent(), 1)));
        shown.use(commands_, Use::ColorTarget);
    }
    commands_.end();
    const vk::CommandBufferSubmitInfo buffer(*commands_);
    const vk::SemaphoreSubmitInfo done(*copied_, ++copies_made_, Stage::eAllCommands);
    context_->queue().submit2(vk::SubmitInfo2({}, 0, nullptr, 1, &buffer, 1, &done));
    last_ = {view, fovea};
}

Expected<std::vector<std::filesystem::path>> Snapshot::write(OffScreen* full,
                                                             const SnapshotOptions& options) const {
    if (const auto made = make_snapshot_folder(options.folder); !made) {
        return std::unexpected(made.error());
    }
    context_->device().waitIdle();
    if (full != nullptr) {
        full->render(last_->view, last_->fovea);
    }
    std::vector<std::filesystem::path> files;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const auto write = [&](const Picture& picture, std::string_view what) {
            files.push_back(options.folder / fmt::format("{}-{}.png", gaze::kEyeNames[e], what));
            return write_png(picture, files.back());
        };
        const auto write_marked = [&](Picture picture, std::string_view what) {
            if (options.mark_fovea) {
                const double ring_px = renderer_->last_plan(eye).ring_px;
                mark_fovea(picture, last_->fovea.eyes[e].position,
                           ring_px > 0.0 ? ring_px : kRingWithoutDisc_px);
            }
            return write(picture, what);
        };
        const Picture shown = read_back(*context_, copies_[e].image(), copies_[e].extent(),
                                        copies_[e].format(), vk::ImageLayout::eTransferDstOptimal);
        auto written = write_marked(full != nullptr ? full->picture(eye) : shown, "full");
        if (full != nullptr && written) {
            written = write_marked(shown, "result");
        }
        for (const BufferPicture& buffer : renderer_->buffers(eye)) {
            written = written ? write(picture_of(*context_, buffer), buffer.name) : written;
        }
        if (full != nullptr && written) {
            written = write_marked(
                amplified_difference(shown, full->picture(eye), options.difference_gain),
                "difference");
        }
        if (!written) {
            return std::unexpected(written.error());
        }
    }
    return files;
}

}  // namespace gazeloop::render
