#pragma once

#include <cstdint>
#include <optional>

#include "drivers/openxr/gaze_gates.h"
#include "drivers/openxr/sample_time.h"
#include "runtime/gaze/combined_gaze.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/gaze/vergence.h"

namespace gazeloop::drivers {

/// What a runtime answered when it was asked for the gaze: where the gates stand. Pure data.
struct GazeAnswer {
    bool focused = false;
    bool bound = false;
    bool active = false;
    bool in_time = false;            ///< the runtime has poses for the time that was asked for
    bool valid = false;              ///< of the pose, as the runtime says
    bool tracked = false;            ///< false with valid: sub-nominal
    std::optional<gaze::Pose> pose;  ///< in the head frame; none: not valid, or not a pose
    GivenTime time;
};

/// Makes samples of a runtime's answers, in their order. Pure.
class GazeReader {
  public:
    /// The eyes' rays meet at `distance_m` (gaze::eye_rays), but where meet_at_depth() knows more.
    explicit GazeReader(double distance_m) : distance_m_(distance_m) {}

    /// Where the eyes are in the head, from here on; ignored where a position cannot be in a head.
    void place_eyes(const gaze::PerEye<glm::dvec3>& eyes_m) {
        if (gaze::is_in_the_head(eyes_m[0]) && gaze::is_in_the_head(eyes_m[1])) {
            eyes_m_ = eyes_m;
        }
    }
    [[nodiscard]] const gaze::PerEye<glm::dvec3>& eyes_m() const { return eyes_m_; }

    /// The sample of an answer. Nothing if the runtime has nothing new: the same sample time or,
    /// without sample times, the same pose. Without sample times, a pose that stays the same counts
    /// as new again every `kStillGaze_ns`.
    ///
    /// Where there is no gaze, one sample without a valid eye, so that the policy for lost gaze
    /// takes over with this frame. While the runtime tracks but sees no eyes, one more for each
    /// answer.
    ///
    /// A pose that the runtime calls sub-nominal has confidence 0: it counts only if
    /// gaze.minimum_confidence is 0.
    [[nodiscard]] std::optional<gaze::GazeSample> take(const GazeAnswer& answer, GazeGates& gates);

    /// Makes the rays of the sample that take() returned last meet on what is seen along them
    /// (gaze/fixation.h), as fast as eyes follow (gaze/vergence.h). States the error that this
    /// leaves. `head`: in the world that `seen` is in, at the pose's time. None: not known, so the
    /// distance is assumed. A sample without gaze stays as it is.
    void meet_at_depth(gaze::GazeSample& sample, const std::optional<gaze::Pose>& head,
                       const gaze::SeenDepth& seen);

    /// The time that the pose of the sample returned last is for, on the runtime's time line; 0:
    /// unknown.
    [[nodiscard]] std::int64_t pose_time() const { return pose_time_; }

  private:
    /// A gaze whose time stands still for this long while the gaze moves has no time.
    static constexpr std::int64_t kStandstill_ns = 100'000'000;
    /// Without times, the same pose after this long is a gaze that rests: the runtime still vouches
    /// for it. Below any gaze.stale_ms of use, above the period of most trackers.
    static constexpr std::int64_t kStillGaze_ns = 20'000'000;

    [[nodiscard]] std::optional<gaze::GazeSample> lost(std::int64_t now_ns, bool sees_no_eyes);
    [[nodiscard]] gaze::GazeSample next(std::int64_t now_ns);
    void split(gaze::GazeSample& sample, double distance_m, const gaze::DistanceRange& range) const;
    [[nodiscard]] gaze::CombinedGaze combined() const;

    double distance_m_;
    /// Half of the mean distance between adults' pupils to each side (Dodgson 2004: 63 mm), until
    /// the runtime says.
    gaze::PerEye<glm::dvec3> eyes_m_{glm::dvec3{-0.0315, 0.0, 0.0}, glm::dvec3{0.0315, 0.0, 0.0}};
    std::uint64_t sequence_ = 0;
    std::int64_t pose_time_ = 0;
    std::int64_t device_ns_ = 0;
    std::optional<gaze::Pose> last_pose_;  ///< of the last sample with gaze; none after a loss
    std::int64_t last_given_ = 0;
    std::int64_t advanced_ns_ = 0;  ///< when a newer time came, in host time
    std::int64_t taken_ns_ = 0;     ///< when the last sample with gaze was, in host time
    bool told_loss_ = true;
    gaze::Vergence vergence_;
};

}  // namespace gazeloop::drivers
