#include "drivers/trace/htc_vive_pro.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/trace/eye_cells.h"
#include "drivers/trace/trace_rows.h"
#include "drivers/trace/unity_pose.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "htc-vive-pro";
constexpr std::string_view kTime = "time(100ns)";
constexpr std::string_view kTimeStamp = "time_stamp(ms)";

constexpr std::array<std::string_view, 24> kColumns{
    kTime,
    kTimeStamp,
    "eye_valid_L",
    "openness_L",
    "gaze_origin_L.x(mm)",
    "gaze_origin_L.y(mm)",
    "gaze_origin_L.z(mm)",
    "gaze_direct_L.x",
    "gaze_direct_L.y",
    "gaze_direct_L.z",
    "eye_valid_R",
    "openness_R",
    "gaze_origin_R.x(mm)",
    "gaze_origin_R.y(mm)",
    "gaze_origin_R.z(mm)",
    "gaze_direct_R.x",
    "gaze_direct_R.y",
    "gaze_direct_R.z",
    "helmet_pos_x",
    "helmet_pos_y",
    "helmet_pos_z",
    "helmet_rot_x",
    "helmet_rot_y",
    "helmet_rot_z",
};
constexpr std::array<std::string_view, 6> kHelmetColumns{
    "helmet_pos_x", "helmet_pos_y", "helmet_pos_z", "helmet_rot_x", "helmet_rot_y", "helmet_rot_z",
};

constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 1> kNeededTimeStamp{kTimeStamp};
constexpr std::array<std::string_view, 4> kNeededLeft{"eye_valid_L", "gaze_direct_L.x",
                                                      "gaze_direct_L.y", "gaze_direct_L.z"};
constexpr std::array<std::string_view, 4> kNeededRight{"eye_valid_R", "gaze_direct_R.x",
                                                       "gaze_direct_R.y", "gaze_direct_R.z"};
constexpr std::array<ColumnNames, 2> kTimes{kNeededTime, kNeededTimeStamp};
constexpr std::array<ColumnNames, 2> kEyes{kNeededLeft, kNeededRight};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

/// SRanipal's bits of an eye's validity. The others, 2 and 4, are the pupil's diameter and place.
constexpr int kOriginBit = 0;
constexpr int kDirectionBit = 1;
constexpr int kOpennessBit = 3;

std::optional<EyeTrust> trust(CsvTable& table, std::size_t column) {
    constexpr std::int64_t kAllBits = 31;
    const std::optional<std::int64_t> valid = table.whole(column);
    if (!valid || *valid < 0 || *valid > kAllBits) {
        return std::nullopt;
    }
    const auto has = [&](int bit) { return (*valid >> bit & 1) != 0; };
    return EyeTrust{
        .direction = has(kDirectionBit), .origin = has(kOriginBit), .openness = has(kOpennessBit)};
}

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const std::string side{eye == gaze::Eye::Left ? "L" : "R"};
    const std::string origin = "gaze_origin_" + side;
    const std::string direction = "gaze_direct_" + side;
    return {table,
            eye,
            {.valid = "eye_valid_" + side,
             .direction = {direction + ".x", direction + ".y", direction + ".z"},
             .origin = {origin + ".x(mm)", origin + ".y(mm)", origin + ".z(mm)"},
             .openness = "openness_" + side,
             .confidence = {}},
            // +X left, +Z forward to +X right, -Z forward: half a turn about +Y.
            {.trust = trust,
             .to_our_axes = {-1.0, 1.0, -1.0},
             .metre = 1e-3,
             .bits = {{kDirectionBit, kOriginBit, kOpennessBit}}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    constexpr double kTime_ns = 100.0;
    constexpr double kTimeStamp_ns = 1e6;
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const auto helmet = table.columns(kHelmetColumns, "the helmet's pose");
    const auto time = table.column(kTime);
    const auto time_stamp = table.column(kTimeStamp);
    TraceRows rows(table, eyes,
                   {.file = table.name(),
                    .format = kName,
                    .device = "HTC Vive Pro",
                    .device_tick_ns = time ? kTime_ns : kTimeStamp_ns,
                    .other_tick_ns = kTimeStamp_ns,
                    .other_clock = kTimeStamp});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks =
            time ? rows.ticks(*time, "100 ns") : rows.ticks(*time_stamp, "milliseconds");
        if (time && time_stamp) {
            row.other_ticks = table.whole(*time_stamp);
        }
        if (helmet) {
            if (const auto pose = rows.head(*helmet)) {
                row.head = pose_of_unity(*pose);
            }
        }
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& htc_vive_pro() { return kFormat; }

}  // namespace gazeloop::drivers
