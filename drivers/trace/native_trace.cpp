#include "drivers/trace/native_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "drivers/trace/row_clock.h"
#include "drivers/trace/trace_builder.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kName = "gazeloop";
constexpr std::string_view kSidecarFormat = "gazeloop-gaze";
constexpr std::string_view kSidecarAxes = "+x right, +y up, -z forward";
constexpr int kSidecarVersion = 1;

/// In the order in which they are written.
constexpr std::array<std::string_view, 28> kColumns{
    "sequence",         "t_device_ns",      "t_host_ns",        "left_valid",
    "left_x",           "left_y",           "left_z",           "left_origin_x_m",
    "left_origin_y_m",  "left_origin_z_m",  "left_openness",    "left_confidence",
    "right_valid",      "right_x",          "right_y",          "right_z",
    "right_origin_x_m", "right_origin_y_m", "right_origin_z_m", "right_openness",
    "right_confidence", "head_x_m",         "head_y_m",         "head_z_m",
    "head_qx",          "head_qy",          "head_qz",          "head_qw",
};
constexpr std::size_t kLeftColumns = 3;
constexpr std::size_t kColumnsPerEye = 9;
constexpr std::size_t kHeadColumns = kLeftColumns + 2 * kColumnsPerEye;

/// Where each of kColumns stands in the file.
using Columns = std::array<std::size_t, kColumns.size()>;

/// Directions and orientations this close to unit length are taken as they are, so that what was
/// written is read back exactly.
constexpr double kUnitTolerance = 1e-9;

bool is_unit(double length) { return std::abs(length - 1.0) <= kUnitTolerance; }

double read_fraction(CsvTable& table, std::size_t column) {
    constexpr double kUnknown = -1.0;
    const double value = table.number_or(column, kUnknown);
    if (value != kUnknown && (value < 0.0 || value > 1.0)) {
        table.refuse(column, "is neither 0 to 1 nor -1 (unknown)");
    }
    return value;
}

gaze::EyeRay read_eye(CsvTable& table, const Columns& columns, std::size_t first) {
    const auto blank_is = [&](std::size_t i, double unknown) {
        return table.number_or(columns[first + i], unknown);
    };
    const std::size_t valid_column = columns[first];
    const std::int64_t valid = table.integer(valid_column);
    if (valid != 0 && valid != 1) {
        table.refuse(valid_column, "is neither 0 nor 1");
    }
    gaze::EyeRay ray;
    ray.origin_m = {blank_is(4, 0.0), blank_is(5, 0.0), blank_is(6, 0.0)};
    ray.openness = read_fraction(table, columns[first + 7]);
    ray.confidence = read_fraction(table, columns[first + 8]);
    if (valid == 0) {
        ray.direction = {blank_is(1, ray.direction.x), blank_is(2, ray.direction.y),
                         blank_is(3, ray.direction.z)};
        return ray;
    }
    const glm::dvec3 written{table.number(columns[first + 1]), table.number(columns[first + 2]),
                             table.number(columns[first + 3])};
    const std::optional<glm::dvec3> direction =
        is_unit(glm::length(written)) ? written : gaze::unit(written);
    ray.valid = direction.has_value();
    ray.direction = direction.value_or(written);
    return ray;
}

std::optional<gaze::Pose> read_head(CsvTable& table, const Columns& columns) {
    const std::span<const std::size_t> head{columns.begin() + kHeadColumns, columns.end()};
    if (std::all_of(head.begin(), head.end(), [&](std::size_t c) { return table.blank(c); })) {
        return std::nullopt;
    }
    gaze::Pose pose;
    pose.position_m = {table.number(head[0]), table.number(head[1]), table.number(head[2])};
    const glm::dquat written{table.number(head[6]), table.number(head[3]), table.number(head[4]),
                             table.number(head[5])};
    const double length = glm::length(written);
    if (!std::isnormal(length)) {
        table.refuse(head[6], "ends an orientation that cannot be made a unit quaternion");
        return std::nullopt;
    }
    pose.orientation = is_unit(length) ? written : written / length;
    return pose;
}

/// Arrivals were read on the host's clock since its first row, sample times on the device's. The
/// least difference of the two becomes zero: what the report took at least is unknown, what it took
/// more than that is in the file.
void align_arrivals(std::vector<gaze::GazeSample>& samples) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const gaze::GazeSample& sample : samples) {
        if (sample.arrived.known()) {
            least = std::min(least, sample.arrived.ns - sample.sampled.ns);
        }
    }
    for (gaze::GazeSample& sample : samples) {
        if (sample.arrived.known()) {
            sample.arrived.ns -= least;
        }
    }
}

Expected<gaze::GazeTrace> read(CsvTable& table) {
    Columns columns{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i] = table.column(kColumns[i]);
    }
    RowClock device_clock(columns[1], 1);
    RowClock host_clock(columns[2], 1);
    TraceBuilder builder(table.name(), kName, "unknown device");

    while (true) {
        const Expected<bool> more = table.next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            break;
        }
        gaze::GazeSample sample;
        sample.sequence = table.count(columns[0]);
        sample.device_ns = table.integer(columns[1]);
        sample.sampled = {device_clock.since_first_ns(table), time::StampKind::Modelled};
        if (!table.blank(columns[2])) {
            sample.arrived = {host_clock.since_first_ns(table), time::StampKind::Modelled};
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            sample.eyes[gaze::index(eye)] =
                read_eye(table, columns, kLeftColumns + gaze::index(eye) * kColumnsPerEye);
        }
        sample.head = read_head(table, columns);
        builder.add(sample);
    }

    Expected<gaze::GazeTrace> trace = builder.finish();
    if (trace) {
        align_arrivals(trace->samples);
    }
    return trace;
}

/// Puts numbers into a line without the locale having a say.
class LineWriter {
  public:
    template <typename Number>
    void add(Number value) {
        std::array<char, 32> digits{};  // the longest double has 24
        const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
        line_ += std::string_view(digits.data(), written.ptr);
        line_ += ',';
    }
    void add_blank() { line_ += ','; }
    void add_finite(double value) {
        if (std::isfinite(value)) {
            add(value);
        } else {
            add_blank();
        }
    }
    void add_finite(const glm::dvec3& v) {
        add_finite(v.x);
        add_finite(v.y);
        add_finite(v.z);
    }

    void end(std::ostream& out) {
        line_.back() = '\n';
        out.write(line_.data(), static_cast<std::streamsize>(line_.size()));
        line_.clear();
    }

  private:
    std::string line_;
};

std::string sidecar_file(const std::string& trace_file) { return trace_file + ".json"; }

std::unexpected<Error> bad_input(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

/// Samples per second by the median interval; 0 for a single sample.
double rate_hz(const gaze::GazeTrace& trace) {
    std::vector<std::int64_t> intervals_ns;
    for (std::size_t i = 1; i < trace.samples.size(); ++i) {
        intervals_ns.push_back(trace.samples[i].sampled.ns - trace.samples[i - 1].sampled.ns);
    }
    if (intervals_ns.empty()) {
        return 0.0;
    }
    const auto median = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
    std::nth_element(intervals_ns.begin(), median, intervals_ns.end());
    return 1e9 / static_cast<double>(*median);
}

constexpr TraceFormat kFormat{kName, kColumns, read};

}  // namespace

const TraceFormat& native_trace() { return kFormat; }

Expected<std::string> read_native_sidecar(const std::string& trace_file) {
    const std::string file = sidecar_file(trace_file);
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::string{};
    }
    constexpr std::size_t kLargest = 1 << 20;
    std::string text(kLargest, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));

    const nlohmann::json sidecar = nlohmann::json::parse(text, nullptr, false);
    if (!sidecar.is_object()) {
        return bad_input(fmt::format("{}: not a JSON object of at most 1 MiB", file));
    }
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
    const auto device = sidecar.find("device");
    if (device == sidecar.end() || !device->is_string()) {
        return std::string{};
    }
    return device->get<std::string>();
}

void write_native_trace(const gaze::GazeTrace& trace, std::ostream& out) {
    out << fmt::format("{}\n", fmt::join(kColumns, ","));
    LineWriter line;
    for (const gaze::GazeSample& sample : trace.samples) {
        line.add(sample.sequence);
        line.add(sample.device_ns);
        if (sample.arrived.known()) {
            line.add(sample.arrived.ns);
        } else {
            line.add_blank();
        }
        for (const gaze::EyeRay& ray : sample.eyes) {
            line.add(ray.valid ? 1 : 0);
            line.add_finite(ray.direction);
            line.add_finite(ray.origin_m);
            line.add_finite(ray.openness);
            line.add_finite(ray.confidence);
        }
        if (sample.head) {
            line.add_finite(sample.head->position_m);
            line.add_finite({sample.head->orientation.x, sample.head->orientation.y,
                             sample.head->orientation.z});
            line.add_finite(sample.head->orientation.w);
        } else {
            for (std::size_t i = kHeadColumns; i < kColumns.size(); ++i) {
                line.add_blank();
            }
        }
        line.end(out);
    }
}

namespace {

std::unexpected<Error> cannot_be_written(const std::string& file) {
    return bad_input(fmt::format("{}: cannot be written ({})", file,
                                 errno != 0 ? std::strerror(errno) : "unknown why"));
}

}  // namespace

Expected<void> write_native_trace(const gaze::GazeTrace& trace, const std::string& file) {
    errno = 0;
    std::ofstream csv(file, std::ios::binary | std::ios::trunc);
    write_native_trace(trace, csv);
    csv.close();
    if (!csv) {
        return cannot_be_written(file);
    }

    const nlohmann::ordered_json sidecar{
        {"format", kSidecarFormat},
        {"version", kSidecarVersion},
        {"clock", "t_device_ns: the device's; t_host_ns: the host's at arrival"},
        {"rate_hz", rate_hz(trace)},
        {"axes", kSidecarAxes},
        {"device", trace.device},
        {"calibration", nullptr},
    };
    std::ofstream json(sidecar_file(file), std::ios::binary | std::ios::trunc);
    json << sidecar.dump(4) << '\n';
    json.close();
    if (!json) {
        return cannot_be_written(sidecar_file(file));
    }
    return {};
}

}  // namespace gazeloop::drivers
