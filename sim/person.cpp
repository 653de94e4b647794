#include "sim/person.h"

#include "runtime/gaze/direction.h"
#include "sim/turned_direction.h"

namespace gazeloop::sim {

Person::Person(const EyeTerms& eye, const HeadTerms& head, std::uint64_t seed)
    : head_moves_(head.moves()),
      eye_x_m_{-0.5e-3 * eye.ipd_mm, 0.5e-3 * eye.ipd_mm},
      head_(head, seed),
      path_(eye, head, seed, head_),
      fixational_(eye, seed),
      blinks_(eye, seed) {}

gaze::Pose Person::head_at(double time_s) {
    path_.plan_until(time_s);
    return head_.at(time_s);
}

TrueGaze Person::at(double time_s) {
    TrueGaze truth;
    truth.head = head_at(time_s);
    fixational_.plan_until(time_s);
    blinks_.plan_until(time_s);

    const GazePath::Point point = path_.at(time_s);
    const FixationalOffset offset = fixational_.at(time_s);
    truth.movement = point.movement;
    truth.microsaccade = offset.microsaccade;
    truth.target_m =
        point.distance_m * turned_direction(point.direction, offset.right_rad, offset.up_rad);
    const glm::dvec3 in_head_m = gaze::transform_point(gaze::inverse(truth.head), truth.target_m);
    const double openness = blinks_.openness(time_s);
    for (const gaze::Eye eye : gaze::kEyes) {
        gaze::EyeRay& ray = truth.eyes[gaze::index(eye)];
        ray.origin_m = {eye_x_m_[gaze::index(eye)], 0.0, 0.0};
        // An eye that has moved into what it looked at looks straight ahead.
        ray.direction = gaze::unit(in_head_m - ray.origin_m).value_or(gaze::kStraightAhead);
        ray.openness = openness;
        ray.confidence = 1.0;
        ray.valid = true;
    }
    return truth;
}

}  // namespace gazeloop::sim
