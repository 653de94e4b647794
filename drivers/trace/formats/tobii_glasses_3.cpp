#include "drivers/trace/formats/tobii_glasses_3.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "drivers/trace/bad_cells.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/json_file.h"
#include "drivers/trace/text/json_numbers.h"
#include "drivers/trace/text/line_cells.h"
#include "drivers/trace/trace_builder.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

using Json = nlohmann::json;

const Json* member(const Json& object, const char* name) {
    if (!object.is_object()) {
        return nullptr;
    }
    const auto found = object.find(name);
    return found != object.end() && !found->is_null() ? &*found : nullptr;
}

/// Three finite numbers, in our axes.
std::optional<glm::dvec3> vector_of(const Json* written) {
    if (written == nullptr || !written->is_array() || written->size() != 3) {
        return std::nullopt;
    }
    glm::dvec3 vector{0.0};
    for (const int i : {0, 1, 2}) {
        const Json& number = (*written)[static_cast<std::size_t>(i)];
        if (!number.is_number()) {
            return std::nullopt;
        }
        vector[i] = number.get<double>();
    }
    if (!gaze::is_finite(vector)) {
        return std::nullopt;
    }
    return vector * glm::dvec3{-1.0, 1.0, -1.0};
}

/// Nanoseconds of seconds; none where it does not fit.
std::optional<std::int64_t> time_of(const Json* seconds) {
    constexpr double kMost_s = 9e9;
    if (seconds == nullptr || !seconds->is_number()) {
        return std::nullopt;
    }
    const double time_s = seconds->get<double>();
    if (!(std::abs(time_s) < kMost_s)) {
        return std::nullopt;
    }
    return std::llround(time_s * 1e9);
}

/// Its own direction and origin; an eye that is missing, or has no direction, was not seen.
gaze::EyeRay eye_of(const Json* written, gaze::Eye eye, std::uint64_t line, BadCells& bad) {
    gaze::EyeRay ray;
    if (written == nullptr) {
        return ray;
    }
    if (const Json* const direction = member(*written, "gazedirection")) {
        const std::optional<glm::dvec3> vector = vector_of(direction);
        const std::optional<glm::dvec3> unit =
            vector && is_direction(*vector) ? gaze::unit(*vector) : std::nullopt;
        if (unit) {
            ray.direction = *unit;
            ray.valid = true;
        } else {
            bad.add(direction_of(eye), line, [] {
                return std::string{"'gazedirection' is not three numbers of any length"};
            });
        }
    }
    if (const Json* const origin = member(*written, "gazeorigin")) {
        if (const std::optional<glm::dvec3> origin_mm = vector_of(origin)) {
            ray.origin_m = *origin_mm * 1e-3;
            bad.has(origin_of(eye));
        } else {
            bad.add(other_of(eye), line,
                    [] { return std::string{"'gazeorigin' is not three numbers"}; });
        }
    } else if (ray.valid) {
        bad.lacks(origin_of(eye), line, [] { return std::string{"'gazeorigin': nothing"}; });
    }
    return ray;
}

struct Others {
    std::uint64_t lines = 0;
    std::uint64_t first = 0;
};

void note_all(const TextLines& lines, const BadCells& bad, const Others& others,
              std::uint64_t cut_line, gaze::TraceReport& report) {
    lines.report_to(report);
    bad.report_to(report);
    if (others.lines > 0) {
        report.add({.kind = gaze::TraceFindingKind::Text,
                    .line = others.first,
                    .rows = others.lines,
                    .text = fmt::format("{} {} not of the type 'gaze': left out", others.lines,
                                        others.lines == 1 ? "line" : "lines")});
    }
    if (cut_line > 0) {
        report.rows += 1;
        report.add({.kind = gaze::TraceFindingKind::CutRow,
                    .line = cut_line,
                    .rows = 1,
                    .dropped = 1,
                    .text = "the last line was not finished: it is not used"});
    }
}

}  // namespace

bool is_json_lines(std::string_view first_line) { return trimmed(first_line).starts_with('{'); }

Expected<BuiltTrace> read_tobii_glasses_3(TextLines lines, const ReadOptions& options) {
    TraceBuilder builder(
        {.file = lines.name(), .format = kTobiiGlasses3, .device = "Tobii Pro Glasses 3"});
    builder.clock_is("timestamp", 1e9);
    BadCells bad;
    Others others;
    std::uint64_t cut_line = 0;
    while (true) {
        const Expected<bool> more = lines.next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            break;
        }
        if (trimmed(lines.text()).empty()) {
            continue;
        }
        Json json = Json::parse(lines.text(), nullptr, false);
        if (json.is_discarded()) {
            json = Json::parse(with_numbers_quoted_that_json_lacks(lines.text()), nullptr, false);
        }
        if (!json.is_object()) {
            if (!lines.ended()) {
                cut_line = lines.line();
                break;
            }
            return lines.error_here(
                builder.report().rows + others.lines == 0
                    ? "no JSON object in a line: gazedata of Tobii glasses has one in each; where "
                      "this is the JSON file beside a trace, name the trace"
                    : "no JSON object: mend or remove the line");
        }
        if (text_in(json, "type") != "gaze") {
            others.first = others.lines++ == 0 ? lines.line() : others.first;
            continue;
        }
        TraceRow row;
        row.line = lines.line();
        row.device_ticks = time_of(member(json, "timestamp"));
        if (!row.device_ticks && !builder.knows_unread_time()) {
            builder.unread_time("'timestamp' is no time in seconds");
        }
        if (const Json* const data = member(json, "data")) {
            row.eyes[0] = eye_of(member(*data, "eyeleft"), gaze::Eye::Left, row.line, bad);
            row.eyes[1] = eye_of(member(*data, "eyeright"), gaze::Eye::Right, row.line, bad);
        }
        builder.add(row);
    }
    note_all(lines, bad, others, cut_line, builder.report());
    if (builder.report().rows == (cut_line > 0 ? 1U : 0U)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: no line of the type 'gaze': of Tobii glasses read gazedata.gz; "
                              "where this is the JSON file beside a trace, name the trace",
                              lines.name())});
    }
    return builder.finish(options);
}

}  // namespace gazeloop::drivers
