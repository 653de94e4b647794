#pragma once

#include <array>
#include <expected>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace gazeloop::drivers {

/// A screen before a viewer. The head's frame is the screen's: -Z points at it at a right angle,
/// +X is its right and +Y its top; its middle lies at `middle_m`, whose z is below 0.
struct ScreenGeometry {
    glm::dvec2 size_m{0.0};
    glm::dvec2 size_px{0.0};
    glm::dvec3 middle_m{0.0};
    bool from_left = true;  ///< where pixels are counted from
    bool from_top = true;

    /// What makes this no screen before a viewer, in words; nothing if it is one. Bounds: 1 px to
    /// 100,000 px, 1 cm to 100 m, a distance of 5 cm to 100 m.
    [[nodiscard]] std::expected<void, std::string> check() const;

    /// Toward a point of the screen or beside it, not of unit length. Pixel centres are at +.5.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& point_px) const;
    /// Why a point is no place that somebody looked at but a mark of a loss; empty where it may be
    /// one. Trackers write losses as 0,0 or -1,-1, which are no gaze but by chance, or as numbers
    /// far off: -32768, -9999 or 1e8. What their noise makes of a blink lies up to 10 screens off.
    [[nodiscard]] std::string_view loss_at(const glm::dvec2& point_px) const;
    [[nodiscard]] double distance_m() const { return -middle_m.z; }
};

}  // namespace gazeloop::drivers
