#include "drivers/trace/formats/aria.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <string>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "aria";
constexpr std::string_view kTime = "tracking_timestamp_us";
constexpr std::string_view kYaw = "yaw_rads_cpf";
constexpr std::string_view kPitch = "pitch_rads_cpf";
constexpr std::string_view kDepth = "depth_m";
constexpr std::array<std::string_view, 14> kColumns{
    kTime,
    kYaw,
    kPitch,
    kDepth,
    "left_yaw_rads_cpf",
    "left_pitch_rads_cpf",
    "tx_left_eye_cpf",
    "ty_left_eye_cpf",
    "tz_left_eye_cpf",
    "right_yaw_rads_cpf",
    "right_pitch_rads_cpf",
    "tx_right_eye_cpf",
    "ty_right_eye_cpf",
    "tz_right_eye_cpf",
};
constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 2> kNeededBoth{kYaw, kPitch};
constexpr std::array<std::string_view, 2> kNeededGen1{"left_yaw_rads_cpf", kPitch};
constexpr std::array<std::string_view, 2> kNeededGen2{"left_yaw_rads_cpf", "left_pitch_rads_cpf"};
constexpr std::array<std::string_view, 2> kNeededRight1{"right_yaw_rads_cpf", kPitch};
constexpr std::array<std::string_view, 2> kNeededRight2{"right_yaw_rads_cpf",
                                                        "right_pitch_rads_cpf"};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 5> kAngles{kNeededGen2, kNeededGen1, kNeededBoth, kNeededRight2,
                                             kNeededRight1};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kAngles};

/// Which of the ways a file has its angles.
enum class Angles { PerEye, CommonPitch, Combined };

Angles angles_of(const CsvTable& table) {
    if (!table.has("left_yaw_rads_cpf") && !table.has("right_yaw_rads_cpf")) {
        return Angles::Combined;
    }
    return table.has("left_pitch_rads_cpf") || table.has("right_pitch_rads_cpf")
               ? Angles::PerEye
               : Angles::CommonPitch;
}

EyeCells eye_cells(CsvTable& table, gaze::Eye eye, Angles angles) {
    const std::string_view side = gaze::kEyeNames[gaze::index(eye)];
    const auto angle = [&](std::string_view name, bool of_eye) {
        return of_eye ? fmt::format("{}_{}", side, name) : std::string{name};
    };
    const auto place = [&](std::string_view axis) {
        return fmt::format("{}_{}_eye_cpf", axis, side);
    };
    const auto by_sines = [](const glm::dvec3& yaw_pitch_rad) {
        return of_azimuth_elevation(-yaw_pitch_rad.x, yaw_pitch_rad.y);
    };
    const auto by_tangents = [](const glm::dvec3& yaw_pitch_rad) {
        return glm::dvec3{-std::tan(within_a_turn(yaw_pitch_rad.x)),
                          std::tan(within_a_turn(yaw_pitch_rad.y)), -1.0};
    };
    EyeForm form{.to_our_axes = {-1.0, 1.0, -1.0}, .bits = {}};
    form.direction = angles == Angles::PerEye ? +by_sines : +by_tangents;
    return {table,
            eye,
            {.valid = {},
             .direction = {angle(kYaw, angles != Angles::Combined),
                           angle(kPitch, angles == Angles::PerEye)},
             .origin = {place("tx"), place("ty"), place("tz")},
             .openness = {},
             .confidence = {}},
            form};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    const Angles angles = angles_of(table);
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left, angles),
                                eye_cells(table, gaze::Eye::Right, angles)};
    const std::size_t time = *table.column(kTime);
    const auto depth = angles == Angles::Combined ? table.column(kDepth) : std::nullopt;
    const double anywhere_rad = combined_parallax_rad();
    TraceRows rows(table, eyes,
                   {.file = table.name(),
                    .format = kName,
                    .device = angles == Angles::PerEye ? "Aria Gen 2" : "Aria",
                    .device_tick_ns = 1e3});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.ticks(time, "microseconds");
        if (angles == Angles::Combined) {
            const auto depth_m = depth ? table.real(*depth) : std::nullopt;
            row.parallax_rad =
                depth_m && *depth_m > 0.0 ? combined_parallax_rad(*depth_m) : anywhere_rad;
        }
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& aria() { return kFormat; }

}  // namespace gazeloop::drivers
