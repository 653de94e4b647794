#include "runtime/vulkan/layer_uploads.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace gazeloop::vulkan {

LayerUploads::LayerUploads(const Context& context)
    : context_(context),
      pool_(context.device(),
            vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient |
                                          vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                      context.queue_family())) {
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    done_ = vk::raii::Semaphore(context.device(), vk::SemaphoreCreateInfo({}, &timeline));
}

LayerUploads::~LayerUploads() {
    try {
        wait(submitted_);
    } catch (const vk::SystemError& error) {
        // The device is lost: nothing is running on it any more.
        spdlog::debug("uploads end on a lost device ({})", error.what());
    }
}

LayerUploads::Commands& LayerUploads::free_commands() {
    const std::uint64_t done = done_.getCounterValue();
    const auto free = std::ranges::find_if(
        commands_, [&](const Commands& commands) { return commands.upload <= done; });
    if (free != commands_.end()) {
        return *free;
    }
    vk::raii::CommandBuffers made(
        context_.device(),
        vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1));
    return commands_.emplace_back(Commands{std::move(made[0])});
}

std::uint64_t LayerUploads::submit(const LayeredImage& image, vk::Buffer from,
                                   std::span<const LayerSource> layers) {
    Commands& commands = free_commands();
    commands.buffer.begin(
        vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    replace_layers(commands.buffer, image, from, layers);
    commands.buffer.end();
    commands.upload = ++submitted_;
    const vk::CommandBufferSubmitInfo info(*commands.buffer);
    const vk::SemaphoreSubmitInfo signal(*done_, submitted_,
                                         vk::PipelineStageFlagBits2::eAllCommands);
    context_.queue().submit2(vk::SubmitInfo2({}, {}, info, signal));
    return submitted_;
}

bool LayerUploads::is_done(std::uint64_t upload) const { return done_.getCounterValue() >= upload; }

void LayerUploads::wait(std::uint64_t upload) const {
    (void)context_.device().waitSemaphores(vk::SemaphoreWaitInfo({}, *done_, upload),
                                           std::numeric_limits<std::uint64_t>::max());
}

}  // namespace gazeloop::vulkan
