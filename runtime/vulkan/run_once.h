#pragma once

#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// Records commands, submits them and waits for the device: for set-up and for what is read back
/// once, not for frames.
template <typename Record>
void run_once(const Context& context, Record&& record) {
    const vk::raii::Device& device = context.device();
    const vk::raii::CommandPool pool(
        device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                          context.queue_family()));
    const vk::raii::CommandBuffers buffers(
        device, vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1));
    const vk::raii::CommandBuffer& commands = buffers[0];
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands);
    commands.end();
    const vk::CommandBufferSubmitInfo info(*commands);
    context.queue().submit2(vk::SubmitInfo2({}, {}, info));
    context.device().waitIdle();
}

}  // namespace gazeloop::vulkan
