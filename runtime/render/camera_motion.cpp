#include "runtime/render/camera_motion.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace gazeloop::render {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kPan_deg = 15.0;
constexpr double kPanPeriod_s = 6.0;
/// Scenes are made to be seen from within half a metre of where their viewer starts.
constexpr double kCircle_m = 0.2;
constexpr double kSlowest_m_s = 0.025;

}  // namespace

gaze::StereoView carried(CameraMotion motion, const gaze::StereoView& views, double scene_time_s) {
    gaze::StereoView moved = views;
    if (motion == CameraMotion::Pan) {
        const double angle = glm::radians(kPan_deg) * std::sin(kTurn * scene_time_s / kPanPeriod_s);
        const glm::dquat turn = glm::angleAxis(angle, glm::dvec3{0.0, 1.0, 0.0});
        for (gaze::EyeView& view : moved) {
            view.pose.orientation = turn * view.pose.orientation;
            view.pose.position_m = turn * view.pose.position_m;
        }
    } else if (motion != CameraMotion::Still) {
        const int doublings = static_cast<int>(motion) - static_cast<int>(CameraMotion::Fly1);
        const double angle = std::ldexp(kSlowest_m_s, doublings) / kCircle_m * scene_time_s;
        for (gaze::EyeView& view : moved) {
            view.pose.position_m += kCircle_m * glm::dvec3{std::cos(angle), 0.0, std::sin(angle)};
        }
    }
    return moved;
}

}  // namespace gazeloop::render
