#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::vulkan {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

constexpr auto kCopies = Stage::eCopy | Stage::eBlit;
constexpr auto kDepthTests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;

struct ImageAccess {
    vk::ImageLayout layout;
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 reads;
    vk::AccessFlags2 writes;
};

ImageAccess access_of(Use use) {
    switch (use) {
        case Use::ColorTarget:
            return {vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                    Access::eColorAttachmentRead, Access::eColorAttachmentWrite};
        case Use::DepthTarget:
            return {vk::ImageLayout::eDepthStencilAttachmentOptimal, kDepthTests,
                    Access::eDepthStencilAttachmentRead, Access::eDepthStencilAttachmentWrite};
        case Use::Sampled:
            return {vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
                    Access::eShaderSampledRead, Access::eNone};
        case Use::Loaded:
            return {vk::ImageLayout::eGeneral, Stage::eFragmentShader, Access::eShaderStorageRead,
                    Access::eNone};
        case Use::CopySource:
            return {vk::ImageLayout::eTransferSrcOptimal, kCopies, Access::eTransferRead,
                    Access::eNone};
        case Use::CopyTarget:
            return {vk::ImageLayout::eTransferDstOptimal, kCopies, Access::eNone,
                    Access::eTransferWrite};
    }
    return {};
}

}  // namespace

TrackedImage TrackedImage::in_use(vk::Image image, vk::ImageAspectFlags aspect, Use last) {
    TrackedImage tracked(image, aspect);
    const ImageAccess access = access_of(last);
    tracked.layout_ = access.layout;
    tracked.stages_ = access.stages;
    tracked.writes_ = access.writes;
    return tracked;
}

TrackedImage TrackedImage::of_earlier_frames(vk::Image image, vk::ImageAspectFlags aspect) {
    TrackedImage tracked(image, aspect);
    const bool depth = static_cast<bool>(aspect & vk::ImageAspectFlagBits::eDepth);
    const ImageAccess target = access_of(depth ? Use::DepthTarget : Use::ColorTarget);
    tracked.stages_ = target.stages | kCopies;
    tracked.writes_ = target.writes;
    return tracked;
}

void TrackedImage::use(const vk::raii::CommandBuffer& commands, Use next, Keep keep) {
    const ImageAccess to = access_of(next);
    if (layout_ == to.layout && !writes_ && !to.writes && keep == Keep::Content) {
        stages_ |= to.stages;
        return;
    }
    const vk::ImageMemoryBarrier2 barrier(
        stages_, writes_, to.stages, to.reads | to.writes,
        keep == Keep::Content ? layout_ : vk::ImageLayout::eUndefined, to.layout,
        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image_, {aspect_, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    layout_ = to.layout;
    stages_ = to.stages;
    writes_ = to.writes;
}

}  // namespace gazeloop::vulkan
