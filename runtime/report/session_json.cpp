#include "runtime/report/session_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/latency/weakest_kind.h"
#include "runtime/report/eye_event_rows.h"
#include "runtime/report/session_rows.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWorstFrames = 10;

Json or_null(const auto& value) { return value ? Json(*value) : Json(nullptr); }

Json row_json(const SessionRow& row, const Percentiles& percentiles) {
    Json kinds = Json::object();
    for (std::size_t kind = 0; kind < time::kStampKindCount; ++kind) {
        kinds[std::string(time::kStampKindNames[kind])] = row.frames_by_kind[kind];
    }
    const std::string unit{unit_suffix(row.unit)};
    Json json{{"frames", row.known},
              {"kind", time::name(latency::weakest_kind(row.frames_by_kind))},
              {"frames_by_kind", std::move(kinds)},
              {"negative_frames", row.negative},
              {"min" + unit, or_null(row.least)},
              {"mean" + unit, or_null(row.mean)}};
    const std::vector<std::string> names = percentiles.names();
    for (std::size_t place = 0; place < names.size(); ++place) {
        json[names[place] + unit] = or_null(row.percentiles[place]);
    }
    json["max" + unit] = or_null(row.greatest);
    return json;
}

Json by_eye_event_json(const FrameLog& frames, const Percentiles& percentiles) {
    const EyeEventRows rows = rows_by_eye_event(frames, percentiles.percents());
    const auto by_event = [&percentiles](const std::vector<SessionRow>& all) {
        Json json = Json::object();
        for (const SessionRow& row : all) {
            json[row.name.key] = row_json(row, percentiles);
        }
        return json;
    };
    return {{"source", kEyeEventSourceNames[static_cast<std::size_t>(rows.source)]},
            {"frames", rows.with_gaze},
            {"frames_unknown", rows.unknown},
            {kGazeAgeAtDisplay.key, by_event(rows.ages)},
            {kGazeError.key, by_event(rows.errors)}};
}

Json worst_json(const FrameLog& frames) {
    Json worst = Json::array();
    for (const std::size_t row : frames.worst(kWorstFrames)) {
        const auto state = frames.state(row);
        const auto event = frames.eye_event(row);
        Json one{
            {"frame", frames.number(row)},
            {"wake_up_ns", or_null(frames.wake_up_ns(row))},
            {"shown_ns", or_null(frames.shown_ns(row))},
            {"gaze_state", state ? Json(gaze::kFoveaStateNames[static_cast<std::size_t>(*state)])
                                 : Json(nullptr)},
            {"eye_event", event ? Json(gaze::name(*event)) : Json(nullptr)}};
        for (const DurationColumn& column : frames.columns()) {
            const std::optional<std::int64_t> number = column.at(row);
            const std::string key = fmt::format("{}{}", column.key(), unit_suffix(column.unit()));
            if (!number) {
                one[key] = nullptr;
            } else if (column.unit() == Unit::Count) {
                one[key] = *number;
            } else {
                one[key] = shown(static_cast<double>(*number), column.unit());
            }
        }
        worst.push_back(std::move(one));
    }
    return worst;
}

}  // namespace

Json session_json(const SessionSummary& session, const session::SessionInfo& info,
                  const Percentiles& percentiles) {
    const FrameLog& frames = *session.frames;
    Json json{{"schema_version", kReportSchemaVersion}};
    json.update(summary_json(session.report));
    Json durations = Json::object();
    Json errors = Json::object();
    for (const SessionRow& row : rows_of(frames, percentiles.percents())) {
        if (row.unit == Unit::Nanoseconds) {
            durations[row.name.key] = row_json(row, percentiles);
        } else if (row.unit == Unit::Microdegrees) {
            errors[row.name.key] = row_json(row, percentiles);
        }
    }
    Json& unknown = errors["unknown"] = Json::object();
    for (std::size_t gap = 1; gap < frame::kGazeErrorGapCount; ++gap) {
        unknown[std::string(frame::kGazeErrorGapNames[gap])] = frames.gaze_error_gaps()[gap];
    }
    json["percentiles"] = percentiles.percents();
    json["durations"] = std::move(durations);
    json["gaze_error"] = std::move(errors);
    json["by_eye_event"] = by_eye_event_json(frames, percentiles);
    json["worst_frames"] = worst_json(frames);
    json["recording"] = {{"schema_version", info.schema_version},
                         {"closed", info.closed_cleanly},
                         {"records_dropped", info.records_dropped},
                         {"last_frame", or_null(session.end.last_frame)},
                         {"last_error", or_null(session.end.last_error)}};
    session.trace.add_to(json);
    return json;
}

}  // namespace gazeloop::report
