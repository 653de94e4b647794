#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/probe/comparison.h"
#include "runtime/profiles/profiles.h"
#include "runtime/report/budget_gate.h"
#include "runtime/report/comparison_text.h"
#include "runtime/report/frame_csv.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/output_file.h"
#include "runtime/report/page/event_line.h"
#include "runtime/report/page/report_page.h"
#include "runtime/report/page/report_sections.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/perfetto/perfetto_file.h"
#include "runtime/report/prediction_text.h"
#include "runtime/report/recording_text.h"
#include "runtime/report/session_json.h"
#include "runtime/report/session_summary.h"
#include "runtime/report/session_text.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/tracker_figures.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::cli {
namespace {

struct ReportCommand {
    LogOptions log;
    std::string file;
    std::string percentiles;
    bool percentiles_given = false;
    std::string csv;
    std::string html;
    std::string json;
    std::string perfetto;
    std::string perfetto_samples = "used";
    report::RuntimeFiles runtime;
    std::string against;
    std::string probe;
    std::string budget;
    std::optional<double> budget_ms;

    /// The outputs with their options.
    [[nodiscard]] std::array<std::pair<std::string_view, const std::string*>, 4> outputs() const {
        return {{{"--csv", &csv}, {"--html", &html}, {"--json", &json}, {"--perfetto", &perfetto}}};
    }
    /// Whether stdout is left for people.
    [[nodiscard]] bool tells() const {
        return csv != "-" && html != "-" && json != "-" && perfetto != "-";
    }
};

/// What another session's figures became in this one, with that session's name.
struct Against {
    report::Comparison comparison;
    std::string before;
};

/// All that is said of a session.
struct Report {
    const session::SessionInfo& info;
    report::Percentiles percentiles{};
    std::optional<latency::LatencyBudget> budget{};
    report::page::EventLine events{};
    report::SessionSummary summary{};
    latency::PredictionCheck prediction{};
    report::LagReasons reasons{};
    std::optional<report::BudgetGate> gate{};
    std::optional<Against> against{};
    std::optional<probe::Comparison> measured{};
};

/// One output takes stdout, and no two take the same file, nor one that is read.
void check_outputs(const ReportCommand& command) {
    std::vector<report::NamedFile> outputs;
    for (const auto& [option, file] : command.outputs()) {
        if (!file->empty()) {
            value_or_throw(report::check_output(*file));
            outputs.push_back({option, *file});
        }
    }
    const std::array<report::NamedFile, 5> inputs{{{"the session", command.file},
                                                   {"--against", command.against},
                                                   {"--probe", command.probe},
                                                   {"--runtime-metrics", command.runtime.metrics},
                                                   {"--runtime-csv", command.runtime.csv}}};
    value_or_throw(report::check_apart(outputs, inputs));
}

/// None: nothing decides the exit code.
std::optional<latency::LatencyBudget> budget_of(const ReportCommand& command) {
    if (command.budget_ms) {
        return latency::LatencyBudget{.name = fmt::format("of {} ms", *command.budget_ms),
                                      .description = {},
                                      .source = "--budget-ms",
                                      .total_ns = time::ms_to_ns(*command.budget_ms)};
    }
    return command.budget.empty()
               ? std::nullopt
               : std::optional(value_or_throw(profiles::load_budget(command.budget)));
}

/// Plays the session; the Perfetto trace is written meanwhile.
report::SessionSummary summary_of(const ReportCommand& command, const session::OpenSession& session,
                                  report::page::EventLine& events) {
    std::optional<report::perfetto::PerfettoFile> perfetto;
    std::vector<frame::FrameObserver*> also{&events};
    const bool every_sample = !command.perfetto.empty() && command.perfetto_samples == "all";
    if (!command.perfetto.empty()) {
        perfetto.emplace(command.perfetto, session.info().header,
                         every_sample ? report::perfetto::SampleDetail::All
                                      : report::perfetto::SampleDetail::Used);
        also.push_back(&perfetto->observer());
    }
    report::SessionSummary summary = value_or_throw(report::summarize(
        session, command.runtime,
        {.observers = also,
         .gaze = every_sample ? session::PlayedGaze::Samples : session::PlayedGaze::Counts}));
    if (perfetto) {
        for (const std::string& lack : perfetto->finish()) {
            spdlog::info("{} lacks {}", command.perfetto, lack);
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
void fill(const ReportCommand& command, const session::OpenSession& session, Report& made) {
    made.summary = summary_of(command, session, made.events);
    const report::SessionSummary& summary = made.summary;
    made.prediction = latency::check_prediction(
        run::tracker_figures(made.info.header.config, summary.origin), summary.report);
    made.reasons = report::lag_reasons({.report = &summary.report,
                                        .budget = made.budget ? &*made.budget : nullptr,
                                        .origin = summary.origin,
                                        .prediction = made.prediction,
                                        .use = summary.use,
                                        .smoothing = summary.smoothing,
                                        .settings = made.info.header.config});
    if (made.budget) {
        made.gate = report::budget_gate(summary.report, *made.budget);
    }
    made.against = compared(command.against, session, summary, made.percentiles);
    if (!command.probe.empty()) {
        made.measured =
            value_or_throw(probe::compare(value_or_throw(probe::read_measurement(command.probe)),
                                          session, summary.report.config));
    }
}

void tell(const Report& made) {
    const report::SessionSummary& summary = made.summary;
    fmt::print("{}{}{}\n{}",
               report::session_text(summary, made.percentiles, report::lag_text(made.reasons)),
               summary.trace.text(), summary.runtime.text(),
               report::prediction_text(made.prediction, summary.report));
    for (const std::string& line : report::recording_lines(made.info, summary.end)) {
        fmt::print("{}\n", line);
    }
    if (made.measured) {
        fmt::print("{}", probe::comparison_text(*made.measured));
    }
    if (made.gate) {
        fmt::print("\n{}", report::gate_text(*made.gate));
    }
    if (made.against) {
        fmt::print("{}", report::comparison_text(made.against->comparison, made.percentiles,
                                                 made.against->before));
    }
}

nlohmann::ordered_json json_of(const Report& made) {
    nlohmann::ordered_json json = report::session_json(made.summary, made.info, made.percentiles);
    json["why_the_fovea_lags"] = report::lag_json(made.reasons);
    json["prediction"] = report::prediction_json(made.prediction);
    made.summary.runtime.add_to(json);
    if (made.measured) {
        json["probe"] = probe::comparison_json(*made.measured);
    }
    if (made.gate) {
        json["budget"] = report::gate_json(*made.gate);
    }
    if (made.against) {
        json["against"] = report::comparison_json(made.against->comparison, made.percentiles,
                                                  made.against->before);
    }
    return json;
}

std::string page_of(const ReportCommand& command, const Report& made) {
    std::vector<report::page::PageSection> sections{
        report::page::section_of(report::prediction_table(made.prediction, made.summary.report))};
    if (const std::string runtime = made.summary.runtime.text(); !runtime.empty()) {
        sections.push_back(
            report::page::section_of_lines("runtime", "The runtime's own account", runtime));
    }
    if (made.measured) {
        sections.push_back(report::page::section_of_lines("probe", "Eye to photon, as measured",
                                                          probe::comparison_text(*made.measured)));
    }
    if (made.gate) {
        sections.push_back(report::page::section_of(*made.gate));
    }
    if (made.against) {
        sections.push_back(report::page::section_of(made.against->comparison, made.percentiles,
                                                    made.against->before));
    }
    return report::page::report_page({.session = made.summary,
                                      .info = made.info,
                                      .events = made.events,
                                      .percentiles = made.percentiles,
                                      .file = std::filesystem::path(command.file).filename(),
                                      .budget = made.budget ? &*made.budget : nullptr,
                                      .why = report::page::why_of(made.reasons),
                                      .sections = sections});
}

void write_csv(const std::string& file, const report::FrameLog& frames) {
    report::OutputFile output = value_or_throw(report::OutputFile::open(file));
    value_or_throw(report::write_frame_csv(
        frames, [&output](std::string_view piece) { return output.write(piece); }));
    value_or_throw(output.close());
}

ExitCode report(const ReportCommand& command) {
    // What was asked for wrongly is refused before the session is read.
    check_outputs(command);
    const report::Percentiles percentiles =
        command.percentiles_given ? value_or_throw(report::Percentiles::parse(command.percentiles))
                                  : report::Percentiles{};
    const std::optional<latency::LatencyBudget> budget = budget_of(command);
    const auto session = value_or_throw(session::OpenSession::open(command.file));
    Report made{.info = session.info(), .percentiles = percentiles, .budget = budget};
    fill(command, session, made);
    if (command.tells() && !command.log.quiet) {
        tell(made);
    }
    if (!command.csv.empty()) {
        write_csv(command.csv, *made.summary.frames);
    }
    if (!command.html.empty()) {
        value_or_throw(report::write_text(command.html, page_of(command, made)));
    }
    if (!command.json.empty()) {
        value_or_throw(report::write_text(command.json, report::json_text(json_of(made))));
    }
    if (made.gate) {
        value_or_throw(made.gate->result());
    }
    return ExitCode::Ok;
}

}  // namespace

void add_report_command(Command program) {
    Command app = program.command("report", "where a session's latency went");
    const auto command = std::make_shared<ReportCommand>();
    app.option("file", command->file, "a session written by --record").required().type("SESSION");
    const Option percentiles =
        app.option("--percentiles", command->percentiles,
                   "percents to show, separated by commas (default 50,90,95,99,99.9)")
            .type("LIST");
    app.option("--csv", command->csv, "write every frame as a line of CSV; - is stdout")
        .type("FILE");
    app.option("--html", command->html, "write the report as one page with plots; - is stdout")
        .type("FILE");
    app.option("--json", command->json, "write the report as JSON; - is stdout").type("FILE");
    const Option perfetto = app.option("--perfetto", command->perfetto,
                                       "write a trace for ui.perfetto.dev; - is stdout")
                                .type("FILE");
    app.option("--perfetto-samples", command->perfetto_samples,
               "gaze samples in it: those that frames rested on (used), or all")
        .one_of({"used", "all"})
        .only_with(perfetto);
    app.option("--against", command->against,
               "also show what changed since this session, and how much of it is chance")
        .type("SESSION");
    app.option("--probe", command->probe,
               "show eye-to-photon as gazeloop probe --video --json FILE measured it beside it")
        .type("FILE")
        .not_empty();
    const Option named =
        app.option("--budget", command->budget,
                   "exit code 1 unless the session keeps this budget: a name or a .toml file")
            .type("NAME")
            .not_empty();
    app.option("--budget-ms", command->budget_ms,
               "the same with a limit on the gaze age at display alone")
        .type("N")
        .number_between(0.001, 1000)
        .not_with(named);
    app.option("--runtime-metrics", command->runtime.metrics,
               "when frames were shown, by monado-service's XRT_METRICS_FILE of the run")
        .type("FILE");
    app.option("--runtime-csv", command->runtime.csv,
               "the stages of WiVRn, by its server's WIVRN_DUMP_TIMINGS of the run")
        .type("FILE");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        command->percentiles_given = percentiles.given();
        return report(*command);
    });
}

}  // namespace gazeloop::cli
