#include "drivers/trace/formats/tobii_pro_lab.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "drivers/trace/eye_cells.h"
#include "drivers/trace/text/cell_number.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "tobii-pro-lab";
constexpr std::string_view kTime = "Recording timestamp [*]";
constexpr std::array<std::string_view, 11> kColumns{
    kTime,
    "Sensor",
    "Gaze direction left X [*]",
    "Gaze direction left Y [*]",
    "Gaze direction left Z [*]",
    "Validity left",
    "Gaze direction right X [*]",
    "Gaze direction right Y [*]",
    "Gaze direction right Z [*]",
    "Validity right",
    "Recording name",
};
constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 3> kNeededLeft{kColumns[2], kColumns[3], kColumns[4]};
constexpr std::array<std::string_view, 3> kNeededRight{kColumns[6], kColumns[7], kColumns[8]};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 2> kEyes{kNeededLeft, kNeededRight};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

std::optional<EyeTrust> trust(CsvTable& table, std::size_t column) {
    // Numbers are other trackers' codes, of which 0 is the best.
    const std::string_view word = table.text(column);
    const bool is_number = !word.empty() && word.front() >= '0' && word.front() <= '9';
    const std::optional<bool> says = is_number ? std::nullopt : truth_of(word);
    if (!says) {
        return std::nullopt;
    }
    const bool valid = *says;
    return EyeTrust{.direction = valid, .origin = valid, .openness = valid};
}

/// Of which device a file is, by the columns with the eyes' places and the units of directions.
bool is_of_glasses(CsvTable& table) {
    for (const std::string_view eye : {"left", "right"}) {
        const auto column = table.column(fmt::format("Gaze direction {} X [*]", eye));
        if (column && table.unit(*column).starts_with("HUCS")) {
            return true;
        }
        if (column && table.unit(*column).starts_with("DACS")) {
            return false;
        }
    }
    return table.has("Pupil position left X [*]") || table.has("Pupil position right X [*]");
}

EyeCells eye_cells(CsvTable& table, gaze::Eye eye, bool glasses) {
    const std::string side{gaze::kEyeNames[gaze::index(eye)]};
    const std::string direction = "Gaze direction " + side;
    const std::string origin = (glasses ? "Pupil position " : "Eye position ") + side;
    const std::string valid = "Validity " + side;
    const bool has_validity = table.has(valid);
    return {table,
            eye,
            {.valid = has_validity ? valid : "",
             .direction = {direction + " X [*]", direction + " Y [*]", direction + " Z [*]"},
             .origin = glasses ? std::array<std::string, 3>{origin + " X [*]", origin + " Y [*]",
                                                            origin + " Z [*]"}
                               // From the screen's corner: no place in a head.
                               : std::array<std::string, 3>{},
             .openness = {},
             .confidence = {}},
            {.trust = has_validity ? trust : nullptr,
             .to_our_axes = glasses ? glm::dvec3{-1.0, 1.0, -1.0} : glm::dvec3{1.0, -1.0, 1.0},
             .metre = 1e-3,
             .bits = {}}};
}

/// How many decimals of the unit a nanosecond is; none where the unit is not known.
std::optional<int> decimals_of(std::string_view unit) {
    if (unit == "s") {
        return 9;
    }
    if (unit == "ms") {
        return 6;
    }
    // Greek mu and the micro sign.
    if (unit == "us" || unit == "\xCE\xBCs" || unit == "\xC2\xB5s") {
        return 3;
    }
    return unit == "ns" ? std::optional{0} : std::nullopt;
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    const std::size_t time = *table.column(kTime);
    const std::optional<int> decimals = decimals_of(table.unit(time));
    if (!decimals) {
        const std::string_view unit = table.unit(time);
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}:{}: {}: write the times in milliseconds or microseconds and name the "
                        "column 'Recording timestamp [ms]' or '[us]'",
                        table.name(), table.header_line(),
                        unit.empty() ? "'Recording timestamp' does not say its unit"
                                     : fmt::format("the unit of '{}' is not known (s, ms, us and "
                                                   "ns are)",
                                                   table.name_of(time)))});
    }
    const bool glasses = is_of_glasses(table);
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left, glasses),
                                eye_cells(table, gaze::Eye::Right, glasses)};
    TraceRows rows(table, eyes,
                   {.file = table.name(),
                    .format = kName,
                    .device = glasses ? "Tobii glasses" : "Tobii at a screen"});
    const auto sensor = table.column("Sensor");
    const auto recording = table.column("Recording name");
    if (sensor) {
        rows.only_where([&table, at = *sensor] { return table.text(at) == "Eye Tracker"; },
                        "of other sensors than 'Eye Tracker'");
    }
    if (recording) {
        rows.one_recording(*recording);
    }
    return rows.read(options, [&](TraceRow& row) {
        row.device_ticks = rows.decimal_ticks(time, *decimals, table.unit(time));
    });
}

constexpr TraceFormat kFormat{
    kName, kColumns, kNeeded, read,
    "gaze points alone have no geometry: export Gaze direction left and right too"};

}  // namespace

const TraceFormat& tobii_pro_lab() { return kFormat; }

}  // namespace gazeloop::drivers
