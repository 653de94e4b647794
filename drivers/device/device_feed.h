#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/spsc_queue.h"

namespace gazeloop::drivers {

/// What a device's reading thread hands to the loop: samples without a lock, and rarely a line
/// about the device.
class DeviceFeed {
  public:
    // ---- the reading thread

    /// Numbers the sample and hands it over; a full queue drops it, which is counted.
    void push(gaze::GazeSample& sample, std::uint64_t lost_before = 0) {
        sequence_ += 1 + lost_before;
        sample.sequence = sequence_;
        if (samples_.try_push(sample)) {
            last_ = sample;
            lost_ = false;
        } else {
            dropped_.fetch_add(1, std::memory_order_relaxed);
        }
    }

    /// There is no gaze from this time on: pushes a sample in which neither eye is valid. So the
    /// loop's policy for lost gaze takes over with its next frame, in a replay too. Only one such
    /// sample is pushed until the next real one, and none before the first.
    void push_loss(time::Stamp at) {
        if (lost_) {
            return;
        }
        gaze::GazeSample lost;
        lost.device_ns = last_.device_ns;
        lost.arrived = at;
        lost.tracker_gone = true;
        const std::uint64_t refused = dropped();
        push(lost);
        lost_ = dropped() == refused;
    }

    /// The number of the last sample: it changes when something was pushed.
    [[nodiscard]] std::uint64_t last_sequence() const { return sequence_; }

    void tell(time::Stamp time, std::string text,
              const frame::EventKind& kind = frame::kTrackerEvent) {
        const std::lock_guard lock(mutex_);
        events_.push_back({time, std::move(text), kind});
        reported_.store(true, std::memory_order_release);
    }

    // ---- the loop

    void poll(std::vector<gaze::GazeSample>& samples) {
        while (const gaze::GazeSample* const sample = samples_.front()) {
            samples.push_back(*sample);
            samples_.pop();
        }
    }

    [[nodiscard]] std::vector<SourceEvent> take_events() {
        if (!reported_.load(std::memory_order_acquire)) {
            return {};
        }
        const std::lock_guard lock(mutex_);
        reported_.store(false, std::memory_order_relaxed);
        return std::exchange(events_, {});
    }

    /// Samples lost because the loop had not asked for too long.
    [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

  private:
    /// 4 s of a 1000 Hz tracker, 1.6 MB.
    static constexpr std::size_t kQueueSamples = 4096;

    SpscQueue<gaze::GazeSample> samples_{kQueueSamples};
    std::atomic<std::uint64_t> dropped_{0};
    std::atomic<bool> reported_{false};
    std::mutex mutex_;
    std::vector<SourceEvent> events_;
    std::uint64_t sequence_ = 0;
    gaze::GazeSample last_;
    bool lost_ = true;  ///< the last sample was that of push_loss(), or none was pushed yet
};

}  // namespace gazeloop::drivers
