#include "drivers/trace/screen_geometry.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>

namespace gazeloop::drivers {

std::expected<void, std::string> ScreenGeometry::check() const {
    constexpr double kMost_px = 1e5;
    constexpr double kLeast_m = 0.01;
    constexpr double kMost_m = 100.0;
    constexpr double kNearest_m = 0.05;
    const auto within = [](const glm::dvec2& size, double least, double most) {
        return size.x >= least && size.y >= least && size.x <= most && size.y <= most;
    };
    if (!within(size_px, 1.0, kMost_px)) {
        return std::unexpected(
            fmt::format("a resolution of {:.6g} x {:.6g} px is no screen's", size_px.x, size_px.y));
    }
    if (!within(size_m, kLeast_m, kMost_m)) {
        return std::unexpected(fmt::format(
            "a size of {:.6g} x {:.6g} m is no screen's: write it in metres", size_m.x, size_m.y));
    }
    if (!(distance_m() >= kNearest_m && distance_m() <= kMost_m)) {
        return std::unexpected(fmt::format(
            "a viewing distance of {:.6g} m cannot be: write it in metres", distance_m()));
    }
    return {};
}

glm::dvec3 ScreenGeometry::direction(const glm::dvec2& point_px) const {
    const glm::dvec2 from_middle = point_px / size_px - 0.5;
    return middle_m + glm::dvec3{from_middle.x * size_m.x * (from_left ? 1.0 : -1.0),
                                 from_middle.y * size_m.y * (from_top ? -1.0 : 1.0), 0.0};
}

std::string_view ScreenGeometry::loss_at(const glm::dvec2& point_px) const {
    constexpr double kScreens = 20.0;
    if (point_px == glm::dvec2{0.0} || point_px == glm::dvec2{-1.0}) {
        return "x and y are 0,0 or -1,-1, as trackers mark losses";
    }
    const auto is_mark = [](double coordinate_px) {
        const double whole_px = std::floor(coordinate_px);
        return whole_px == -32768.0 || whole_px == -9999.0;
    };
    const glm::dvec2 off = glm::abs(point_px / size_px - 0.5);
    return is_mark(point_px.x) || is_mark(point_px.y) || off.x > kScreens || off.y > kScreens
               ? "x or y is -32768, -9999 or more than 20 screens off, as trackers mark losses"
               : std::string_view{};
}

}  // namespace gazeloop::drivers
