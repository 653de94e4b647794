#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/frame/frame_record.h"

namespace gazeloop::latency {

/// A rendered frame with what the GPU said of it.
struct FinishedFrame {
    frame::FrameRecord frame;
    std::optional<frame::FrameGpuRecord> gpu;  ///< none: it came too late, or never
};

/// Joins each rendered frame with its GPU part, which comes some frames later. In fixed memory.
/// Frames that were not rendered are no business of this.
class PendingFrames {
  public:
    static constexpr std::size_t kMost = 16;

    /// Adds a frame with should_render, in the order of the indices. `finished(FinishedFrame&)` is
    /// called for the frame 16 before, if it still lacked its GPU part.
    template <typename Finished>
    void add(const frame::FrameRecord& record, const Finished& finished) {
        std::optional<FinishedFrame>& slot = slots_[record.index % kMost];
        if (slot) {
            finished(*slot);
        }
        slot.emplace(FinishedFrame{.frame = record, .gpu = std::nullopt});
    }

    /// `finished` is called for the frame that this is of, unless it came too late.
    template <typename Finished>
    void add(const frame::FrameGpuRecord& record, const Finished& finished) {
        std::optional<FinishedFrame>& slot = slots_[record.index % kMost];
        if (slot && slot->frame.index == record.index) {
            slot->gpu = record;
            finished(*slot);
            slot.reset();
        }
    }

    /// At the end: `finished` is called for what still lacks its GPU part, by index.
    template <typename Finished>
    void finish(const Finished& finished) {
        for (;;) {
            std::optional<FinishedFrame>* first = nullptr;
            for (std::optional<FinishedFrame>& slot : slots_) {
                if (slot && (first == nullptr || slot->frame.index < (*first)->frame.index)) {
                    first = &slot;
                }
            }
            if (first == nullptr) {
                return;
            }
            finished(**first);
            first->reset();
        }
    }

  private:
    std::array<std::optional<FinishedFrame>, kMost> slots_;  ///< by index modulo size
};

}  // namespace gazeloop::latency
