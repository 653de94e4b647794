#include "drivers/trace/formats/gazebase_vr.h"

#include <array>
#include <glm/trigonometric.hpp>
#include <string>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "gazebase-vr";
constexpr std::string_view kTime = "n";
constexpr std::array<std::string_view, 11> kColumns{kTime, "lx",  "ly",  "rx",  "ry", "clx",
                                                    "cly", "clz", "crx", "cry", "crz"};
constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 2> kNeededLeft{"lx", "ly"};
constexpr std::array<std::string_view, 2> kNeededRight{"rx", "ry"};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 2> kEyes{kNeededLeft, kNeededRight};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const std::string side{eye == gaze::Eye::Left ? "l" : "r"};
    const std::string origin = "c" + side;
    return {table,
            eye,
            {.valid = {},
             .direction = {side + "x", side + "y"},
             .origin = {origin + "x", origin + "y", origin + "z"},
             .openness = {},
             .confidence = {}},
            // Places have +Z forward, as the angles' own vectors.
            {.to_our_axes = {1.0, 1.0, -1.0},
             .direction =
                 [](const glm::dvec3& angles_deg) {
                     return of_median_angles(glm::radians(angles_deg.x),
                                             glm::radians(angles_deg.y));
                 },
             .bits = {}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const std::size_t time = *table.column(kTime);
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "HTC Vive of GazeBaseVR"});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 6, "milliseconds");
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& gazebase_vr() { return kFormat; }

}  // namespace gazeloop::drivers
