#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/recordings/tell_gaze.h"

namespace gazeloop::cli {
namespace {

struct GazeCommand {
    LogOptions log;
    RecordedGazeOptions recorded;
    recordings::GazeQuestion question;
};

}  // namespace

void add_gaze_command(Command program) {
    Command app = program.command(
        "gaze", "how far recorded gaze can be trusted; exit code 3: run and replay refuse it");
    const auto command = std::make_shared<GazeCommand>();
    app.option("file", command->question.file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("other", command->question.other,
               "another recording of the same eyes at the same time: lag, gain and offset")
        .type("TRACE|SESSION");
    command->recorded.add_to(app);
    app.option("--html", command->question.outputs.html,
               "write it as one page with plots; - is stdout")
        .type("FILE");
    app.option("--events", command->question.outputs.events,
               "write what the eyes did as CSV, a line per event; - is stdout")
        .type("FILE");
    app.option("--json", command->question.outputs.json,
               "write it as JSON; without a file, to stdout")
        .file_or_stdout();
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        command->question.read = command->recorded.read_options();
        recordings::tell_gaze(command->question);
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
