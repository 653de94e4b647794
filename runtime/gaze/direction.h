#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace gazeloop::gaze {

inline constexpr glm::dvec3 kStraightAhead{0.0, 0.0, -1.0};

[[nodiscard]] inline bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The unit vector along `v`, of any length that is not zero; none where `v` is zero or not finite.
[[nodiscard]] inline std::optional<glm::dvec3> unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!is_finite(v) || largest == 0.0) {
        return std::nullopt;
    }
    return glm::normalize(v / largest);  // squares of very small or large components stay in range
}

/// A unit vector at a right angle to the unit vector v.
[[nodiscard]] inline glm::dvec3 perpendicular(const glm::dvec3& v) {
    const glm::dvec3 up{0.0, 1.0, 0.0};
    const glm::dvec3 right{1.0, 0.0, 0.0};
    return glm::normalize(glm::cross(v, std::abs(v.y) < 0.9 ? up : right));
}

/// On the great circle from one unit vector to another; where they are opposite, on one of them.
[[nodiscard]] inline glm::dvec3 interpolate(const glm::dvec3& from, const glm::dvec3& to,
                                            double fraction) {
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal);
    const double cosine = glm::dot(from, to);
    constexpr double kParallel = 1e-12;
    if (sine < kParallel && cosine > 0.0) {
        return to;
    }
    const glm::dvec3 axis = sine < kParallel ? perpendicular(from) : normal / sine;
    const double angle = std::atan2(sine, cosine) * fraction;
    return std::cos(angle) * from + std::sin(angle) * glm::cross(axis, from);
}

/// The angle between two vectors that are not zero, radians.
[[nodiscard]] inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace gazeloop::gaze
