#include "drivers/openxr/gaze_reader.h"

#include "runtime/gaze/direction.h"
#include "runtime/gaze/fixation.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {

std::optional<gaze::GazeSample> GazeReader::take(const GazeAnswer& answer, GazeGates& gates) {
    const std::int64_t now_ns = answer.time.now_ns;
    const auto pass = [&](GazeGate gate, bool open, std::string_view yes, std::string_view no) {
        gates.set(gate, {open, open ? yes : no}, now_ns);
        return open;
    };
    if (!pass(GazeGate::Focus, answer.focused, "the runtime gives it input",
              "the runtime gives the input to somebody else, or nobody wears the headset")) {
        return lost(now_ns, false);
    }
    // What comes counts, whatever the runtime says of the binding.
    pass(GazeGate::Binding, answer.bound, "to the eye gaze profile",
         "no eye gaze profile is in force");
    if (!pass(GazeGate::Active, answer.active, "the runtime tracks the eyes",
              "no tracking: not worn, not allowed, or not calibrated")) {
        return lost(now_ns, false);
    }
    if (!answer.in_time) {
        gates.set(GazeGate::Pose,
                  {false, "the runtime has none for this time: its clock, not the eyes, is why",
                   "restart the runtime; where it stays so, its clock is at fault"},
                  now_ns);
        return lost(now_ns, false);
    }
    if (!answer.valid) {
        pass(GazeGate::Pose, false, "", "the eyes are not seen");
        return lost(now_ns, true);
    }
    if (!answer.pose) {
        pass(GazeGate::Pose, false, "",
             "what the runtime gives is no pose: not a number, or no "
             "rotation");
        return lost(now_ns, false);
    }
    pass(GazeGate::Pose, answer.tracked, "tracked",
         "sub-nominal, not to be relied on: used with gaze.minimum_confidence=0 only");

    SampleTime time = sample_time(answer.time);
    const bool newer = answer.time.given != last_given_ || !last_pose_;
    const bool same_pose = last_pose_ && last_pose_->orientation == answer.pose->orientation &&
                           last_pose_->position_m == answer.pose->position_m;
    const bool timeless =
        time.trouble == SampleTimeTrouble::NotGiven || time.trouble == SampleTimeTrouble::Absurd;
    const auto since = [&](std::int64_t then_ns) {
        return time::saturated(static_cast<__int128>(now_ns) - then_ns);
    };
    if (newer) {
        advanced_ns_ = now_ns;
    } else if (same_pose) {
        if (!timeless || since(taken_ns_) < kStillGaze_ns) {
            return std::nullopt;
        }
    } else if (!timeless) {
        if (since(advanced_ns_) < kStandstill_ns) {
            return std::nullopt;
        }
        time.trouble = SampleTimeTrouble::StandsStill;
        time.sampled = {};
        time.pose_ns.reset();
    }
    const bool known = time.trouble == SampleTimeTrouble::None;
    pass(GazeGate::SampleTime, known, text_of(time.trouble), text_of(time.trouble));

    taken_ns_ = now_ns;
    last_pose_ = answer.pose;
    last_given_ = answer.time.given;
    told_loss_ = false;
    pose_time_ = time.pose_ns ? answer.time.given : 0;
    if (known) {
        device_ns_ = answer.time.given;
    }
    gaze::GazeSample sample = next(now_ns);
    sample.sampled = time.sampled;
    split(sample, distance_m_, {});
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.confidence = answer.tracked ? -1.0 : 0.0;
    }
    return sample;
}

/// Of the last sample with gaze.
gaze::CombinedGaze GazeReader::combined() const {
    return {last_pose_->position_m, last_pose_->orientation * gaze::kStraightAhead};
}

/// What rays a sample has, and how far off they may be; what else is said of the eyes stays.
void GazeReader::split(gaze::GazeSample& sample, double distance_m,
                       const gaze::DistanceRange& range) const {
    const gaze::PerEye<gaze::EyeRay> rays = gaze::eye_rays(combined(), eyes_m_, distance_m);
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        sample.eyes[e].origin_m = rays[e].origin_m;
        sample.eyes[e].direction = rays[e].direction;
        sample.eyes[e].valid = rays[e].valid;
    }
    sample.parallax_rad = gaze::parallax_error_rad(eyes_m_, distance_m, range);
}

void GazeReader::meet_at_depth(gaze::GazeSample& sample, const std::optional<gaze::Pose>& head,
                               const gaze::SeenDepth& seen) {
    if (!last_pose_) {
        return;
    }
    const gaze::CombinedGaze in_head = combined();
    std::optional<gaze::Fixation> fixation;
    if (head) {
        fixation =
            gaze::find_fixation({gaze::transform_point(*head, gaze::in_the_head(in_head.origin_m)),
                                 head->orientation * in_head.direction},
                                seen);
    }
    const double nearness =
        vergence_.follow(fixation ? std::optional(fixation->nearness) : std::nullopt,
                         1.0 / distance_m_, in_head.direction, sample.arrived.ns);
    split(sample, 1.0 / nearness, fixation ? fixation->range : gaze::DistanceRange{});
}

std::optional<gaze::GazeSample> GazeReader::lost(std::int64_t now_ns, bool sees_no_eyes) {
    last_pose_.reset();
    vergence_.forget();
    pose_time_ = 0;
    if (told_loss_ && !sees_no_eyes) {
        return std::nullopt;
    }
    told_loss_ = true;
    return next(now_ns);
}

gaze::GazeSample GazeReader::next(std::int64_t now_ns) {
    gaze::GazeSample sample;
    sample.sequence = ++sequence_;
    sample.device_ns = device_ns_;
    sample.arrived = {now_ns, time::StampKind::Measured};
    return sample;
}

}  // namespace gazeloop::drivers
