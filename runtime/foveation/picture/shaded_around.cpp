#include "runtime/foveation/picture/shaded_around.h"

#include <algorithm>

namespace gazeloop::foveation {
namespace {

/// The pixels of one axis that lie within reach of a pixel.
Columns around(std::uint32_t pixel, std::uint32_t reach, std::uint32_t size) {
    const std::uint64_t end = std::uint64_t{pixel} + reach + 1;
    return {pixel - std::min(pixel, reach),
            static_cast<std::uint32_t>(std::min<std::uint64_t>(end, size))};
}

}  // namespace

Tile shaded_around(const gaze::PixelPosition& place, std::uint32_t reach_x_px,
                   std::uint32_t reach_y_px, ImageSize image, std::span<const Columns> disc_bands) {
    if (!(place.x_px >= 0.0 && place.x_px < image.width_px && place.y_px >= 0.0 &&
          place.y_px < image.height_px)) {
        return {};
    }
    const auto x = static_cast<std::uint32_t>(place.x_px);
    const auto y = static_cast<std::uint32_t>(place.y_px);
    const std::size_t middle = y / kBandRows;
    if (middle >= disc_bands.size()) {
        return {};
    }
    Columns columns = common(around(x, reach_x_px, image.width_px), disc_bands[middle]);
    if (!(columns.first <= x && x < columns.end)) {
        return {};
    }
    const std::uint32_t enough = (columns.end - columns.first + 1) / 2;
    const auto takes = [&](std::size_t band) {
        const Columns left = common(columns, disc_bands[band]);
        const bool good = left.first <= x && x < left.end && left.end - left.first >= enough;
        columns = good ? left : columns;
        return good;
    };
    const Columns rows = around(y, reach_y_px, image.height_px);
    std::size_t first = middle;
    std::size_t last = middle;
    // Outwards on both sides at once, so that neither takes the columns from the other.
    for (bool up = true, down = true; up || down;) {
        up = up && first > rows.first / kBandRows && takes(first - 1);
        first -= up ? 1 : 0;
        down = down && last < (rows.end - 1) / kBandRows && last + 1 < disc_bands.size() &&
               takes(last + 1);
        last += down ? 1 : 0;
    }
    return {columns.first, std::max(rows.first, static_cast<std::uint32_t>(first) * kBandRows),
            columns.end, std::min(rows.end, (static_cast<std::uint32_t>(last) + 1) * kBandRows)};
}

}  // namespace gazeloop::foveation
