#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/frame/frame_record.h"
#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// Records the passes of one frame. While profiling, each has a command buffer, a submit and a pair
/// of timestamps of its own: several pairs inside one command buffer are wrong on lavapipe 22.3.
/// Otherwise everything that is submitted at once shares one command buffer.
class PassRecorder {
  public:
    /// `passes` must outlive this.
    PassRecorder(const Context& context, const frame::PassList& passes, bool profile);

    /// Begins a frame. Precondition: the GPU has finished what was recorded before.
    void reset();

    /// Begins a pass; what is recorded into the buffer until the next one is its work. Throws
    /// std::logic_error for a name that is not in the list.
    const vk::raii::CommandBuffer& begin(std::string_view pass);
    /// Begins work that is no part of the frame's time, after its passes: what the host reads back.
    const vk::raii::CommandBuffer& begin_untimed();
    /// Where the current pass is recorded. Precondition: one was begun since the last submit.
    [[nodiscard]] const vk::raii::CommandBuffer& commands() const;

    /// Whether something was recorded since the last submit.
    [[nodiscard]] bool any() const { return segments_.size() > submitted_; }
    /// Submits what was recorded since the last one, in order; `done` is signalled to `value` after
    /// it. Precondition: any().
    void submit(vk::Semaphore done, std::uint64_t value);

    /// The times of the passes, of the first one's begin and the last one's end, into `record`.
    /// Precondition: the GPU has finished.
    void collect(GpuClock& clock, frame::FrameGpuRecord& record) const;

  private:
    /// One command buffer.
    struct Segment {
        std::optional<std::size_t> pass;  ///< none: several, or work that is not timed
        bool timed = true;
    };
    const vk::raii::CommandBuffer& open(Segment segment);

    const Context* context_;
    const frame::PassList* passes_;
    bool profile_;
    vk::raii::CommandPool pool_{nullptr};
    std::vector<vk::raii::CommandBuffer> buffers_;
    vk::raii::QueryPool queries_{nullptr};
    std::vector<Segment> segments_;
    std::size_t submitted_ = 0;
    mutable std::vector<std::uint64_t> ticks_;
};

}  // namespace gazeloop::vulkan
