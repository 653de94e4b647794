#include <fmt/core.h>

#include <memory>
#include <utility>

#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_run_options.h"
#include "runtime/probe/instructions.h"
#include "runtime/probe/tell_video.h"
#include "runtime/run/probe_run.h"

namespace gazeloop::cli {
namespace {

struct ProbeCommand {
    GazeRunOptions run;
    std::optional<std::int64_t> trials;
    std::string video;
    double camera_fps = 0.0;
    double fps_error_percent = 0.0;
    std::optional<double> readout_ms;
    std::string lamp;
    std::string patch;
};

ExitCode measure(const ProbeCommand& command) {
    if (command.video.empty() || command.lamp.empty() || command.patch.empty() ||
        command.camera_fps == 0.0) {
        throw SetupError(ErrorKind::Usage,
                         "probe --video: --camera-fps, --lamp and --patch belong to it; gazeloop "
                         "probe --help says how to measure");
    }
    const probe::VideoQuestion question{
        .frames = command.video,
        .camera_fps = command.camera_fps,
        .fps_error_percent = command.fps_error_percent,
        .readout_ms = command.readout_ms,
        .lamp = value_or_throw(probe::parse_region("lamp", command.lamp)),
        .patch = value_or_throw(probe::parse_region("patch", command.patch))};
    return probe::tell_video(question, command.run.options.json, command.run.options.log.quiet)
               ? ExitCode::Ok
               : ExitCode::GateFailed;
}

ExitCode run_live(const ProbeCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    return request ? exit_code(run::probe_run({.trials = command.trials,
                                               .json = command.run.options.json,
                                               .quiet = command.run.options.log.quiet},
                                              std::move(*request), settings))
                   : ExitCode::Ok;
}

}  // namespace

void add_probe_command(Command program, const std::string& command_line) {
    Command app = program.command(
        "probe",
        fmt::format("measure eye-to-photon with a lamp and a camera\n\n{}", probe::kInstructions));
    const auto command = std::make_shared<ProbeCommand>();
    command->run.add_to(app);
    app.option("--trials", command->trials, "end after N flashes of the lamp (20)")
        .type("N")
        .whole_number(1'000'000);
    const Option video =
        app.option("--video", command->video, "measure instead: folder of a video's frames, as PNG")
            .type("FOLDER")
            .not_empty();
    app.option("--camera-fps", command->camera_fps, "frames per second that the camera took")
        .type("F")
        .number_between(1.0, 1e6)
        .only_with(video);
    app.option("--camera-fps-error", command->fps_error_percent,
               "by how many percent that may be off, either way")
        .type("PERCENT")
        .number_between(0.0, 100.0)
        .only_with(video);
    app.option("--readout-ms", command->readout_ms,
               "from the exposure of the picture's first row to the last one's; 0: all at once")
        .type("MS")
        .number_between(0.0, 1e3)
        .only_with(video);
    app.option("--lamp", command->lamp, "where the lamp is in the frames, pixels")
        .type("X,Y,W,H")
        .only_with(video);
    app.option("--patch", command->patch, "where the patch is in the frames, pixels")
        .type("X,Y,W,H")
        .only_with(video);
    app.does([=] {
        command->run.options.log.apply();
        return video.given() ? measure(*command) : run_live(*command, command_line);
    });
}

}  // namespace gazeloop::cli
