#include "runtime/report/summary_json.h"

#include <nlohmann/json.hpp>

#include <optional>

#include "runtime/report/happenings_text.h"
#include "runtime/report/summary_rows.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

template <typename T, std::size_t N>
Json by_name(const std::array<T, N>& values, const std::array<std::string_view, N>& names) {
    Json object = Json::object();
    for (std::size_t i = 0; i < N; ++i) {
        object[std::string(names[i])] = values[i];
    }
    return object;
}

Json grids_json(const frame::GridList& names, const frame::SampleCounts& samples) {
    Json grids = Json::object();
    for (std::size_t grid = 0; grid < names.size(); ++grid) {
        const frame::GridCounts& counts = samples.grids[grid];
        grids[names[grid]] = {{"planned", counts.planned},
                              {"shaded", counts.shaded},
                              {"off_screen", counts.off_screen},
                              {"covered", counts.covered},
                              {"hidden", counts.hidden}};
    }
    return grids;
}

}  // namespace

Json row_json(const latency::DurationRow& row) {
    return {{"frames", row.count},
            {"kind", time::name(row.kind())},
            {"frames_by_kind", by_name(row.frames_by_kind, time::kStampKindNames)},
            {"min_ms", or_null(row.min_ms)},
            {"mean_ms", or_null(row.mean_ms)},
            {"p50_ms", or_null(row.p50_ms)},
            {"p95_ms", or_null(row.p95_ms)},
            {"p99_ms", or_null(row.p99_ms)},
            {"max_ms", or_null(row.max_ms)}};
}

Json summary_json(const latency::SummaryReport& report) {
    Json durations = Json::object();
    for (const NamedRow& named : rows_of(report)) {
        durations[named.name.key] = row_json(*named.row);
    }
    const latency::SummaryConfig& config = report.config;
    const latency::FrameCounts& frames = report.frames;
    const bool missed_known = frames.in_time_unknown < frames.rendered;
    const frame::SampleCounts& samples = report.samples;
    return {{"verdict", latency::kVerdictNames[static_cast<std::size_t>(report.verdict)]},
            {"clock", config.clock == latency::LoopClock::Wall ? "wall" : "virtual"},
            {"display_period_ns", config.period_ns > 0 ? Json(config.period_ns) : Json(nullptr)},
            {"switching_ns", or_null(config.switching_ns)},
            {"rolling_ns", or_null(config.rolling_ns)},
            {"persistence_ns", or_null(config.persistence_ns)},
            {"assumed_of_display", config.assumed},
            {"eye_to_photon_percent_by_kind",
             report.share_by_kind_percent
                 ? by_name(*report.share_by_kind_percent, time::kStampKindNames)
                 : Json(nullptr)},
            {"eye_to_photon_frames",
             {{"known", report.gaze_age_at_display.count}, {"of", frames.with_gaze()}}},
            {"durations", durations},
            {"frames",
             {{"total", frames.total},
              {"rendered", frames.rendered},
              {"missed", missed_known ? Json(frames.missed) : Json(nullptr)},
              {"missed_percent", or_null(report.missed_percent())},
              {"periods_missed", missed_known ? Json(frames.periods_missed) : Json(nullptr)},
              {"in_time_unknown", frames.in_time_unknown},
              {"display_unknown", frames.display_unknown},
              {"by_gaze_state", by_name(frames.by_state, gaze::kFoveaStateNames)}}},
            {"gaze",
             {{"received", report.gaze.received},
              {"invalid", report.gaze.invalid},
              {"lost", report.gaze.lost},
              {"out_of_order", report.gaze.out_of_order}}},
            {"samples",
             {{"grids", grids_json(config.grids, samples)},
              {"pixels_output", samples.pixels_output},
              {"pixels_hidden", samples.pixels_hidden},
              {"times_fewer_than_full", or_null(report.samples_saved_factor())}}},
            {"happenings", happenings_json(report)},
            {"other_happenings", report.other_happenings}};
}

std::string json_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gazeloop::report
