#include "runtime/vulkan/pass_recorder.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace gazeloop::vulkan {
namespace {

using Stage = vk::PipelineStageFlagBits2;

}  // namespace

PassRecorder::PassRecorder(const Context& context, const frame::PassList& passes, bool profile)
    : context_(&context), passes_(&passes), profile_(profile) {
    // Each pass once before and once after the gaze is read at most, and what is read back.
    const auto most = static_cast<std::uint32_t>(2 * passes.size() + 1);
    const vk::raii::Device& device = context.device();
    pool_ = vk::raii::CommandPool(
        device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                          context.queue_family()));
    vk::raii::CommandBuffers buffers(
        device, vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, most));
    for (vk::raii::CommandBuffer& buffer : buffers) {
        buffers_.push_back(std::move(buffer));
    }
    queries_ = vk::raii::QueryPool(
        device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * most));
    segments_.reserve(most);
    ticks_.resize(std::size_t{2} * most);
}

void PassRecorder::reset() {
    pool_.reset();
    segments_.clear();
    submitted_ = 0;
}

const vk::raii::CommandBuffer& PassRecorder::begin(std::string_view pass) {
    const auto index = passes_->find(pass);
    if (!index) {
        throw std::logic_error(fmt::format("the run has no pass '{}'", pass));
    }
    if (!profile_ && any()) {
        return commands();
    }
    return open({.pass = profile_ ? index : std::nullopt, .timed = true});
}

const vk::raii::CommandBuffer& PassRecorder::begin_untimed() {
    return open({.pass = std::nullopt, .timed = false});
}

const vk::raii::CommandBuffer& PassRecorder::open(Segment segment) {
    if (segments_.size() == buffers_.size()) {
        throw std::logic_error("a pass was begun more often than its frame has room for");
    }
    const auto first_query = static_cast<std::uint32_t>(2 * segments_.size());
    segments_.push_back(segment);
    const vk::raii::CommandBuffer& opened = commands();
    opened.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    opened.resetQueryPool(*queries_, first_query, 2);
    opened.writeTimestamp2(Stage::eTopOfPipe, *queries_, first_query);
    return opened;
}

const vk::raii::CommandBuffer& PassRecorder::commands() const {
    return buffers_[segments_.size() - 1];
}

void PassRecorder::submit(vk::Semaphore done, std::uint64_t value) {
    for (; submitted_ < segments_.size(); ++submitted_) {
        const vk::raii::CommandBuffer& buffer = buffers_[submitted_];
        buffer.writeTimestamp2(Stage::eBottomOfPipe, *queries_,
                               static_cast<std::uint32_t>(2 * submitted_ + 1));
        buffer.end();
        const vk::CommandBufferSubmitInfo commands(*buffer);
        const vk::SemaphoreSubmitInfo signal(done, value, Stage::eAllCommands);
        const bool last = submitted_ + 1 == segments_.size();
        context_->queue().submit2(
            vk::SubmitInfo2({}, 0, nullptr, 1, &commands, last ? 1U : 0U, &signal));
    }
}

void PassRecorder::collect(GpuClock& clock, frame::FrameGpuRecord& record) const {
    const auto queries = static_cast<std::uint32_t>(2 * segments_.size());
    const vk::Result result =
        (*context_->device())
            .getQueryPoolResults(*queries_, 0, queries, queries * sizeof(std::uint64_t),
                                 ticks_.data(), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64,
                                 *context_->device().getDispatcher());
    if (result != vk::Result::eSuccess) {
        return;
    }
    std::optional<std::size_t> last_timed;
    for (std::size_t segment = 0; segment < segments_.size(); ++segment) {
        if (!segments_[segment].timed) {
            continue;
        }
        last_timed = segment;
        if (const auto pass = segments_[segment].pass) {
            const double ns = clock.elapsed_ns(ticks_[2 * segment], ticks_[2 * segment + 1]);
            // A pass that is recorded in parts takes the sum of them.
            record.passes.set(*pass, record.passes[*pass].value_or(0) + std::llround(ns));
            if (!record.pass_starts[*pass]) {
                record.pass_starts.set(
                    *pass, std::llround(clock.elapsed_ns(ticks_[0], ticks_[2 * segment])));
            }
        }
    }
    if (last_timed) {
        record.gpu_begin = clock.host_time(ticks_[0]);
        record.gpu_end = clock.host_time(ticks_[2 * *last_timed + 1]);
        if (record.gpu_end.known()) {
            record.clock_deviation_ns = static_cast<std::int64_t>(clock.max_deviation_ns());
        }
    }
}

}  // namespace gazeloop::vulkan
