#include "drivers/trace/formats/angle_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/text/line_writer.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "angles";
constexpr std::array<std::string_view, 16> kColumns{"time_s",
                                                    "left_azimuth_deg",
                                                    "left_elevation_deg",
                                                    "left_openness",
                                                    "left_confidence",
                                                    "right_azimuth_deg",
                                                    "right_elevation_deg",
                                                    "right_openness",
                                                    "right_confidence",
                                                    "head_x_m",
                                                    "head_y_m",
                                                    "head_z_m",
                                                    "head_qx",
                                                    "head_qy",
                                                    "head_qz",
                                                    "head_qw"};
constexpr std::array<std::string_view, 7> kHead{"head_x_m", "head_y_m", "head_z_m", "head_qx",
                                                "head_qy",  "head_qz",  "head_qw"};
constexpr std::array<std::string_view, 1> kNeededTime{"time_s"};
constexpr std::array<std::string_view, 2> kNeededLeft{"left_azimuth_deg", "left_elevation_deg"};
constexpr std::array<std::string_view, 2> kNeededRight{"right_azimuth_deg", "right_elevation_deg"};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 2> kEyes{kNeededLeft, kNeededRight};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const std::string side{gaze::kEyeNames[gaze::index(eye)]};
    return {table,
            eye,
            {.valid = {},
             .direction = {side + "_azimuth_deg", side + "_elevation_deg"},
             .origin = {},
             .openness = side + "_openness",
             .confidence = side + "_confidence"},
            {.direction =
                 [](const glm::dvec3& angles_deg) {
                     return of_azimuth_elevation(glm::radians(angles_deg.x),
                                                 glm::radians(angles_deg.y));
                 },
             .bits = {}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const auto head = table.columns(kHead, "the head's pose");
    const std::size_t time = *table.column("time_s");
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "unknown device"});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 9, "seconds");
        const auto numbers = head ? rows.head(*head) : std::nullopt;
        if (!numbers) {
            return;
        }
        const auto [x, y, z, qx, qy, qz, qw] = *numbers;
        const glm::dquat turn{qw, qx, qy, qz};
        const double length = glm::length(turn);
        if (std::isnormal(length)) {
            row.head = gaze::Pose{turn / length, {x, y, z}};
        } else {
            rows.refuse_head(head->back(), "ends an orientation without length");
        }
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

/// Nanoseconds as seconds, exactly.
std::string seconds_text(std::int64_t ns) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    const bool negative = ns < 0;
    return fmt::format("{}{}.{:09}", negative ? "-" : "", std::abs(ns / kSecond_ns),
                       std::abs(ns % kSecond_ns));
}

}  // namespace

const TraceFormat& angle_table() { return kFormat; }

void write_angle_table(const gaze::RecordingView& trace, std::ostream& out) {
    out << fmt::format("{}\n", fmt::join(kColumns, ","));
    LineWriter line;
    for (const gaze::GazeSample& sample : trace.samples) {
        if (!sample.sampled.known()) {
            continue;
        }
        line.add_text(seconds_text(sample.sampled.ns));
        for (const gaze::EyeRay& ray : sample.eyes) {
            line.add_angles(ray);
            line.add_if_known(ray.openness);
            line.add_if_known(ray.confidence);
        }
        if (sample.head) {
            const glm::dquat& q = sample.head->orientation;
            line.add_finite(sample.head->position_m);
            line.add_finite({q.x, q.y, q.z});
            line.add_finite(q.w);
        } else {
            for (std::size_t i = 0; i < kHead.size(); ++i) {
                line.add_missing();
            }
        }
        line.end(out);
    }
}

}  // namespace gazeloop::drivers
