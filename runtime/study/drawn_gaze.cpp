#include "runtime/study/drawn_gaze.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace gazeloop::study {
namespace {

/// Of an eye, in its view.
glm::dvec3 ahead(const gaze::StereoView& views, std::size_t eye) {
    const glm::dquat head = glm::slerp(views[0].pose.orientation, views[1].pose.orientation, 0.5);
    return glm::conjugate(views[eye].pose.orientation) * (head * glm::dvec3{0.0, 0.0, -1.0});
}

}  // namespace

gaze::FrameFovea straight_ahead(const gaze::FrameFovea& latched, const gaze::StereoView& views) {
    gaze::FrameFovea foveae = latched;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        foveae.eyes[eye].direction = ahead(views, eye);
        foveae.eyes[eye].position = gaze::project(foveae.eyes[eye].direction, views[eye]);
    }
    return foveae;
}

double off_ahead_deg(const gaze::FrameFovea& latched, const gaze::StereoView& views) {
    double least = 180.0;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const glm::dvec3 a = ahead(views, eye);
        const glm::dvec3 b = latched.eyes[eye].direction;
        least = std::min(least,
                         glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))));
    }
    return least;
}

}  // namespace gazeloop::study
