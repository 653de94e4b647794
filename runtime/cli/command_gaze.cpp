#include <fmt/core.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze.h"
#include "runtime/cli/run_options.h"
#include "runtime/gaze/gaze_comparison.h"
#include "runtime/report/gaze_comparison_text.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::cli {
namespace {

struct GazeCommand {
    LogOptions log;
    RecordedGazeOptions recorded;
    std::string file;
    std::string other;
    std::string json;
};

/// Two recordings of the same eyes.
ExitCode compare(const GazeCommand& command) {
    const gaze::GazeTrace one = recorded_gaze(command.file, command.recorded);
    const gaze::GazeTrace other = recorded_gaze(command.other, command.recorded);
    const gaze::GazeComparison comparison =
        value_or_throw(gaze::compare_gaze(one.samples, other.samples));
    if (command.json != "-") {
        fmt::print("{}\n{}\n{}", one.file, other.file, report::gaze_comparison_text(comparison));
    }
    if (!command.json.empty()) {
        nlohmann::ordered_json json{{"files", {one.file, other.file}},
                                    {"comparison", report::gaze_comparison_json(comparison)}};
        value_or_throw(report::write_text(command.json, report::json_text(json)));
    }
    return ExitCode::Ok;
}

ExitCode gaze(const GazeCommand& command) {
    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
        const std::array<report::NamedFile, 1> outputs{{{"--json", command.json}}};
        const std::array<report::NamedFile, 2> inputs{
            {{"the recording", command.file}, {"the other recording", command.other}}};
        value_or_throw(report::check_apart(outputs, inputs));
    }
    if (!command.other.empty()) {
        return compare(command);
    }
    std::string refusal;
    const gaze::GazeTrace trace =
        recorded_gaze_even_refused(command.file, command.recorded, refusal);
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
        "gaze", "how far recorded gaze can be trusted; exit code 3: run and replay refuse it");
    const auto command = std::make_shared<GazeCommand>();
    app.option("file", command->file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("other", command->other,
               "another recording of the same eyes at the same time: lag, gain and offset")
        .type("TRACE|SESSION");
    command->recorded.add_to(app);
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
