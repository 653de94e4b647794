#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/recordings/convert.h"

namespace gazeloop::cli {
namespace {

struct ConvertCommand {
    LogOptions log;
    RecordedGazeOptions recorded;
    recordings::Conversion conversion;
};

}  // namespace

void add_convert_command(Command program) {
    Command app =
        program.command("convert", "write a trace's or a session's gaze in another format");
    const auto command = std::make_shared<ConvertCommand>();
    app.option("in", command->conversion.in, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("out", command->conversion.out,
               "a file, gzip if its name ends with .gz; bids: a folder")
        .required()
        .type("FILE|FOLDER");
    app.option("--to", command->conversion.to,
               "gazeloop: all that is known; angles: CSV of degrees; bids: BIDS 1.11 eye tracking")
        .one_of({"gazeloop", "angles", "bids"});
    const Option subject =
        app.option("--subject", command->conversion.labels.subject, "bids: the subject's label");
    const Option task =
        app.option("--task", command->conversion.labels.task, "bids: the task's label");
    command->recorded.add_to(app);
    app.option("--json", command->conversion.json,
               "what was read and written; without a file, to stdout")
        .file_or_stdout();
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        command->conversion.labelled = subject.given() || task.given();
        command->conversion.read = command->recorded.read_options();
        recordings::convert(command->conversion);
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
