#include "drivers/trace/native_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "drivers/trace/eye_cells.h"
#include "drivers/trace/json_file.h"
#include "drivers/trace/text/line_writer.h"
#include "drivers/trace/text/text_output.h"
#include "drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "gazeloop";
constexpr std::string_view kSidecarFormat = "gazeloop-gaze";
constexpr std::string_view kSidecarAxes = "+x right, +y up, -z forward";
constexpr int kSidecarVersion = 1;

/// In the order in which they are written.
constexpr std::array<std::string_view, 29> kColumns{
    "sequence",         "t_device_ns",      "t_host_ns",        "left_valid",
    "left_x",           "left_y",           "left_z",           "left_origin_x_m",
    "left_origin_y_m",  "left_origin_z_m",  "left_openness",    "left_confidence",
    "right_valid",      "right_x",          "right_y",          "right_z",
    "right_origin_x_m", "right_origin_y_m", "right_origin_z_m", "right_openness",
    "right_confidence", "head_x_m",         "head_y_m",         "head_z_m",
    "head_qx",          "head_qy",          "head_qz",          "head_qw",
    "parallax_rad",
};
constexpr std::size_t kHeadColumns = 7;
constexpr std::size_t kAlwaysWritten = kColumns.size() - 1;

constexpr std::array<std::string_view, 1> kNeededTime{"t_device_ns"};
constexpr std::array<std::string_view, 4> kNeededLeft{"left_valid", "left_x", "left_y", "left_z"};
constexpr std::array<std::string_view, 4> kNeededRight{"right_valid", "right_x", "right_y",
                                                       "right_z"};
constexpr std::array<ColumnNames, 1> kTimes{kNeededTime};
constexpr std::array<ColumnNames, 2> kEyes{kNeededLeft, kNeededRight};
constexpr std::array<std::span<const ColumnNames>, 2> kNeeded{kTimes, kEyes};

/// Orientations this close to unit length are taken as they are, so that what was written is read
/// back exactly.
constexpr double kUnitTolerance = 1e-9;

std::optional<EyeTrust> trust(CsvTable& table, std::size_t column) {
    const std::optional<bool> valid = table.truth(column);
    if (!valid) {
        return std::nullopt;
    }
    return EyeTrust{.direction = *valid, .origin = true, .openness = true};
}

EyeCells eye_cells(CsvTable& table, gaze::Eye eye) {
    const std::string side{gaze::kEyeNames[gaze::index(eye)]};
    return {table,
            eye,
            {.valid = side + "_valid",
             .direction = {side + "_x", side + "_y", side + "_z"},
             .origin = {side + "_origin_x_m", side + "_origin_y_m", side + "_origin_z_m"},
             .openness = side + "_openness",
             .confidence = side + "_confidence"},
            {.trust = trust, .bits = {}}};
}

Expected<BuiltTrace> read(CsvTable& table, const TraceFile& /*file*/, const ReadOptions& options) {
    gaze::PerEye<EyeCells> eyes{eye_cells(table, gaze::Eye::Left),
                                eye_cells(table, gaze::Eye::Right)};
    std::array<std::string_view, kHeadColumns> head_names{};
    std::copy_n(kColumns.begin() + kAlwaysWritten - kHeadColumns, kHeadColumns, head_names.begin());
    const auto head = table.columns(head_names, "the head's pose");
    const auto sequence = table.column("sequence");
    const std::size_t device_clock = *table.column("t_device_ns");
    const auto host_clock = table.column("t_host_ns");
    const auto parallax = table.column("parallax_rad");
    TraceRows rows(table, eyes,
                   {.file = table.name(), .format = kName, .device = "unknown device"});
    const auto head_pose = [&]() -> std::optional<gaze::Pose> {
        const auto numbers = head ? rows.head(*head) : std::nullopt;
        if (!numbers) {
            return std::nullopt;
        }
        const auto [x, y, z, qx, qy, qz, qw] = *numbers;
        const glm::dquat written{qw, qx, qy, qz};
        const double length = glm::length(written);
        if (!std::isnormal(length)) {
            rows.refuse_head(head->back(), "ends an orientation without length");
            return std::nullopt;
        }
        const bool is_unit = std::abs(length - 1.0) <= kUnitTolerance;
        return gaze::Pose{is_unit ? written : written / length, {x, y, z}};
    };
    return rows.read(options, [&](TraceRow& row) {
        row.sequence = rows.sequence(sequence);
        row.device_ticks = rows.ticks(device_clock, "nanoseconds");
        row.host_ns = rows.arrival_ticks(host_clock);
        row.head = head_pose();
        const auto parallax_rad = parallax ? table.real(*parallax) : std::nullopt;
        if (parallax_rad && *parallax_rad >= 0.0) {
            row.parallax_rad = parallax_rad;
        }
    });
}

std::string sidecar_file(const std::string& trace_file) { return trace_file + ".json"; }

std::unexpected<Error> bad_input(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

constexpr TraceFormat kFormat{kName, kColumns, kNeeded, read};

}  // namespace

const TraceFormat& native_trace() { return kFormat; }

Expected<std::string> read_native_sidecar(const std::string& trace_file) {
    std::string file = sidecar_file(trace_file);
    constexpr std::string_view kCompressed = ".gz";
    if (!std::filesystem::exists(file) && trace_file.ends_with(kCompressed)) {
        file = sidecar_file(trace_file.substr(0, trace_file.size() - kCompressed.size()));
    }
    const auto read = read_json_object(file);
    if (!read) {
        return std::unexpected(read.error());
    }
    if (!*read) {
        return std::string{};
    }
    const nlohmann::json& sidecar = **read;
    const auto must_be = [&](const char* key, const nlohmann::json& value) -> Expected<void> {
        const auto found = sidecar.find(key);
        if (found == sidecar.end() || *found != value) {
            return bad_input(fmt::format("{}: '{}' must be {}", file, key, value.dump()));
        }
        return {};
    };
    for (const Expected<void>& check :
         {must_be("format", kSidecarFormat), must_be("version", kSidecarVersion),
          must_be("axes", kSidecarAxes)}) {
        if (!check) {
            return std::unexpected(check.error());
        }
    }
    return text_in(sidecar, "device");
}

void write_native_trace(const gaze::RecordingView& trace, std::ostream& out) {
    const bool with_parallax = std::ranges::any_of(
        trace.samples,
        [](const gaze::GazeSample& sample) { return sample.parallax_rad.has_value(); });
    out << fmt::format(
        "{}\n",
        fmt::join(std::span{kColumns}.first(kAlwaysWritten + (with_parallax ? 1U : 0U)), ","));
    LineWriter line;
    for (const gaze::GazeSample& sample : trace.samples) {
        line.add(sample.sequence);
        line.add(sample.device_ns);
        if (sample.arrived.known()) {
            line.add(sample.arrived.ns);
        } else {
            line.add_missing();
        }
        for (const gaze::EyeRay& ray : sample.eyes) {
            line.add(ray.valid ? 1 : 0);
            line.add_finite(ray.direction);
            line.add_place(ray.origin_m);
            line.add_finite(ray.openness);
            line.add_finite(ray.confidence);
        }
        if (sample.head) {
            line.add_finite(sample.head->position_m);
            line.add_finite({sample.head->orientation.x, sample.head->orientation.y,
                             sample.head->orientation.z});
            line.add_finite(sample.head->orientation.w);
        } else {
            for (std::size_t i = 0; i < kHeadColumns; ++i) {
                line.add_missing();
            }
        }
        if (with_parallax) {
            line.add_finite(sample.parallax_rad.value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        line.end(out);
    }
}

Expected<void> write_native_trace(const gaze::RecordingView& trace, const std::string& file) {
    TextOutput csv(file);
    write_native_trace(trace, csv.stream());
    if (Expected<void> written = csv.close(); !written) {
        return written;
    }

    const nlohmann::ordered_json sidecar{
        {"format", kSidecarFormat},
        {"version", kSidecarVersion},
        {"clock", "t_device_ns: the device's; t_host_ns: the host's at arrival"},
        {"rate_hz", trace.rate_hz()},
        {"axes", kSidecarAxes},
        {"device", trace.device},
        {"calibration", nullptr},
    };
    TextOutput json(sidecar_file(file));
    json.stream() << sidecar.dump(4, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return json.close();
}

}  // namespace gazeloop::drivers
