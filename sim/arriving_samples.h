#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/eye_tracker.h"

namespace gazeloop::sim {

/// A tracker's samples as a host gets them: taken when they are asked for, handed out once they
/// have arrived. The same samples come however often they are asked for.
class ArrivingSamples {
  public:
    explicit ArrivingSamples(const EyeTracker& tracker) : tracker_(tracker) {}

    /// Appends what has arrived by `now_ns` (host time). `step(tracker)` takes the next sample:
    /// one of EyeTracker::step().
    template <typename Step>
    void take(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples, const Step& step) {
        for (;;) {
            if (pending_) {
                if (pending_->arrived.ns > now_ns) {
                    return;
                }
                samples.push_back(*pending_);
                pending_.reset();
            }
            if (tracker_.finished() || tracker_.earliest_arrival_ns() > now_ns) {
                return;
            }
            pending_ = step(tracker_);
        }
    }

    /// Whether none is left, neither to take nor to arrive.
    [[nodiscard]] bool finished() const { return tracker_.finished() && !pending_; }

  private:
    EyeTracker tracker_;
    std::optional<gaze::GazeSample> pending_;  ///< taken, but not arrived yet
};

}  // namespace gazeloop::sim
