#include "runtime/foveation/picture/cone_columns.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::foveation {
namespace {

/// Float rounding moves a pixel against the cone's edge by less than this: 4 ulp of a ray.
constexpr double kSlackRad = 4.0 / (1 << 24);
/// Pixels beside the cone's edge that are taken with it, against rounding of the row's span.
constexpr double kRowSlackPx = 0.02;

}  // namespace

Columns columns_within(const GazeFrame& frame, double eccentricity_rad, std::uint32_t y0,
                       std::uint32_t y1) {
    const double width = frame.view().width_px;
    Columns band{};
    for (std::uint32_t y = y0; y < y1; ++y) {
        const auto span = frame.row_within(y + 0.5, eccentricity_rad + kSlackRad);
        if (!span) {
            continue;
        }
        const double first = std::ceil(span->from_x_px - kRowSlackPx - 0.5);
        const double end = std::floor(span->to_x_px + kRowSlackPx + 0.5);
        const Columns row{static_cast<std::uint32_t>(std::clamp(first, 0.0, width)),
                          static_cast<std::uint32_t>(std::clamp(end, 0.0, width))};
        if (!row.empty()) {
            band = band.empty()
                       ? row
                       : Columns{std::min(band.first, row.first), std::max(band.end, row.end)};
        }
    }
    return band;
}

}  // namespace gazeloop::foveation
