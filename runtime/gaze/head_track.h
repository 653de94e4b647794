#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gaze/head_motion.h"
#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

/// A recorded head motion: poses at increasing host times.
class HeadTrack final : public HeadMotion {
  public:
    /// Adds a pose; times must not decrease, a pose at the time of the last one replaces it.
    void add(std::int64_t time_ns, const Pose& pose);

    /// The pose at a time: position linear and orientation spherical between the neighbours, the
    /// first or last pose outside. Precondition: not empty.
    [[nodiscard]] Pose at(std::int64_t time_ns) const override;

    [[nodiscard]] bool empty() const { return poses_.empty(); }

  private:
    struct TimedPose {
        std::int64_t time_ns;
        Pose pose;
    };
    std::vector<TimedPose> poses_;
};

}  // namespace gazeloop::gaze
