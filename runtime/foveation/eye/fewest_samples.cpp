#include "runtime/foveation/eye/fewest_samples.h"

#include <algorithm>
#include <cstdint>

namespace gazeloop::foveation {

double fewest_samples(const GazeField& field, const AcuityModel& model, gaze::Eye eye) {
    constexpr std::uint32_t kCells = 512;
    const std::uint32_t columns = std::min(kCells, field.view().width_px);
    const std::uint32_t rows = std::min(kCells, field.view().height_px);
    const double cell_width_px = static_cast<double>(field.view().width_px) / columns;
    const double cell_height_px = static_cast<double>(field.view().height_px) / rows;
    const double cell_px = cell_width_px * cell_height_px;
    double samples = 0.0;
    for (std::uint32_t row = 0; row < rows; ++row) {
        double row_samples = 0.0;  // summed by rows: small errors only
        for (std::uint32_t column = 0; column < columns; ++column) {
            const FieldPoint at = field.at(
                gaze::PixelPosition{(column + 0.5) * cell_width_px, (row + 0.5) * cell_height_px});
            const double needed =
                required_per_deg(model, at.eccentricity_deg, nasal_share(eye, at.direction_rad));
            row_samples += std::min(1.0, needed * needed * field.pixel_area_deg2(at.pixel));
        }
        samples += row_samples * cell_px;
    }
    return samples;
}

}  // namespace gazeloop::foveation
