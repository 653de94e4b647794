#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/openxr_layer/control/launch.h"
#include "runtime/openxr_layer/control/layer_files.h"
#include "runtime/openxr_layer/control/layer_status.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::cli {
namespace {

namespace layer = openxr_layer;

struct LayerCommand {
    std::string gaze;
    std::string record;
    std::string json;
    std::string executable;
    std::vector<std::string> assignments;
    std::vector<std::string> program;

    void add_settings_to(Command command) {
        command.option("--gaze", gaze, "whose gaze applications get (layer.gaze)")
            .type("SOURCE")
            .not_empty();
        command.option("--record", record, "a session, or a folder for them (layer.record)")
            .type("FILE")
            .not_empty();
        command.option("--set", assignments, "a setting of the layer; may be repeated")
            .type("KEY=VALUE");
    }
    [[nodiscard]] std::vector<std::string> settings() const {
        std::vector<std::string> all = assignments;
        if (!gaze.empty()) {
            all.push_back("layer.gaze=" + gaze);
        }
        if (!record.empty()) {
            all.push_back("layer.record=" + record);
        }
        return all;
    }
};

ExitCode status(const std::string& json) {
    value_or_throw(json.empty()
                       ? report::write_text("-", layer::layer_status_text())
                       : report::write_text(json, report::json_text(layer::layer_status_json())));
    return ExitCode::Ok;
}

}  // namespace

void add_layer_command(Command program) {
    Command app = program.command("layer", "give other OpenXR applications gaze, and record them");
    app.require_command();
    const auto command = std::make_shared<LayerCommand>();
    Command shown = app.command("status", "whether it is on, and which applications saw it last");
    shown.option("--json", command->json, "write it as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    shown.does([=] { return status(command->json); });
    Command enabled = app.command("enable", "switch it on in every OpenXR application of yours");
    command->add_settings_to(enabled);
    enabled.does([=] {
        value_or_throw(layer::enable(command->settings()));
        return status("");
    });
    app.command("disable", "switch it off again; settings and decisions stay").does([=] {
        fmt::print("{}\n", value_or_throw(layer::disable()) ? "switched off" : "it was off");
        return ExitCode::Ok;
    });
    using Answer = layer::Permissions::Answer;
    const auto decides = [&](const char* name, Answer answer, const char* meaning) {
        Command decided = app.command(name, meaning);
        decided.option("executable", command->executable, "its file").required().type("FILE");
        decided.does([=] {
            if (!value_or_throw(layer::decide(command->executable, answer))) {
                fmt::print("{}: {}\n", command->executable,
                           answer == Answer::Unknown ? "nothing was decided on it"
                                                     : "that was decided already");
            }
            return ExitCode::Ok;
        });
    };
    decides("allow", Answer::Allowed, "let an application have gaze");
    decides("foveation", Answer::FoveationOnly,
            "let an application's pictures follow the gaze, and have no gaze");
    decides("deny", Answer::Denied, "let an application have no gaze");
    decides("forget", Answer::Unknown, "decide no more on an application");
    Command run = app.command("run", "run one application with it: gazeloop layer run -- PROGRAM");
    command->add_settings_to(run);
    run.option("program", command->program, "the application and its words, after --")
        .required()
        .type("PROGRAM...");
    run.does([=]() -> ExitCode {
        throw SetupError(layer::launch(command->program, command->settings()));
    });
}

}  // namespace gazeloop::cli
