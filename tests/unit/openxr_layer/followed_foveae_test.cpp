#include "runtime/openxr_layer/followed_foveae.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

namespace gazeloop::openxr_layer {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

gaze::GazeSample looking(std::int64_t ns, double azimuth_deg) {
    gaze::GazeSample sample;
    sample.sampled = sample.arrived = sample.ready = {ns, time::StampKind::Measured};
    sample.sequence = static_cast<std::uint64_t>(ns / kMillisecond_ns);
    for (gaze::EyeRay& eye : sample.eyes) {
        eye.valid = true;
        eye.direction = {std::sin(glm::radians(azimuth_deg)), 0.0,
                         -std::cos(glm::radians(azimuth_deg))};
    }
    return sample;
}

gaze::StereoView views() {
    gaze::StereoView views;
    for (gaze::EyeView& view : views) {
        view = {.pose = {}, .fov = {-0.8, 0.8, 0.7, -0.7}, .width_px = 1000, .height_px = 500};
    }
    return views;
}

TEST(FollowedFoveae, LieWhereTheEyesLook) {
    FollowedFoveae foveae({});
    GazeHistory history({});
    gaze::GazeSample sample = looking(100 * kMillisecond_ns, 10.0);
    // Of the source's own world: it must not turn the gaze in the head.
    sample.head = gaze::Pose{glm::dquat(0.0, 0.0, 1.0, 0.0), {5.0, 0.0, 0.0}};
    history.add(sample);
    foveae.take(history);
    const gaze::FrameFovea fovea =
        foveae.latch(101 * kMillisecond_ns, views(), 110 * kMillisecond_ns);
    const double expected = std::tan(glm::radians(10.0)) / std::tan(0.8);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        EXPECT_EQ(fovea.eyes[eye].state, gaze::FoveaState::Tracking);
        const CentredPlace place = centred_place(fovea.eyes[eye].position, views()[eye]);
        EXPECT_NEAR(place.x, expected, 1e-9);
        EXPECT_NEAR(place.y, 0.0, 1e-9);
    }
}

TEST(FollowedFoveae, ReturnAheadWhenGazeIsLost) {
    FollowedFoveae foveae({});
    GazeHistory history({});
    history.add(looking(100 * kMillisecond_ns, 20.0));
    foveae.take(history);
    foveae.take(history);  // nothing is taken twice
    EXPECT_EQ(foveae.latch(5'000 * kMillisecond_ns, views(), std::nullopt).eyes[0].state,
              gaze::FoveaState::Ahead);
}

TEST(FollowedFoveae, TakeEverySampleOfAFullHistory) {
    FollowedFoveae foveae({});
    GazeHistory history({});
    for (std::int64_t ms = 1; ms < 4'000; ++ms) {
        history.add(looking(ms * kMillisecond_ns, static_cast<double>(ms % 20)));
    }
    foveae.take(history);
    history.add(looking(4'000 * kMillisecond_ns, 7.0));
    foveae.take(history);
    const auto fovea = foveae.latch(4'001 * kMillisecond_ns, views(), std::nullopt);
    EXPECT_NEAR(centred_place(fovea.eyes[0].position, views()[0]).x,
                std::tan(glm::radians(7.0)) / std::tan(0.8), 1e-9);
}

TEST(CentredPlace, IsInThePicture) {
    const gaze::EyeView view = views()[0];
    EXPECT_DOUBLE_EQ(centred_place({0.0, 0.0}, view).x, -1.0);
    EXPECT_DOUBLE_EQ(centred_place({0.0, 0.0}, view).y, 1.0);
    EXPECT_DOUBLE_EQ(centred_place({500.0, 250.0}, view).y, 0.0);
    EXPECT_DOUBLE_EQ(centred_place({16384.0, -16384.0}, view).x, 1.0);
    EXPECT_DOUBLE_EQ(centred_place({16384.0, -16384.0}, view).y, 1.0);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
