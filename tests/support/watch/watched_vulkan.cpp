#include "tests/support/watch/watched_vulkan.h"

#include "tests/support/watch/watched_call.h"

namespace gazeloop::tests {
namespace {

using Dispatcher = vk::raii::DeviceDispatcher;

/// Stands in for one function of the device.
template <auto Member>
struct Watched;
template <typename Result, typename... Arguments,
          Result (VKAPI_PTR* Dispatcher::*Member)(Arguments...)>
struct Watched<Member> {
    static inline Result(VKAPI_PTR* original)(Arguments...) = nullptr;

    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
        mark_vulkan();
        const WatchedCall watched;
        return original(arguments...);
    }
    static void install(Dispatcher& dispatcher) {
        if (dispatcher.*Member != nullptr && dispatcher.*Member != &call) {
            original = dispatcher.*Member;
            dispatcher.*Member = &call;
        }
    }
};

template <auto... Members>
void install(Dispatcher& dispatcher) {
    (Watched<Members>::install(dispatcher), ...);
}

}  // namespace

void watch_vulkan(const vulkan::Context& context) {
    // The one place where a device's calls all pass; every object made on it looks here.
    auto& dispatcher = const_cast<Dispatcher&>(*context.device().getDispatcher());
    using D = Dispatcher;
    install<&D::vkResetCommandPool, &D::vkResetCommandBuffer, &D::vkBeginCommandBuffer,
            &D::vkEndCommandBuffer, &D::vkCmdResetQueryPool, &D::vkResetQueryPool,
            &D::vkCmdWriteTimestamp, &D::vkCmdWriteTimestamp2, &D::vkCmdPipelineBarrier,
            &D::vkCmdPipelineBarrier2, &D::vkCmdBindPipeline, &D::vkCmdBindDescriptorSets,
            &D::vkCmdBindVertexBuffers, &D::vkCmdBindIndexBuffer, &D::vkCmdPushConstants,
            &D::vkCmdBeginRendering, &D::vkCmdEndRendering, &D::vkCmdSetViewport,
            &D::vkCmdSetScissor, &D::vkCmdDraw, &D::vkCmdDrawIndexed, &D::vkCmdDrawIndirect,
            &D::vkCmdDrawIndexedIndirect, &D::vkCmdDispatch, &D::vkCmdDispatchIndirect,
            &D::vkCmdCopyBuffer, &D::vkCmdUpdateBuffer, &D::vkCmdFillBuffer, &D::vkCmdCopyImage,
            &D::vkCmdBlitImage, &D::vkCmdCopyImageToBuffer, &D::vkCmdCopyBufferToImage,
            &D::vkCmdClearColorImage, &D::vkCmdClearAttachments, &D::vkCmdExecuteCommands,
            &D::vkUpdateDescriptorSets, &D::vkFlushMappedMemoryRanges,
            &D::vkInvalidateMappedMemoryRanges, &D::vkQueueSubmit, &D::vkQueueSubmit2,
            &D::vkQueueWaitIdle, &D::vkDeviceWaitIdle, &D::vkWaitSemaphores, &D::vkSignalSemaphore,
            &D::vkGetSemaphoreCounterValue, &D::vkWaitForFences, &D::vkResetFences,
            &D::vkGetFenceStatus, &D::vkGetQueryPoolResults, &D::vkGetCalibratedTimestampsEXT>(
        dispatcher);
}

}  // namespace gazeloop::tests
