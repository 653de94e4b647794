#include "runtime/session_report/report_session.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/profiles/profiles.h"
#include "runtime/report/frame_csv.h"
#include "runtime/report/output_file.h"
#include "runtime/report/perfetto/perfetto_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/govern.h"
#include "runtime/run/tracker_figures.h"
#include "runtime/session_report/session_report.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::session_report {
namespace {

/// One output takes stdout, and no two take the same file, nor one that is read.
void check_outputs(const ReportRequest& request) {
    std::vector<report::NamedFile> outputs;
    for (const auto& [option, file] : request.outputs()) {
        outputs.push_back({option, *file});
    }
    const std::array<report::NamedFile, 6> inputs{{{"the session", request.file},
                                                   {"--against", request.against},
                                                   {"--probe", request.probe},
                                                   {"--runtime-metrics", request.runtime.metrics},
                                                   {"--runtime-csv", request.runtime.csv},
                                                   {"--budget", request.budget}}};
    value_or_throw(report::check_outputs(outputs, inputs));
}

/// None: nothing decides the exit code.
std::optional<latency::LatencyBudget> budget_of(const ReportRequest& request) {
    if (request.budget_ms) {
        return latency::LatencyBudget{.name = fmt::format("of {} ms", *request.budget_ms),
                                      .description = {},
                                      .source = "--budget-ms",
                                      .total_ns = time::ms_to_ns(*request.budget_ms)};
    }
    return request.budget.empty()
               ? std::nullopt
               : std::optional(value_or_throw(profiles::load_budget(request.budget)));
}

/// Plays the session; the Perfetto trace is written meanwhile.
report::SessionSummary summary_of(const ReportRequest& request, const session::OpenSession& session,
                                  SessionReport& made) {
    std::optional<report::perfetto::PerfettoFile> perfetto;
    std::vector<frame::FrameObserver*> also{&made.events};
    if (auto front = run::governed_front(session.info().header.config)) {
        made.levels.emplace(std::move(*front));
        also.push_back(&*made.levels);
    }
    const bool every_sample = !request.perfetto.empty() && request.perfetto_samples == "all";
    if (!request.perfetto.empty()) {
        perfetto.emplace(request.perfetto, session.info().header,
                         every_sample ? report::perfetto::SampleDetail::All
                                      : report::perfetto::SampleDetail::Used);
        also.push_back(&perfetto->observer());
    }
    report::SessionSummary summary = value_or_throw(report::summarize(
        session, request.runtime,
        {.observers = also,
         .gaze = every_sample ? session::PlayedGaze::Samples : session::PlayedGaze::Counts}));
    if (perfetto) {
        for (const std::string& lack : perfetto->finish()) {
            spdlog::info("{} lacks {}", request.perfetto, lack);
        }
    }
    return summary;
}

std::optional<Against> compared(const std::string& file, const session::OpenSession& session,
                                const report::SessionSummary& summary,
                                const report::Percentiles& percentiles) {
    if (file.empty()) {
        return std::nullopt;
    }
    const auto other = value_or_throw(session::OpenSession::open(file));
    const report::SessionSummary before = value_or_throw(report::summarize(other));
    return Against{
        value_or_throw(report::compare({.session = other, .summary = before},
                                       {.session = session, .summary = summary}, percentiles)),
        file};
}

/// Everything but the outputs.
void fill(const ReportRequest& request, const session::OpenSession& session, SessionReport& made) {
    made.summary = summary_of(request, session, made);
    const report::SessionSummary& summary = made.summary;
    made.prediction = latency::check_prediction(
        run::tracker_figures(made.info.header.config, summary.origin), summary.report);
    made.reasons = report::lag_reasons({.report = &summary.report,
                                        .budget = made.budget ? &*made.budget : nullptr,
                                        .origin = summary.origin,
                                        .prediction = made.prediction,
                                        .use = summary.use,
                                        .smoothing = summary.smoothing,
                                        .unplaced = summary.unplaced.view(),
                                        .log_missing = !made.info.missing_log.empty(),
                                        .settings = made.info.header.config,
                                        .device = made.info.header.device});
    if (made.budget) {
        made.gate = report::budget_gate(summary.report, *made.budget);
    }
    made.against = compared(request.against, session, summary, made.percentiles);
    if (!request.probe.empty()) {
        made.measured =
            value_or_throw(probe::compare(value_or_throw(probe::read_measurement(request.probe)),
                                          session, summary.report.config));
    }
}

void write_csv(const std::string& file, const report::FrameLog& frames) {
    report::OutputFile output = value_or_throw(report::OutputFile::open(file));
    value_or_throw(report::write_frame_csv(
        frames, [&output](std::string_view piece) { return output.write(piece); }));
    value_or_throw(output.close());
}

}  // namespace

void report_session(const ReportRequest& request) {
    // What was asked for wrongly is refused before the session is read.
    check_outputs(request);
    const report::Percentiles percentiles =
        request.percentiles ? value_or_throw(report::Percentiles::parse(*request.percentiles))
                            : report::Percentiles{};
    const std::optional<latency::LatencyBudget> budget = budget_of(request);
    const auto session = value_or_throw(session::OpenSession::open(request.file));
    SessionReport made{.info = session.info(), .percentiles = percentiles, .budget = budget};
    fill(request, session, made);
    if (request.tells()) {
        value_or_throw(report::write_text("-", text_of(made)));
    }
    if (!request.csv.empty()) {
        write_csv(request.csv, *made.summary.frames);
    }
    if (!request.html.empty()) {
        value_or_throw(report::write_text(request.html, page_of(made, request.file)));
    }
    if (!request.json.empty()) {
        value_or_throw(report::write_text(request.json, report::json_text(json_of(made))));
    }
    if (made.gate) {
        value_or_throw(made.gate->result());
    }
}

}  // namespace gazeloop::session_report
