#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "runtime/gaze/events/cyclopean_gaze.h"
#include "runtime/gaze/events/eye_event.h"
#include "runtime/gaze/gaze_motion.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::openxr_layer {

/// What an application is told of samples.
struct HistoryPolicy {
    double minimum_confidence = 0.6;      ///< below it, gaze is sub-nominal
    std::int64_t stale_ns = 100'000'000;  ///< a newest sample older than this is held
    std::int64_t hold_ns = 300'000'000;   ///< for how long lost gaze is held, sub-nominal
    gaze::MotionPolicy motion{.tell_events = true};
};

/// A report of the tracker, as one ray for both eyes.
struct SeenGaze {
    gaze::GazeSample sample;
    std::int64_t time_ns = 0;           ///< when the eyes were seen; where unknown, when it arrived
    std::optional<gaze::Pose> in_head;  ///< -Z along the gaze, no roll; none: no eye is seen
    bool nominal = false;               ///< of the tracker's usual quality
    gaze::EyeEvent event = gaze::EyeEvent::Lost;
};

/// Where the gaze was at some time.
struct GazeAt {
    const SeenGaze* seen = nullptr;  ///< valid until the next add()
    bool nominal = false;            ///< false: usable for foveation, not for aiming
    /// Of the gaze in the head, rad/s on the head's axes: from the sample before. None where that
    /// is missing or too long ago.
    std::optional<glm::dvec3> turning;
};

/// The last second or more of a tracker's samples, and the gaze at any time in it. Pure. No memory
/// is allocated after construction.
class GazeHistory {
  public:
    static constexpr std::size_t kMost = 1024;

    explicit GazeHistory(const HistoryPolicy& policy);

    void add(const gaze::GazeSample& sample);

    /// The gaze of the sample nearest to a time: nothing is predicted or interpolated. Where no eye
    /// was seen in it, that of the last sample before it that saw one, for hold_ns; none after
    /// that, for times before the first sample by more than stale_ns, and when at `now_ns` the
    /// newest sample is older than stale_ns and hold_ns together.
    [[nodiscard]] GazeAt at(std::int64_t time_ns, std::int64_t now_ns) const;

    /// How many samples were added in all.
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// The sample of that number, counted from 0. Precondition: it is among the last kMost.
    [[nodiscard]] const SeenGaze& operator[](std::uint64_t number) const {
        return ring_[number % kMost];
    }
    /// The number of the oldest sample that is still there.
    [[nodiscard]] std::uint64_t first() const { return count_ > kMost ? count_ - kMost : 0; }

  private:
    [[nodiscard]] std::uint64_t nearest(std::int64_t time_ns) const;
    [[nodiscard]] std::optional<glm::dvec3> turning_at(std::uint64_t number) const;

    HistoryPolicy policy_;
    gaze::GazeMotion motion_;
    gaze::CyclopeanGaze cyclopean_;
    std::vector<SeenGaze> ring_;
    std::uint64_t count_ = 0;
};

/// What turns -Z into a unit vector without roll; straight up and down, without yaw.
[[nodiscard]] glm::dquat turn_to(const glm::dvec3& direction);

}  // namespace gazeloop::openxr_layer
