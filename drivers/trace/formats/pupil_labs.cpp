#include "drivers/trace/formats/pupil_labs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>

#include "drivers/trace/companion_table.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/json_file.h"
#include "drivers/trace/text/cell_number.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "pupil-labs";
constexpr std::string_view kTime = "timestamp [ns]";
constexpr std::string_view kAzimuth = "azimuth [deg]";
constexpr std::string_view kElevation = "elevation [deg]";
constexpr std::string_view kWorn = "worn";
constexpr std::string_view kBlink = "blink id";
constexpr std::string_view kRecording = "recording id";
constexpr std::array<std::string_view, 6> kColumns{kTime, kAzimuth, kElevation,
                                                   kWorn, kBlink,   kRecording};

constexpr std::array<std::string_view, 1> kNeededTime{kTime};
constexpr std::array<std::string_view, 2> kNeededAngles{kAzimuth, kElevation};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 1> kAngles{kNeededAngles};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kAngles};

constexpr std::array<std::string_view, 6> kEyeballs{
    "eyeball center left x [mm]",  "eyeball center left y [mm]",  "eyeball center left z [mm]",
    "eyeball center right x [mm]", "eyeball center right y [mm]", "eyeball center right z [mm]"};
constexpr std::array<std::string_view, 4> kQuaternion{"quaternion w", "quaternion x",
                                                      "quaternion y", "quaternion z"};
constexpr std::array<std::string_view, 1> kBlinkEnd{"end timestamp [ns]"};

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    return {table,
            eye,
            {.valid = {},
             .direction = {std::string{kAzimuth}, std::string{kElevation}},
             .origin = {},
             .openness = {},
             .confidence = {}},
            {.direction =
                 [](const glm::dvec3& angles_deg) {
                     return of_azimuth_elevation(glm::radians(angles_deg.x),
                                                 glm::radians(angles_deg.y));
                 },
             .bits = {}}};
}

/// What stands beside gaze.csv.
struct Beside {
    std::optional<TimedNumbers> eyeballs;
    std::optional<TimedNumbers> imu;
    bool is_neon = false;
    /// By their starts; an end, as a double, may be 128 ns off.
    std::optional<TimedNumbers> blinks;
};

Expected<Beside> read_beside(CsvTable& table, const TraceFile& file) {
    Beside beside;
    const CompanionNotes note = [&](std::string text, gaze::TraceFindingKind kind) {
        table.note(0, std::move(text), kind);
    };
    struct Wanted {
        std::optional<TimedNumbers>& to;
        std::string_view name;
        std::string_view time;
        std::span<const std::string_view> columns;
    };
    for (const Wanted& wanted :
         {Wanted{beside.eyeballs, "3d_eye_states.csv", kTime, kEyeballs},
          Wanted{beside.imu, "imu.csv", kTime, kQuaternion},
          Wanted{beside.blinks, "blinks.csv", "start timestamp [ns]", kBlinkEnd}}) {
        if (&wanted.to == &beside.blinks && table.has(kBlink)) {
            continue;
        }
        auto read = read_companion(file, wanted.name, wanted.time, wanted.columns, note);
        if (!read) {
            return std::unexpected(read.error());
        }
        wanted.to = std::move(*read);
    }
    const auto info = file.empty()
                          ? Expected<std::optional<nlohmann::json>>{std::optional<nlohmann::json>{}}
                          : read_json_object(file.parent_path() / "info.json");
    if (!info) {
        return std::unexpected(info.error());
    }
    const std::string mode = *info ? text_in(**info, "gaze_mode") : std::string{};
    if (!mode.empty()) {
        table.note(0, fmt::format("info.json beside it: gaze_mode {}", mode));
    }
    beside.is_neon = beside.eyeballs || beside.imu || !mode.empty();
    return beside;
}

/// Scene camera: +X right, +Y down, +Z forward, millimetres.
glm::dvec3 place_m(std::span<const double> scene_mm) {
    return glm::dvec3{scene_mm[0], -scene_mm[1], -scene_mm[2]} * 1e-3;
}

glm::dquat about_x(double angle_deg) {
    return glm::angleAxis(glm::radians(angle_deg), glm::dvec3{1.0, 0.0, 0.0});
}

/// The head in our world by the IMU in its own: our axes to the scene camera's (180 degrees about
/// X), to the IMU's (-102), to its world's (the quaternion), to ours (-90).
std::optional<gaze::Pose> head_of(std::span<const double> quaternion) {
    const glm::dquat imu{quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    const double length = glm::length(imu);
    if (!std::isnormal(length)) {
        return std::nullopt;
    }
    return gaze::Pose{glm::normalize(about_x(-90.0) * (imu / length) * about_x(180.0 - 102.0)),
                      glm::dvec3{0.0}};
}

std::optional<gaze::Pose> head_at(const TimedNumbers& imu, std::int64_t time_ns) {
    constexpr std::int64_t kFar_ns = 50'000'000;
    const std::optional<std::size_t> before = imu.row_until(time_ns);
    const std::optional<std::size_t> near = imu.row_near(time_ns, kFar_ns);
    if (!near) {
        return std::nullopt;
    }
    const bool between = before && *before + 1 < imu.time_ns.size() &&
                         imu.time_ns[*before + 1] - imu.time_ns[*before] <= 2 * kFar_ns;
    if (!between) {
        return head_of(imu.at(*near));
    }
    const std::optional<gaze::Pose> first = head_of(imu.at(*before));
    const std::optional<gaze::Pose> second = head_of(imu.at(*before + 1));
    if (!first || !second) {
        return first ? first : second;
    }
    const auto step_ns = static_cast<double>(imu.time_ns[*before + 1] - imu.time_ns[*before]);
    const double share = static_cast<double>(time_ns - imu.time_ns[*before]) / step_ns;
    return gaze::Pose{glm::normalize(glm::slerp(first->orientation, second->orientation,
                                                std::clamp(share, 0.0, 1.0))),
                      glm::dvec3{0.0}};
}

/// For how many rows a file beside gaze.csv had something to say.
struct Served {
    std::uint64_t rows = 0;
    std::uint64_t eyeballs = 0;
    std::uint64_t head = 0;
    std::uint64_t blinks = 0;
};

/// A file that says nothing of a tenth of the rows is not all there, or of another recording.
void report_served(const Beside& beside, const Served& served, gaze::TraceReport& report) {
    struct File {
        const std::optional<TimedNumbers>& numbers;
        std::string_view name;
        std::string_view what;
        std::uint64_t rows;
    };
    for (const File& file :
         {File{beside.eyeballs, "3d_eye_states.csv", "the eyes' places", served.eyeballs},
          File{beside.imu, "imu.csv", "the head's pose", served.head}}) {
        if (!file.numbers) {
            continue;
        }
        const bool most = file.rows * 10 > served.rows * 9;
        report.add({.kind = most ? gaze::TraceFindingKind::Text : gaze::TraceFindingKind::NotRead,
                    .text = fmt::format("{} beside it: {} for {} of {} rows{}", file.name,
                                        file.what, file.rows, served.rows,
                                        most             ? ""
                                        : file.rows == 0 ? "; its times are not this recording's, "
                                                           "or its numbers say nothing"
                                                         : "; it does not cover the recording")});
    }
    if (beside.blinks) {
        const std::size_t count = beside.blinks->time_ns.size();
        const bool none = served.blinks == 0 && count > 0;
        report.add({.kind = none ? gaze::TraceFindingKind::NotRead : gaze::TraceFindingKind::Text,
                    .text = fmt::format("blinks.csv beside it: {} {} with {} of {} rows{}", count,
                                        count == 1 ? "blink" : "blinks", served.blinks, served.rows,
                                        none ? "; its times are not this recording's" : "")});
    }
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& file, const ReadOptions& options) {
    constexpr std::int64_t kSameTime_ns = 6'000'000;
    const Expected<Beside> beside = read_beside(table, file);
    if (!beside) {
        return std::unexpected(beside.error());
    }
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    const std::size_t time = *table.column(kTime);
    const auto worn = table.column(kWorn);
    const auto blink = table.column(kBlink);
    TraceRows rows(table, eyes,
                   {.file = table.name(),
                    .format = kName,
                    .device = beside->is_neon ? "Pupil Labs Neon" : "Pupil Labs"});
    if (const auto recording = table.column(kRecording)) {
        rows.one_recording(*recording);
    }
    Served served;
    const double parallax_rad = combined_parallax_rad();
    auto trace = rows.read(options, [&](TraceRow& row) {
        ++served.rows;
        row.device_ticks = rows.ticks(time, "nanoseconds");
        row.parallax_rad = parallax_rad;
        if (worn && truth_of(table.text(*worn)) == false) {
            rows.refuse_eyes(row, "not worn");
        }
        if (blink && !table.is_missing(*blink)) {
            rows.refuse_eyes(row, "a blink (blink id)");
        }
        if (!row.device_ticks) {
            return;
        }
        const std::int64_t now_ns = *row.device_ticks;
        if (beside->blinks) {
            const auto begun = beside->blinks->row_until(now_ns);
            if (begun && static_cast<double>(now_ns) <= beside->blinks->at(*begun)[0]) {
                rows.refuse_eyes(row, "a blink (blinks.csv)");
                ++served.blinks;
            }
        }
        if (beside->eyeballs) {
            if (const auto at = beside->eyeballs->row_near(now_ns, kSameTime_ns)) {
                const std::span<const double> centres = beside->eyeballs->at(*at);
                row.eyes[0].origin_m = place_m(centres.first(3));
                row.eyes[1].origin_m = place_m(centres.last(3));
                ++served.eyeballs;
            }
        }
        if (beside->imu) {
            row.head = head_at(*beside->imu, now_ns);
            served.head += row.head ? 1 : 0;
        }
    });
    if (trace) {
        report_served(*beside, served, trace->report);
    }
    return trace;
}

constexpr TraceFormat kFormat{
    kName, kColumns, kNeeded, read,
    "gaze in pixels needs the camera's geometry: export gaze.csv with azimuth and elevation"};

}  // namespace

const TraceFormat& pupil_labs() { return kFormat; }

}  // namespace gazeloop::drivers
