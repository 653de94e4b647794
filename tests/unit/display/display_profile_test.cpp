#include "runtime/display/display_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/gaze_to_fovea.h"

namespace gazeloop::display {
namespace {

DisplayProfile canted(double left_deg, double right_deg) {
    const auto fov = [](double left, double right) {
        return gaze::FieldOfView{glm::radians(left), glm::radians(right), glm::radians(50.0),
                                 glm::radians(-48.0)};
    };
    DisplayProfile display;
    display.fov = {fov(-55.0, 42.0), fov(-42.0, 55.0)};
    display.cant_outward_rad = {glm::radians(left_deg), glm::radians(right_deg)};
    display.ipd_m = 0.064;
    return display;
}

gaze::StereoView views_of(const DisplayProfile& display) {
    return {profile_view(display, gaze::Eye::Left, 1440, 1600),
            profile_view(display, gaze::Eye::Right, 1440, 1600)};
}

TEST(ProfileView, TurnsEachEyeOutward) {
    const gaze::StereoView views = views_of(canted(10.0, 10.0));
    const glm::dvec3 left = views[0].pose.orientation * glm::dvec3{0.0, 0.0, -1.0};
    const glm::dvec3 right = views[1].pose.orientation * glm::dvec3{0.0, 0.0, -1.0};
    EXPECT_NEAR(left.x, -std::sin(glm::radians(10.0)), 1e-15);
    EXPECT_NEAR(right.x, std::sin(glm::radians(10.0)), 1e-15);
    EXPECT_EQ(views[0].pose.position_m, glm::dvec3(-0.032, 0.0, 0.0));
    EXPECT_EQ(views[1].pose.position_m, glm::dvec3(0.032, 0.0, 0.0));
}

TEST(ProfileView, IsParallelWithoutCanting) {
    const gaze::StereoView views = views_of(canted(0.0, 0.0));
    EXPECT_EQ(views[0].pose.orientation, glm::dquat(1.0, 0.0, 0.0, 0.0));
    EXPECT_EQ(views[1].pose.orientation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

class CantedBy : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(CantedBy, ProjectsAndUnprojects) {
    const DisplayProfile display = canted(GetParam().first, GetParam().second);
    for (const gaze::EyeView& view : views_of(display)) {
        for (double x = 0.0; x <= 1440.0; x += 144.0) {
            for (double y = 0.0; y <= 1600.0; y += 160.0) {
                const auto back = gaze::project(gaze::unproject({x, y}, view), view);
                EXPECT_NEAR(back.x_px, x, 1e-9);
                EXPECT_NEAR(back.y_px, y, 1e-9);
            }
        }
    }
}

// Both eyes look at a point; the rays through their foveae, from where the eyes are, meet there.
TEST_P(CantedBy, PutsBothFoveaeOnThePointThatIsLookedAt) {
    const gaze::StereoView views = views_of(canted(GetParam().first, GetParam().second));
    gaze::GazeToFovea gaze({});
    std::int64_t time_ns = 0;
    for (const glm::dvec3& point_m : {glm::dvec3{0.0, 0.0, -0.5}, glm::dvec3{-0.3, 0.2, -0.8},
                                      glm::dvec3{0.4, -0.1, -1.5}, glm::dvec3{0.02, 0.3, -3.0}}) {
        gaze::GazeSample sample;
        sample.device_ns = ++time_ns;
        sample.sampled = {time_ns, time::StampKind::Modelled};
        sample.arrived = sample.sampled;
        for (std::size_t eye = 0; eye < 2; ++eye) {
            sample.eyes[eye].direction = glm::normalize(point_m - views[eye].pose.position_m);
            sample.eyes[eye].valid = true;
        }
        gaze.add(sample);
        const gaze::FrameFovea fovea = gaze.latch(sample.arrived, {}, views);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            ASSERT_EQ(fovea.eyes[eye].state, gaze::FoveaState::Tracking);
            const glm::dvec3 along =
                views[eye].pose.orientation * gaze::unproject(fovea.eyes[eye].position, views[eye]);
            const glm::dvec3 to = point_m - views[eye].pose.position_m;
            EXPECT_LT(glm::length(glm::cross(along, to)), 1e-12) << "m off the point";
            EXPECT_GT(glm::dot(along, to), 0.0);
        }
    }
}

// Without gaze both eyes look straight ahead of the head, wherever the views point.
TEST_P(CantedBy, CentresOnTheHeadsAxis) {
    const gaze::StereoView views = views_of(canted(GetParam().first, GetParam().second));
    const gaze::FrameFovea fovea =
        gaze::GazeToFovea({}).latch({1, time::StampKind::Modelled}, {}, views);
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const glm::dvec3 along = views[eye].pose.orientation * fovea.eyes[eye].direction;
        EXPECT_NEAR(along.z, -1.0, 1e-15);
        EXPECT_LT(std::abs(along.x), 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(Angles, CantedBy,
                         testing::Values(std::pair{0.0, 0.0}, std::pair{5.0, 5.0},
                                         std::pair{10.0, 10.0}, std::pair{-7.5, 3.0},
                                         std::pair{35.0, -35.0}));

TEST(DisplayProfile, SaysWhatSpreadsItsRows) {
    DisplayProfile display;
    display.scan_out_ns = 8'000'000;
    EXPECT_EQ(display.rolling_ns(), std::nullopt) << "illumination unknown";
    display.illumination = Illumination::Global;
    EXPECT_EQ(display.rolling_ns(), 0);
    display.illumination = Illumination::Rolling;
    EXPECT_EQ(display.rolling_ns(), 8'000'000);
    display.scan_out_ns.reset();
    EXPECT_EQ(display.rolling_ns(), std::nullopt);
}

TEST(DisplayProfile, NamesItsAssumedPhotonFigures) {
    DisplayProfile display;
    display.assumed = {"optics.ipd_mm", "photons.switching_ms", "photons.scan_out_ms"};
    EXPECT_EQ(display.assumed_photons(), "switching_ms, scan_out_ms");
}

}  // namespace
}  // namespace gazeloop::display
