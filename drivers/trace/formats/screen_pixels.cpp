#include "drivers/trace/formats/screen_pixels.h"

#include <array>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/screen_sidecar.h"
#include "drivers/trace/trace_rows.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "screen-px";
constexpr std::array<std::string_view, 3> kColumns{"t_ms", "x_px", "y_px"};
constexpr std::array<ColumnNames, 1> kAll{kColumns};
constexpr std::array<std::span<const ColumnNames>, 1> kNeeded{kAll};
EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    return {
        table,
        eye,
        {.valid = {},
         .direction = {"x_px", "y_px"},
         .origin = {},
         .openness = {},
         .confidence = {}},
        // The screen's geometry makes the direction, once both numbers are there.
        {.direction =
             [](const glm::dvec3& point_px) { return glm::dvec3{point_px.x, point_px.y, -1.0}; },
         .bits = {}}};
}

Expected<gaze::GazeTrace> read(CsvTable& table, const TraceFile& file, const ReadOptions& options) {
    const Expected<ScreenSidecar> sidecar = read_screen_sidecar(file, table.name());
    if (!sidecar) {
        return std::unexpected(sidecar.error());
    }
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const std::size_t time = *table.column("t_ms");
    const std::size_t x = *table.column("x_px");
    const std::size_t y = *table.column("y_px");
    const double parallax_rad = combined_parallax_rad(sidecar->screen.distance_m());
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "tracker at a screen"});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 6, "milliseconds");
        row.parallax_rad = parallax_rad;
        const auto x_px = table.real(x);
        const auto y_px = table.real(y);
        if (!x_px || !y_px) {
            return;
        }
        if (sidecar->zero_is_missing && *x_px == 0.0 && *y_px == 0.0) {
            rows.refuse_eyes(row, "x and y are 0,0");
            return;
        }
        const auto direction = gaze::unit(sidecar->screen.direction({*x_px, *y_px}));
        if (!direction) {
            rows.refuse_eyes(row, "a point too far from the screen for a direction");
            return;
        }
        for (gaze::EyeRay& ray : row.eyes) {
            ray.valid = true;
            ray.direction = *direction;
        }
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& screen_pixels() { return kFormat; }

}  // namespace gazeloop::drivers
