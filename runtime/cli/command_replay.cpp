#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/run/replay_run.h"

namespace gazeloop::cli {
namespace {

struct ReplayCommand {
    RunOptions options;
    std::string clock = "virtual";
    run::Replay replay;
};

ExitCode replay(const ReplayCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    run::FrameRunRequest request;
    request.settings = &settings;
    request.command_line = command_line;
    command.options.fill(request);
    run::Replay replay = command.replay;
    replay.wall_clock = command.clock == "wall";
    request.reads.push_back({"the recording", replay.file});
    std::optional<session::OpenSession> session;
    if (session::looks_like_session(replay.file)) {
        session = run::open_for_replay(replay.file, settings);
        value_or_throw(command.options.apply_to(settings, false));
    } else {
        // In virtual time nothing that is configured on this machine may change the result.
        value_or_throw(settings.set("target.name", "headless", "replay"));
        value_or_throw(command.options.apply_to(settings, replay.wall_clock));
    }
    if (command.options.prints(settings)) {
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    return exit_code(session ? run::replay_session(replay, *session, settings, request)
                             : run::replay_trace(replay, settings, request));
}

}  // namespace

void add_replay_command(Command program, const std::string& command_line) {
    Command app = program.command("replay", "replay a gaze trace or a recorded session");
    const auto command = std::make_shared<ReplayCommand>();
    app.option("file", command->replay.file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("--format", command->replay.format, trace_formats_text());
    app.option("--clock", command->clock,
               "virtual: the same result on every run; wall: in real time")
        .one_of({"virtual", "wall"});
    app.option("--speed", command->replay.speed, "how many times as fast as recorded")
        .type("X")
        .number_between(1e-3, 1e3);
    command->options.add_to(app);
    app.does([=] {
        command->options.log.apply();
        return replay(*command, command_line);
    });
}

}  // namespace gazeloop::cli
