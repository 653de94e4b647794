#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/gaze/view.h"
#include "tests/support/generated_numbers.h"

namespace gazeloop::gaze {
namespace {

using tests::any_double;
using tests::between;

glm::dvec3 any_vector() {
    const double x = any_double();
    const double y = any_double();
    return {x, y, any_double()};
}

glm::dvec3 vector_within(double reach) {
    const double x = between(-reach, reach);
    const double y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
}

glm::dquat rotation(double largest_rad = 3.14) {
    glm::dvec3 axis = vector_within(1.0);
    if (glm::length(axis) < 1e-3) {
        axis = {0.0, 1.0, 0.0};
    }
    return glm::angleAxis(between(-largest_rad, largest_rad), glm::normalize(axis));
}

glm::dvec3 direction_ahead() {
    return glm::normalize(glm::dvec3{between(-1.5, 1.5), between(-1.5, 1.5), -1.0});
}

EyeView any_view(const Pose& pose = {}) {
    const double left = between(-1.4, 1.3);
    const double down = between(-1.4, 1.3);
    EyeView view{.pose = pose,
                 .fov = {.left_rad = left,
                         .right_rad = between(left + 0.05, 1.4),
                         .up_rad = between(down + 0.05, 1.4),
                         .down_rad = down},
                 .width_px = *rc::gen::inRange<std::uint32_t>(1, 8192),
                 .height_px = *rc::gen::inRange<std::uint32_t>(1, 8192)};
    RC_ASSERT(is_valid(view));
    return view;
}

bool within_limit(const PixelPosition& position, const EyeView& view, double limit) {
    const double slack = 1e-9 * (view.width_px + view.height_px);
    return std::abs(position.x_px - view.width_px / 2.0) <= limit * view.width_px + slack &&
           std::abs(position.y_px - view.height_px / 2.0) <= limit * view.height_px + slack;
}

RC_GTEST_PROP(Projection, BringsEveryPixelBack, ()) {
    const EyeView view = any_view();
    const PixelPosition position{between(-1.0, 2.0) * view.width_px,
                                 between(-1.0, 2.0) * view.height_px};
    const glm::dvec3 direction = unproject(position, view);
    RC_ASSERT(std::abs(glm::length(direction) - 1.0) < 1e-12);
    const PixelPosition back = project(direction, view);
    const double tolerance = 1e-9 * (view.width_px + view.height_px);
    RC_ASSERT(std::abs(back.x_px - position.x_px) < tolerance);
    RC_ASSERT(std::abs(back.y_px - position.y_px) < tolerance);
}

RC_GTEST_PROP(Projection, IsFiniteAndWithinTheLimitForAnyDirection, ()) {
    const EyeView view = any_view();
    const double limit = between(0.5, 5.0);
    const glm::dvec3 direction = *rc::gen::arbitrary<bool>() ? any_vector() : vector_within(1.0);
    RC_ASSERT(within_limit(project(direction, view, limit), view, limit));
}

RC_GTEST_PROP(Projection, PutsWhatLiesBehindOffScreen, ()) {
    const EyeView view = any_view();
    glm::dvec3 direction = vector_within(1.0);
    direction.z = std::abs(direction.z);
    RC_PRE(direction != glm::dvec3(0.0));
    const PixelPosition position = project(direction, view);
    const bool on_screen = position.x_px > 0.0 && position.x_px < view.width_px &&
                           position.y_px > 0.0 && position.y_px < view.height_px;
    RC_ASSERT(!on_screen);
}

RC_GTEST_PROP(Projection, DoesNotJumpAtTheImagePlane, ()) {
    const EyeView view = any_view();
    const double angle_rad = between(-3.15, 3.15);
    const double x = std::cos(angle_rad);
    const double y = std::sin(angle_rad);
    const PixelPosition at = project({x, y, 0.0}, view);
    const double size = view.width_px + view.height_px;
    for (const double z : {-1e-9, 1e-9}) {
        const PixelPosition beside = project({x, y, z}, view);
        RC_ASSERT(std::hypot(beside.x_px - at.x_px, beside.y_px - at.y_px) < 1e-6 * size);
    }
}

RC_GTEST_PROP(GazeToFovea, GivesTheDirectionBackForAnUnmovedHead, ()) {
    FoveaPolicy policy;
    policy.fixation_distance_m = between(0.05, 100.0);
    GazeToFovea gaze(policy);
    const Pose head{rotation(), vector_within(20.0)};
    const PerEye<Pose> in_head{Pose{rotation(0.3), vector_within(0.05)},
                               Pose{rotation(0.3), vector_within(0.05)}};
    GazeSample sample;
    sample.sampled = {0, time::StampKind::Modelled};
    sample.head = head;
    for (EyeRay& ray : sample.eyes) {
        ray.direction = direction_ahead();
        ray.valid = true;
    }
    gaze.add(sample);
    const StereoView views{any_view(compose(head, in_head[0])),
                           any_view(compose(head, in_head[1]))};
    const FrameFovea frame = gaze.latch({1, time::StampKind::Modelled}, head, views);
    for (const Eye eye : kEyes) {
        const std::size_t i = index(eye);
        const glm::dvec3 expected =
            glm::conjugate(in_head[i].orientation) * sample.eyes[i].direction;
        RC_ASSERT(glm::length(frame.eyes[i].direction - expected) < 1e-12);
        const PixelPosition position = project(expected, views[i]);
        const double tolerance = 1e-6 * (views[i].width_px + views[i].height_px);
        RC_ASSERT(std::abs(frame.eyes[i].position.x_px - position.x_px) < tolerance);
        RC_ASSERT(std::abs(frame.eyes[i].position.y_px - position.y_px) < tolerance);
    }
}

time::Stamp any_stamp() {
    const auto kind = static_cast<time::StampKind>(
        *rc::gen::inRange<int>(0, static_cast<int>(time::kStampKindCount)));
    const auto ns = *rc::gen::arbitrary<bool>() ? *rc::gen::arbitrary<std::int64_t>()
                                                : *rc::gen::inRange<std::int64_t>(0, 1'000'000'000);
    return {ns, kind};
}

GazeSample any_sample() {
    GazeSample sample;
    sample.device_ns = *rc::gen::arbitrary<std::int64_t>();
    sample.sampled = any_stamp();
    sample.arrived = any_stamp();
    for (EyeRay& ray : sample.eyes) {
        ray.valid = *rc::gen::arbitrary<bool>();
        ray.direction = *rc::gen::arbitrary<bool>() ? any_vector() : vector_within(1.0);
        ray.confidence = *rc::gen::arbitrary<bool>() ? any_double() : 1.0;
    }
    if (*rc::gen::arbitrary<bool>()) {
        sample.head = Pose{rotation(), vector_within(2.0)};
        if (*rc::gen::arbitrary<bool>()) {
            sample.head->position_m = any_vector();
            sample.head->orientation.y = any_double();
        }
    }
    return sample;
}

RC_GTEST_PROP(GazeToFovea, StaysFiniteAndRepeatsItselfWhateverComes, ()) {
    const FoveaPolicy policy;
    GazeToFovea gaze(policy);
    GazeToFovea twin(policy);
    const int count = *rc::gen::inRange(0, 12);
    for (int i = 0; i < count; ++i) {
        const GazeSample sample = any_sample();
        gaze.add(sample);
        twin.add(sample);
        const Pose head{rotation(), vector_within(2.0)};
        const StereoView views{any_view(head), any_view(compose(head, {rotation(0.3), {}}))};
        const time::Stamp latched = any_stamp();
        const FrameFovea frame = gaze.latch(latched, head, views);
        const FrameFovea same = twin.latch(latched, head, views);
        for (const Eye eye : kEyes) {
            const FoveaPoint& point = frame.eyes[index(eye)];
            RC_ASSERT(within_limit(point.position, views[index(eye)], 2.5));
            RC_ASSERT(std::abs(glm::length(point.direction) - 1.0) < 1e-9);
            const bool tracking =
                point.state == FoveaState::Tracking || point.state == FoveaState::OtherEye;
            RC_ASSERT(tracking == (point.reason == LossReason::None));
            if (point.reason == LossReason::Never) {
                RC_ASSERT(point.state == FoveaState::Ahead);
            }
            const FoveaPoint& twins = same.eyes[index(eye)];
            RC_ASSERT(std::bit_cast<std::uint64_t>(point.position.x_px) ==
                      std::bit_cast<std::uint64_t>(twins.position.x_px));
            RC_ASSERT(std::bit_cast<std::uint64_t>(point.position.y_px) ==
                      std::bit_cast<std::uint64_t>(twins.position.y_px));
        }
    }
}

}  // namespace
}  // namespace gazeloop::gaze
