#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/fovea_uncertainty.h"
#include "runtime/gaze/gaze_motion.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/loss_machine.h"
#include "runtime/gaze/view.h"

namespace gazeloop::gaze {

/// What happens when gaze is lost, and how far away the eyes are taken to look.
struct FoveaPolicy {
    LossPolicy loss;
    /// Distance at which gaze is held in world, metres. It matters only while the head moves
    /// sideways between sample and display: the error in radians is about the moved distance over
    /// this distance.
    double fixation_distance_m = 1.5;
    /// None: the foveae are not widened (FoveaPoint::uncertainty_rad).
    std::optional<UncertaintyPolicy> uncertainty{};
    MotionPolicy motion{};  ///< by default samples are taken as they are
};

/// From gaze samples to the fovea of a frame. Pure: time is an argument, so that a recorded stream
/// of samples and latches gives the same foveae bit for bit.
///
/// Which samples count, and what becomes of the fovea without them, LossMachine decides. If only
/// one eye is valid, the other borrows its direction.
///
/// A valid sample's direction is placed in world. It becomes the point at the fixation distance
/// along the direction, from the eye's place in the head at the sample's time. At the latch that
/// point is seen from the view that the frame submits. The eye is taken to sit at its view's
/// origin, because that is where the display's optics want it; the tracker's own ray origin is not
/// used. A sample without a (finite) head pose is held in the head instead: head motion since then
/// goes unseen. Head poses of samples and latches must be given in one world; where its origin
/// moves, whoever notices says so (move_origin; gaze/origin_watch.h).
///
/// Where the policy says so, the directions that LossMachine lets through are filtered as samples
/// come (the recorded samples stay as they are), and foveae that rest on a fresh sample are
/// predicted to the time at which the frame is shown. A sample counts as seen at its time, or at
/// its arrival where that is unknown.
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
    /// time. `head` is the head pose that those views belong to. `display` is that time: gaze is
    /// predicted to it (unknown: not at all), and the uncertainty is that of then (unknown: of the
    /// latch). Precondition: is_valid(view) of both.
    [[nodiscard]] FrameFovea latch(time::Stamp latched, const Pose& head, const StereoView& views,
                                   time::Stamp display = {}) const;

  private:
    struct ValidSample {
        PerEye<glm::dvec3> direction_in_head;
        /// Why the direction is the other eye's; None: it is not.
        PerEye<LossCause> borrowed_for{};
        PerEye<std::optional<DirectionCovariance>> covariance{};
        std::optional<double> parallax_rad;
        std::optional<Pose> head;
        std::uint64_t sequence = 0;
        time::Stamp sampled;
        time::Stamp arrived;
        time::Stamp ready;
        std::optional<std::int64_t> uncertainty_ns;
        PerEye<std::optional<std::int64_t>> filter_delay_ns{};
    };

    [[nodiscard]] std::optional<GazePrediction> predict(const LossCondition& condition,
                                                        const time::Stamp& display) const;

    [[nodiscard]] FoveaPoint fovea_of(std::size_t eye, const LossCondition& condition,
                                      const Pose& head, const EyeView& view,
                                      const std::optional<GazePrediction>& prediction) const;

    /// Precondition: the policy widens. `shown`: when the frame will be.
    [[nodiscard]] double widening_of(std::size_t eye, const LossCondition& condition,
                                     const time::Stamp& shown,
                                     const std::optional<GazePrediction>& prediction) const;

    FoveaPolicy policy_;
    LossMachine loss_;
    std::optional<ValidSample> last_valid_;
    std::optional<GazeMotion> motion_;  ///< where the policy asks for any of it
};

}  // namespace gazeloop::gaze
