#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/report/comparison_text.h"
#include "runtime/report/frame_csv.h"
#include "runtime/report/output_file.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/session_json.h"
#include "runtime/report/session_summary.h"
#include "runtime/report/session_text.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::cli {
namespace {

struct ReportCommand {
    LogOptions log;
    std::string file;
    std::string percentiles;
    bool percentiles_given = false;
    std::string csv;
    std::string json;
    std::string against;
};

/// What another session's figures became in this one, with that session's name.
struct Against {
    report::Comparison comparison;
    std::string before;
};

/// Where a recording ends that was not closed, and what is known of what it lacks.
std::string end_of(const session::SessionInfo& info, const session::PlaybackEnd& end) {
    std::string text = "The recording was not closed: it ";
    text += end.last_frame ? fmt::format("ends at frame {}.", *end.last_frame) : "has no frames.";
    if (!info.missing_log.empty()) {
        text += fmt::format(" But {}.", info.missing_log);
    } else if (info.writing_failed) {
        text += " Writing it failed there.";
    } else if (info.had_write_ahead_log) {
        text += " It lacks at most its last 100 ms.";
    }
    return text;
}

/// One output takes stdout, and no two take the same file.
void check_outputs(const ReportCommand& command) {
    for (const std::string* const file : {&command.csv, &command.json}) {
        if (!file->empty()) {
            value_or_throw(report::check_output(*file));
        }
    }
    if (!command.csv.empty() && command.csv == command.json) {
        throw SetupError(
            ErrorKind::Usage,
            fmt::format("--csv and --json both name {}: give each a file of its own", command.csv));
    }
}

void write_csv(const std::string& file, const report::FrameLog& frames) {
    report::OutputFile output = value_or_throw(report::OutputFile::open(file));
    value_or_throw(report::write_frame_csv(
        frames, [&output](std::string_view piece) { return output.write(piece); }));
    value_or_throw(output.close());
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

ExitCode report(const ReportCommand& command) {
    const report::Percentiles percentiles =
        command.percentiles_given ? value_or_throw(report::Percentiles::parse(command.percentiles))
                                  : report::Percentiles{};
    check_outputs(command);
    const auto session = value_or_throw(session::OpenSession::open(command.file));
    const session::SessionInfo& info = session.info();
    const report::SessionSummary summary = value_or_throw(report::summarize(session));
    const auto against = compared(command.against, session, summary, percentiles);
    if (command.json != "-" && command.csv != "-" && !command.log.quiet) {
        fmt::print("{}{}", report::session_text(summary, percentiles), summary.trace.text());
        if (!info.closed_cleanly) {
            fmt::print("{}\n", end_of(info, summary.end));
        }
        if (summary.end.last_error) {
            fmt::print("The run failed: {}\n", *summary.end.last_error);
        }
        if (info.records_dropped > 0) {
            fmt::print("The recording lacks {} records that the disk was too slow for.\n",
                       info.records_dropped);
        }
        if (against) {
            fmt::print("{}",
                       report::comparison_text(against->comparison, percentiles, against->before));
        }
    }
    if (!command.csv.empty()) {
        write_csv(command.csv, *summary.frames);
    }
    if (!command.json.empty()) {
        nlohmann::ordered_json json = report::session_json(summary, info, percentiles);
        if (against) {
            json["against"] =
                report::comparison_json(against->comparison, percentiles, against->before);
        }
        value_or_throw(report::write_text(command.json, report::json_text(json)));
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
    app.option("--json", command->json, "write the report as JSON; - is stdout").type("FILE");
    app.option("--against", command->against,
               "also show what changed since this session, and how much of it is chance")
        .type("SESSION");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        command->percentiles_given = percentiles.given();
        return report(*command);
    });
}

}  // namespace gazeloop::cli
