#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_run_options.h"
#include "runtime/probe/instructions.h"
#include "runtime/probe/live_probe.h"
#include "runtime/probe/video_result.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

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

constexpr std::int64_t kTrials = 20;

/// With JSON on stdout, nothing else goes there.
std::FILE* text_output(const std::string& json) { return json == "-" ? stderr : stdout; }

ExitCode measure(const ProbeCommand& command) {
    if (command.video.empty() || command.lamp.empty() || command.patch.empty() ||
        command.camera_fps == 0.0) {
        throw SetupError(ErrorKind::Usage,
                         "probe --video: --camera-fps, --lamp and --patch belong to it; gazeloop "
                         "probe --help says how to measure");
    }
    const std::string& json = command.run.options.json;
    if (!json.empty()) {
        value_or_throw(report::check_output(json));
    }
    const probe::VideoQuestion question{
        .frames = command.video,
        .camera_fps = command.camera_fps,
        .fps_error_percent = command.fps_error_percent,
        .readout_ms = command.readout_ms,
        .lamp = value_or_throw(probe::parse_region("lamp", command.lamp)),
        .patch = value_or_throw(probe::parse_region("patch", command.patch))};
    const probe::VideoResult result =
        value_or_throw(probe::measure_video(question, [](std::uint64_t read, std::uint64_t all) {
            constexpr std::uint64_t kEvery = 1000;
            if (read % kEvery == 0 || read == all) {
                spdlog::info("{} of {} frames read", read, all);
            }
        }));
    if (!command.run.options.log.quiet) {
        fmt::print(text_output(json), "{}", probe::video_text(result));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(json, report::json_text(probe::video_json(result))));
    }
    if (result.on.trials == 0) {
        spdlog::error("the patch never went on after the lamp: nothing was measured");
        return ExitCode::GateFailed;
    }
    return ExitCode::Ok;
}

ExitCode run_live(const ProbeCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    // Where the patch is, the scene's depth would be wrong.
    value_or_throw(settings.set("render.depth", "false", "gazeloop probe"));
    const std::string& json = command.run.options.json;
    const bool quiet = command.run.options.log.quiet;
    request->json.reset();  // the probe's own result goes there
    request->quiet = quiet || json == "-";
    if (!json.empty()) {
        value_or_throw(report::check_output(json));
    }
    if (!quiet) {
        fmt::print(text_output(json), "{}\n", probe::kInstructions);
        std::fflush(text_output(json));
    }
    probe::FlipLog log;
    request->make_overlay = [&](const vulkan::Context& context,
                                const render::RendererConfig& config) {
        return std::make_unique<probe::LiveProbe>(context, config.frames_in_flight,
                                                  settings.values().gaze.minimum_confidence, log);
    };
    const auto trials = static_cast<std::uint64_t>(command.trials.value_or(kTrials));
    // A length that was asked for holds, unless trials were too.
    const bool until_trials = command.trials || request->loop.end_with_source;
    request->loop.stop = [&log, trials, until_trials]() -> std::optional<LoopEnd> {
        return until_trials && log.lamp_flashes() >= trials ? std::optional(LoopEnd::Limit)
                                                            : std::nullopt;
    };
    const auto failure = run::frame_run(*request);
    if (!quiet) {
        fmt::print(text_output(json), "\n{}", probe::flips_text(log));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(json, report::json_text(probe::flips_json(log))));
    }
    return exit_code(failure);
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
