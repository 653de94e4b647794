#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/report/output_file.h"
#include "runtime/report/session_summary.h"
#include "runtime/report/summary_json.h"
#include "runtime/report/summary_text.h"

namespace gazeloop::cli {
namespace {

struct ReportCommand {
    LogOptions log;
    std::string file;
    std::string json;
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

ExitCode report(const ReportCommand& command) {
    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
    }
    const auto session = value_or_throw(session::OpenSession::open(command.file));
    const session::SessionInfo& info = session.info();
    const report::SessionSummary summary = value_or_throw(report::summarize(session));
    if (command.json != "-" && !command.log.quiet) {
        fmt::print("{}{}", report::summary_text(summary.report), summary.trace.text());
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
    }
    if (!command.json.empty()) {
        nlohmann::ordered_json json = report::summary_json(summary.report);
        summary.trace.add_to(json);
        value_or_throw(report::write_text(command.json, report::json_text(json)));
    }
    return ExitCode::Ok;
}

}  // namespace

void add_report_command(Command program) {
    Command app = program.command("report", "where a session's latency went");
    const auto command = std::make_shared<ReportCommand>();
    app.option("file", command->file, "a session written by --record").required().type("SESSION");
    app.option("--json", command->json, "write the report as JSON; - is stdout").type("FILE");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        return report(*command);
    });
}

}  // namespace gazeloop::cli
