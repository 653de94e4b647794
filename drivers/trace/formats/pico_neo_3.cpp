#include "drivers/trace/formats/pico_neo_3.h"

#include <array>
#include <optional>
#include <string>

#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/trace_rows.h"
#include "drivers/trace/unity_pose.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "pico-neo-3";
constexpr std::string_view kTime = "Timeline";
constexpr std::string_view kState = "Foveated Gaze Tracking State";
constexpr std::array<std::string_view, 13> kColumns{
    kTime,
    "Combine Eye Gaze Vector. x",
    "Combine Eye Gaze Vector. y",
    "Combine Eye Gaze Vector. z",
    kState,
    "Left Eye Gaze Openness",
    "Right Eye Gaze Openness",
    "Head Position. x",
    "Head Position. y",
    "Head Position. z",
    "Head Rotation. x",
    "Head Rotation. y",
    "Head Rotation. z",
};
constexpr std::array<std::string_view, 6> kHead{"Head Position. x", "Head Position. y",
                                                "Head Position. z", "Head Rotation. x",
                                                "Head Rotation. y", "Head Rotation. z"};
constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 3> kNeededVector{kColumns[1], kColumns[2], kColumns[3]};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 1> kVectors{kNeededVector};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kVectors};

std::optional<EyeTrust> trust(CsvTable& table, std::size_t column) {
    const std::optional<std::int64_t> state = table.whole(column);
    if (!state) {
        return std::nullopt;
    }
    return EyeTrust{.direction = *state == 0, .origin = true, .openness = true};
}

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const bool has_state = table.has(kState);
    return {
        table,
        eye,
        {.valid = has_state ? std::string{kState} : std::string{},
         .direction = {std::string{kColumns[1]}, std::string{kColumns[2]},
                       std::string{kColumns[3]}},
         .origin = {},
         .openness = eye == gaze::Eye::Left ? "Left Eye Gaze Openness" : "Right Eye Gaze Openness",
         .confidence = {}},
        {.trust = has_state ? trust : nullptr, .to_our_axes = {1.0, 1.0, -1.0}, .bits = {}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const auto head = table.columns(kHead, "the head's pose");
    const std::size_t time = *table.column(kTime);
    const double parallax_rad = combined_parallax_rad();
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "Pico Neo 3 Pro"});
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, 9, "seconds");
        row.parallax_rad = parallax_rad;
        const auto pose = head ? rows.head(*head) : std::nullopt;
        if (pose) {
            row.head = pose_of_unity(*pose);
        }
    });
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& pico_neo_3() { return kFormat; }

}  // namespace gazeloop::drivers
