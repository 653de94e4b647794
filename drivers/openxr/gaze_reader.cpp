#include "drivers/openxr/gaze_reader.h"

#include "runtime/gaze/direction.h"
#include "runtime/latency/span.h"

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

    auto time = sample_time(answer.time);
    if (!time) {
        pass(GazeGate::SampleTime, false, "", "an absurd time: the sample was left out");
        return lost(now_ns, false);
    }
    const bool newer = answer.time.given != last_given_ || !last_pose_;
    const bool same_pose = last_pose_ && last_pose_->orientation == answer.pose->orientation &&
                           last_pose_->position_m == answer.pose->position_m;
    if (newer) {
        advanced_ns_ = now_ns;
    } else if (same_pose) {
        return std::nullopt;
    } else if (time->trouble != SampleTimeTrouble::NotGiven) {
        if (latency::saturated(static_cast<__int128>(now_ns) - advanced_ns_) < kStandstill_ns) {
            return std::nullopt;
        }
        time->trouble = SampleTimeTrouble::StandsStill;
        time->sampled = {};
        time->pose_ns.reset();
    }
    const bool known = time->trouble == SampleTimeTrouble::None;
    pass(GazeGate::SampleTime, known, text_of(time->trouble), text_of(time->trouble));

    last_pose_ = answer.pose;
    last_given_ = answer.time.given;
    told_loss_ = false;
    pose_time_ = time->pose_ns ? answer.time.given : 0;
    if (known) {
        device_ns_ = answer.time.given;
    }
    gaze::GazeSample sample = next(now_ns);
    sample.sampled = time->sampled;
    sample.eyes =
        gaze::eye_rays({answer.pose->position_m, answer.pose->orientation * gaze::kStraightAhead},
                       eyes_m_, distance_m_);
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.confidence = answer.tracked ? -1.0 : 0.0;
    }
    sample.parallax_rad = gaze::parallax_error_rad(eyes_m_, distance_m_, gaze::kNearestContent_m);
    return sample;
}

std::optional<gaze::GazeSample> GazeReader::lost(std::int64_t now_ns, bool sees_no_eyes) {
    last_pose_.reset();
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
    sample.arrived = {now_ns, latency::StampKind::Measured};
    return sample;
}

}  // namespace gazeloop::drivers
