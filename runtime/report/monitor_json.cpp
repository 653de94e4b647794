#include "runtime/report/monitor_json.h"

#include <nlohmann/json.hpp>

#include "runtime/frame/event.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

Json milliseconds(const std::optional<std::int64_t>& ns) {
    return ns ? Json(static_cast<double>(*ns) / time::kNsPerMs) : Json(nullptr);
}

Json budget_json(const latency::LatencyBudget& budget) {
    Json stages = Json::object();
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (budget.stages_ns[stage]) {
            stages[std::string(latency::kStageKeys[stage])] = milliseconds(budget.stages_ns[stage]);
        }
    }
    return {{"name", budget.name},
            {"source", budget.source},
            {"total_ms", milliseconds(budget.total_ns)},
            {"stages_ms", stages}};
}

Json part_json(const latency::MonitorPart& part) {
    return {{"limit_ms", milliseconds(part.limit_ns)},
            {"broken", part.limit_ns ? Json(part.broken) : Json(nullptr)},
            {"known", part.known},
            {"unknown", part.unknown},
            {"p50_ms", milliseconds(part.p50_ns)},
            {"p95_ms", milliseconds(part.p95_ns)},
            {"p99_ms", milliseconds(part.p99_ns)},
            {"run",
             {{"known", part.all_known},
              {"unknown", part.all_unknown},
              {"above", part.limit_ns ? Json(part.violations) : Json(nullptr)},
              {"longest_frames", part.limit_ns ? Json(part.longest_run_frames) : Json(nullptr)},
              {"longest_ms", part.limit_ns ? milliseconds(part.longest_run_ns) : Json(nullptr)}}}};
}

Json stamp_json(const time::Stamp& stamp) { return stamp.known() ? Json(stamp.ns) : Json(nullptr); }

std::string line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string monitor_begin_json(const std::optional<latency::LatencyBudget>& budget,
                               std::string_view clock) {
    return line({{"what", "begin"},
                 {"schema", kSchema},
                 {"clock", clock},
                 {"budget", budget ? budget_json(*budget) : Json(nullptr)}});
}

std::string monitor_snapshot_json(std::string_view what, const latency::MonitorSnapshot& snapshot,
                                  std::uint64_t dropped) {
    Json states = Json::object();
    for (std::size_t state = 0; state < snapshot.by_state.size(); ++state) {
        states[std::string(gaze::kFoveaStateNames[state])] = snapshot.by_state[state];
    }
    Json kinds = nullptr;
    if (snapshot.share_by_kind_percent) {
        kinds = Json::object();
        for (std::size_t kind = 0; kind < time::kStampKindCount; ++kind) {
            kinds[std::string(time::kStampKindNames[kind])] =
                (*snapshot.share_by_kind_percent)[kind];
        }
    }
    Json parts = Json::object();
    for (std::size_t part = 0; part < latency::kMonitorPartCount; ++part) {
        parts[std::string(latency::kMonitorPartKeys[part])] = part_json(snapshot.parts[part]);
    }
    const bool any = snapshot.frames > 0;
    return line(
        {{"what", what},
         {"time_ns", stamp_json(snapshot.time)},
         {"time_kind", time::name(snapshot.time.kind)},
         {"frame", any ? Json(snapshot.frame) : Json(nullptr)},
         {"frames", snapshot.frames},
         {"with_gaze", snapshot.with_gaze},
         {"missed", snapshot.missed},
         {"gaze_state", any ? Json(gaze::kFoveaStateNames[static_cast<std::size_t>(snapshot.state)])
                            : Json(nullptr)},
         {"window",
          {{"ms", milliseconds(snapshot.window_ns)},
           {"frames", snapshot.window_frames},
           {"cut", snapshot.window_cut},
           {"by_gaze_state", states},
           {"percent_by_kind", kinds}}},
         {"parts", parts},
         {"lines_dropped", dropped}});
}

std::string monitor_event_json(const time::Stamp& time, std::string_view kind,
                               std::string_view text, std::uint64_t dropped) {
    return line({{"what", "event"},
                 {"time_ns", stamp_json(time)},
                 {"time_kind", time::name(time.kind)},
                 {"kind", kind},
                 {"warning", frame::weight_of(kind) == frame::EventWeight::Warning},
                 {"text", text},
                 {"lines_dropped", dropped}});
}

}  // namespace gazeloop::report
