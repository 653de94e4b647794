#include "runtime/light_field/camera_grid.h"

#include <fmt/format.h>

namespace gazeloop::light_field {

Expected<void> check(const CameraGrid& grid) {
    const auto outside = [](const char* what, double value, double least, double greatest) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{} = {}: must lie in [{}, {}]", what, value, least, greatest)});
    };
    const auto in = [](double value, double least, double greatest) {
        return value >= least && value <= greatest;  // no NaN
    };
    constexpr double kMost = CameraGrid::kMostPerSide;
    if (!in(grid.columns, 1.0, kMost)) {
        return outside("columns", grid.columns, 1.0, kMost);
    }
    if (!in(grid.rows, 1.0, kMost)) {
        return outside("rows", grid.rows, 1.0, kMost);
    }
    if (!in(grid.spacing_m, 1e-6, 10.0)) {
        return outside("spacing_m", grid.spacing_m, 1e-6, 10.0);
    }
    for (const double tangent : {grid.half_tangents.x, grid.half_tangents.y}) {
        if (!in(tangent, 1e-3, 100.0)) {
            return outside("the tangent of half a field of view", tangent, 1e-3, 100.0);
        }
    }
    return {};
}

}  // namespace gazeloop::light_field
