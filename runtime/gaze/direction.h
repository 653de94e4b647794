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

}  // namespace gazeloop::gaze
