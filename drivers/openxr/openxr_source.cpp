#include "drivers/openxr/openxr_source.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include "runtime/error.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers {

OpenXrSource::OpenXrSource(openxr::Session& session, const OpenXrGazeOptions& options)
    : session_(session), options_(options), reader_(options.distance_m) {
    const openxr::Instance& instance = session.instance();
    if (!check_instance_gates(instance.handle(), instance.system(), instance.has(kEyeGazeExtension),
                              gates_)) {
        refuse();
    }
    action_.emplace(instance.handle());
    if (XR_FAILED(action_->suggested())) {
        gates_.set(GazeGate::Binding, {false, openxr::xr_name(action_->suggested())},
                   time::monotonic_ns());
        refuse();
    }
    space_.emplace(session, *action_);
}

void OpenXrSource::refuse() const {
    const GazeGate gate = *gates_.first_shut();
    throw SetupError(
        ErrorKind::NoDevice,
        fmt::format("--gaze openxr: {}: {}: no ({}): {}", session_.instance().runtime_name(),
                    describe(gate), gates_.state(gate)->found, remedy(gate)));
}

void OpenXrSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    const GazeAnswer answer = ask(now_ns);
    auto sample = reader_.take(answer, gates_);
    if (!sample) {
        return;
    }
    // Also for a predicted pose, which has a time though nobody knows when the eye was seen.
    if (reader_.pose_time() != 0) {
        sample->head = session_.head_at(reader_.pose_time());
    }
    if (options_.from_depth && sample->eyes[0].valid) {
        reader_.meet_at_depth(
            *sample, reader_.pose_time() != 0 ? sample->head : session_.head_at(answer.time.asked),
            seen_);
    }
    samples.push_back(*sample);
}

void OpenXrSource::take_seen_depth(const gaze::SeenDepth& seen) {
    if (options_.from_depth) {
        seen_ = seen;
    }
}

GazeAnswer OpenXrSource::ask(std::int64_t now_ns) {
    GazeAnswer answer;
    answer.time.now_ns = now_ns;
    answer.focused = space_->sync();
    if (!answer.focused) {
        return answer;
    }
    if (!bound_ || profile_changes_ != session_.profile_changes()) {
        profile_changes_ = session_.profile_changes();
        bound_ = space_->bound_profile() == action_->profile();
    }
    answer.bound = bound_;
    answer.active = space_->active();
    const auto asked = session_.clock().xr_time(now_ns);
    if (!answer.active || !asked) {
        return answer;
    }
    if (const auto eyes_m = space_->eyes_m(*asked)) {
        reader_.place_eyes(*eyes_m);
    }
    const auto located = space_->locate(*asked);
    if (!located) {
        return answer;
    }
    answer.in_time = true;
    answer.valid = located->valid;
    answer.tracked = located->tracked;
    answer.pose = located->pose;
    answer.time.given = located->time;
    answer.time.asked = *asked;
    if (located->time > 0) {
        answer.time.host_ns = session_.clock().host_ns(located->time);
    }
    return answer;
}

std::string OpenXrSource::description() const {
    const double error_rad = gaze::parallax_error_rad(reader_.eyes_m(), options_.distance_m, {});
    return fmt::format(
        "OpenXR eye gaze of {} ({}), one ray for both eyes: they meet {}at {} m, at most {:.1f} "
        "deg off for anything from {} m on",
        session_.instance().system_name(), session_.instance().runtime_name(),
        options_.from_depth ? "where the last frame's depth says, else " : "", options_.distance_m,
        glm::degrees(error_rad), gaze::kNearestContent_m);
}

}  // namespace gazeloop::drivers
