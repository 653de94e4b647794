#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/read_trace.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/trace_of_session.h"

namespace gazeloop::cli {
namespace {

struct GazeCommand {
    LogOptions log;
    drivers::ReadOptions read;
    std::string file;
    std::string axes = "none";
    std::string json;
};

/// A trace of which too much was dropped or changed is looked at all the same; `refusal` then says
/// what a run would.
gaze::GazeTrace gaze_of(const GazeCommand& command, std::string& refusal) {
    if (session::looks_like_session(command.file)) {
        return run::trace_of_session(value_or_throw(session::OpenSession::open(command.file)));
    }
    drivers::ReadOptions options = command.read;
    options.axes = drivers::axes_correction_named(command.axes);
    auto trace = drivers::read_trace(command.file, options);
    if (trace || options.accept_repairs) {
        return value_or_throw(std::move(trace));
    }
    options.accept_repairs = true;
    auto repaired = drivers::read_trace(command.file, options);
    if (!repaired) {
        throw SetupError(trace.error());
    }
    refusal = trace.error().message;
    return std::move(*repaired);
}

ExitCode gaze(const GazeCommand& command) {
    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
    }
    std::string refusal;
    const gaze::GazeTrace trace = gaze_of(command, refusal);
    if (command.json != "-") {
        fmt::print("{}", report::gaze_text(trace));
    }
    if (!command.json.empty()) {
        nlohmann::ordered_json json = report::gaze_json(trace);
        json["refused"] = nullptr;
        if (!refusal.empty()) {
            json["refused"] = refusal;
        }
        value_or_throw(report::write_text(command.json, report::json_text(json)));
    }
    if (!refusal.empty()) {
        throw SetupError(ErrorKind::BadInput, refusal);
    }
    return ExitCode::Ok;
}

}  // namespace

void add_gaze_command(Command program) {
    Command app = program.command(
        "gaze", "what a recorded trace's reader found; exit code 3: run and replay refuse it");
    const auto command = std::make_shared<GazeCommand>();
    app.option("file", command->file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("--format", command->read.format, "auto, gazeloop, htc-vive-pro");
    app.option("--axes", command->axes, "turn its directions")
        .one_of({drivers::kAxesCorrectionNames.begin(), drivers::kAxesCorrectionNames.end()});
    app.flag("--accept-repairs", command->read.accept_repairs,
             "it may be one of which much was dropped or changed");
    app.option("--json", command->json, "write it as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        return gaze(*command);
    });
}

}  // namespace gazeloop::cli
