#include "drivers/trace/formats/pupil_core.h"

#include <array>
#include <string>

#include "drivers/trace/eye_cells.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "pupil-core";
constexpr std::string_view kTime = "gaze_timestamp";
constexpr std::string_view kConfidence = "confidence";
constexpr std::array<std::string_view, 14> kColumns{
    kTime,
    kConfidence,
    "gaze_normal0_x",
    "gaze_normal0_y",
    "gaze_normal0_z",
    "gaze_normal1_x",
    "gaze_normal1_y",
    "gaze_normal1_z",
    "eye_center0_3d_x",
    "eye_center0_3d_y",
    "eye_center0_3d_z",
    "eye_center1_3d_x",
    "eye_center1_3d_y",
    "eye_center1_3d_z",
};
constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 3> kNeededRight{kColumns[2], kColumns[3], kColumns[4]};
constexpr std::array<std::string_view, 3> kNeededLeft{kColumns[5], kColumns[6], kColumns[7]};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 2> kEyes{kNeededRight, kNeededLeft};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

/// Pupil counts the eyes from the wearer's right.
EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const std::string number{eye == gaze::Eye::Left ? "1" : "0"};
    const std::string direction = "gaze_normal" + number;
    const std::string origin = "eye_center" + number + "_3d";
    return {table,
            eye,
            {.valid = {},
             .direction = {direction + "_x", direction + "_y", direction + "_z"},
             .origin = {origin + "_x", origin + "_y", origin + "_z"},
             .openness = {},
             .confidence = std::string{kConfidence}},
            {.to_our_axes = {1.0, -1.0, -1.0}, .metre = 1e-3, .bits = {}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    constexpr double kUseful = 0.6;
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const std::size_t time = *table.column(kTime);
    const auto confidence = table.column(kConfidence);
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "Pupil Labs Core"});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 9, "seconds");
        const auto sure = confidence ? table.real(*confidence) : std::nullopt;
        if (sure && !(*sure > kUseful)) {
            rows.refuse_eyes(row, "confidence of .6 or less");
        }
    });
}

constexpr TraceFormat kFormat{
    kName, kColumns, kNeeded, read,
    "norm_pos needs the camera's geometry: map the gaze with the 3D gazer, and export again"};

}  // namespace

const TraceFormat& pupil_core() { return kFormat; }

}  // namespace gazeloop::drivers
