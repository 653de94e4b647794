#include "runtime/render/camera_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace gazeloop::render {
namespace {

gaze::StereoView standing_views() {
    gaze::StereoView views;
    views[0].pose.position_m = {-0.03, 0.1, 0.2};
    views[1].pose.position_m = {0.03, 0.1, 0.2};
    return views;
}

TEST(CameraMotion, StandsStill) {
    EXPECT_EQ(carried(CameraMotion::Still, standing_views(), 7.0)[0].pose.position_m,
              standing_views()[0].pose.position_m);
}

TEST(CameraMotion, FliesAtItsSpeedWithinTheCircle) {
    double speed_m_s = 0.025;
    for (int fly = static_cast<int>(CameraMotion::Fly1);
         fly <= static_cast<int>(CameraMotion::Fly6); ++fly) {
        const auto motion = static_cast<CameraMotion>(fly);
        for (const double time_s : {0.0, 1.0, 33.3}) {
            const auto now = carried(motion, standing_views(), time_s);
            const auto then = carried(motion, standing_views(), time_s + 1e-4);
            for (std::size_t eye = 0; eye < 2; ++eye) {
                EXPECT_NEAR(glm::length(then[eye].pose.position_m - now[eye].pose.position_m),
                            speed_m_s * 1e-4, 1e-9);
                EXPECT_NEAR(
                    glm::length(now[eye].pose.position_m - standing_views()[eye].pose.position_m),
                    0.2, 1e-9);
                EXPECT_EQ(now[eye].pose.orientation, standing_views()[eye].pose.orientation);
            }
        }
        speed_m_s *= 2.0;
    }
    EXPECT_NEAR(speed_m_s, 1.6, 1e-12);
}

TEST(CameraMotion, PansBothEyesTogether) {
    double most_deg = 0.0;
    for (double time_s = 0.0; time_s < 6.0; time_s += 0.1) {
        const auto views = carried(CameraMotion::Pan, standing_views(), time_s);
        EXPECT_NEAR(glm::length(views[1].pose.position_m - views[0].pose.position_m), 0.06, 1e-12);
        const glm::dvec3 ahead = views[0].pose.orientation * glm::dvec3{0.0, 0.0, -1.0};
        EXPECT_NEAR(ahead.y, 0.0, 1e-12);
        most_deg = std::max(most_deg, glm::degrees(std::abs(std::atan2(ahead.x, -ahead.z))));
    }
    EXPECT_NEAR(most_deg, 15.0, 0.05);
    EXPECT_EQ(carried(CameraMotion::Pan, standing_views(), 0.0)[0].pose.position_m,
              standing_views()[0].pose.position_m);
}

}  // namespace
}  // namespace gazeloop::render
