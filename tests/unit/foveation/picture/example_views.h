#pragma once

#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>

#include "runtime/foveation/picture/gaze_field.h"

namespace gazeloop::foveation {

/// A symmetrical view from its full angles.
inline gaze::EyeView symmetrical_view(std::uint32_t width_px, std::uint32_t height_px,
                                      double across_deg, double upward_deg) {
    const double x = glm::radians(across_deg / 2.0);
    const double y = glm::radians(upward_deg / 2.0);
    return {.fov = {-x, x, y, -y}, .width_px = width_px, .height_px = height_px};
}

/// The same with square pixels: the vertical angle follows.
inline gaze::EyeView square_pixel_view(std::uint32_t width_px, std::uint32_t height_px,
                                       double across_deg) {
    const double tangent = std::tan(glm::radians(across_deg / 2.0)) * height_px / width_px;
    return symmetrical_view(width_px, height_px, across_deg,
                            2.0 * glm::degrees(std::atan(tangent)));
}

inline gaze::EyeView fove_view() { return symmetrical_view(1280, 1440, 100.0, 100.0); }
inline gaze::EyeView square_2160_view() { return symmetrical_view(2160, 2160, 100.0, 100.0); }
inline gaze::EyeView xr4_view() { return symmetrical_view(3840, 3744, 120.0, 105.0); }
/// 110 degrees along the diagonal.
inline gaze::EyeView vive_pro_eye_view() {
    const double half = std::tan(glm::radians(55.0)) * 1440.0 / std::hypot(1440.0, 1600.0);
    return square_pixel_view(1440, 1600, 2.0 * glm::degrees(std::atan(half)));
}
/// 60 pixels per degree at the centre, 100 x 100 degrees.
inline gaze::EyeView retinal_view() { return symmetrical_view(8194, 8194, 100.0, 100.0); }

inline constexpr glm::dvec3 kAhead{0.0, 0.0, -1.0};

inline glm::dvec3 towards(double azimuth_deg, double elevation_deg) {
    const double azimuth = glm::radians(azimuth_deg);
    const double elevation = glm::radians(elevation_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

}  // namespace gazeloop::foveation
