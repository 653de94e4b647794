#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/view.h"

namespace gazeloop::gaze {

/// What happens when gaze is lost, and how far away the eyes are taken to look.
struct FoveaPolicy {
    std::int64_t stale_ns = 100'000'000;  ///< a sample older than this at the latch is stale
    /// Hold for this long after the last valid sample; less than stale_ns lets the fovea jump.
    std::int64_t hold_ns = 300'000'000;
    std::int64_t return_ns = 150'000'000;  ///< then return to straight ahead in this time
    double minimum_confidence = 0.6;       ///< a sample that states less is not valid
    /// Distance at which gaze is held in world, metres. It matters only while the head moves
    /// sideways between sample and display: the error in radians is about the moved distance over
    /// this distance.
    double fixation_distance_m = 1.5;
};

/// From gaze samples to the fovea of a frame. Pure: time is an argument, so that a recorded stream
/// of samples and latches gives the same foveae bit for bit.
///
/// An eye of a sample is valid if the tracker says so, its direction is finite and not zero, and
/// its confidence is unknown or high enough. If only one eye is valid, the other borrows its
/// direction.
///
/// A valid sample's direction is placed in world. It becomes the point at the fixation distance
/// along the direction, from the eye's place in the head at the sample's time. At the latch that
/// point is seen from the view that the frame submits. The eye is taken to sit at its view's
/// origin, because that is where the display's optics want it; the tracker's own ray origin is not
/// used. A sample without a (finite) head pose is held in the head instead: head motion since then
/// goes unseen. Head poses of samples and latches must be given in one world; where its origin
/// moves, whoever notices says so (move_origin; gaze/origin_watch.h).
///
/// A sample is as old as its time says, and at least as old as its arrival. If neither is known, it
/// counts as stale.
class GazeToFovea {
  public:
    explicit GazeToFovea(const FoveaPolicy& policy);

    /// Takes samples in the order of arrival. A sample whose time is before that of the sample
    /// added last is ignored. Unknown times are not compared, nor is the tracker's own clock, which
    /// may be wrong: then the order of arrival counts.
    void add(const GazeSample& sample);

    /// From here on, heads and views are given in another world: the pose of its origin in the one
    /// before. What is held goes along, so that it stays where it is seen.
    void move_origin(const Pose& new_in_old);

    /// The foveae of a frame whose gaze is read at `latched` (known), for views at their display
    /// time. `head` is the head pose that those views belong to. Precondition: is_valid(view) of
    /// both.
    [[nodiscard]] FrameFovea latch(time::Stamp latched, const Pose& head,
                                   const StereoView& views) const;

  private:
    struct Times {
        time::Stamp sampled;
        time::Stamp arrived;
        time::Stamp ready;
        std::optional<std::int64_t> uncertainty_ns;
    };
    struct ValidSample {
        PerEye<glm::dvec3> direction_in_head;
        PerEye<bool> borrowed;
        std::optional<double> parallax_rad;
        std::optional<Pose> head;
        std::uint64_t sequence = 0;
        Times times;
    };
    /// What both eyes of a frame have in common.
    struct Condition {
        FoveaState state = FoveaState::Ahead;
        LossReason reason = LossReason::Never;
        double returned = 0.0;  ///< 0 at the held point .. 1 straight ahead
    };

    [[nodiscard]] Condition condition_at(std::int64_t latched_ns) const;
    [[nodiscard]] FoveaPoint fovea_of(std::size_t eye, const Condition& condition, const Pose& head,
                                      const EyeView& view) const;

    FoveaPolicy policy_;
    time::Stamp sampled_before_;   ///< of the sample added last, ignored or not
    std::optional<Times> newest_;  ///< of the sample taken last
    bool newest_valid_ = false;
    std::optional<ValidSample> last_valid_;
};

}  // namespace gazeloop::gaze
