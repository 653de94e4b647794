#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <memory>

#include "drivers/session/session_source.h"
#include "drivers/trace/read_trace.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_sources.h"
#include "runtime/cli/profiles.h"
#include "runtime/cli/run_options.h"
#include "runtime/session/session_file.h"

namespace gazeloop::cli {
namespace {

/// Settings that a session's picture depends on.
constexpr std::array<std::string_view, 3> kPictureGroups{"kfr.", "render.method", "render.sc"};

struct ReplayCommand {
    RunOptions options;
    std::string file;
    std::string format = "auto";
    std::string clock = "virtual";
    double speed = 1.0;
};

ExitCode replay_trace(const ReplayCommand& command, drivers::Trace trace, Settings& settings,
                      FrameRunRequest& request) {
    const TrackerProfile tracker = value_or_throw(load_tracker(settings.values().profile.tracker));
    request.make_source = trace_player(std::move(trace), tracker, command.speed);
    request.clock = command.clock == "wall" ? RunClock::Wall : RunClock::Virtual;
    request.loop.end_with_source = true;
    return frame_run(request);
}

/// A session's gaze as a trace that starts at 0.
drivers::Trace trace_of(const session::SessionFile& session, const std::string& file) {
    drivers::Trace trace;
    trace.file = file;
    trace.format = "session";
    trace.device = "recorded session";
    if (session.samples.empty()) {
        throw SetupError(ExitCode::BadInput,
                         fmt::format("{}: the session holds no gaze to replay", file));
    }
    const std::int64_t start_ns = session.samples.front().sample.sampled.ns;
    for (const session::RecordedSample& recorded : session.samples) {
        trace.samples.push_back(recorded.sample);
        trace.samples.back().sampled.ns -= start_ns;
        trace.samples.back().arrived.ns -= start_ns;
    }
    return trace;
}

bool decides_picture(std::string_view key) {
    return key == "render.spp" || std::ranges::any_of(kPictureGroups, [&](std::string_view group) {
               return key.starts_with(group);
           });
}

ExitCode replay_session(const ReplayCommand& command, Settings& settings,
                        FrameRunRequest& request) {
    const session::SessionFile session = value_or_throw(session::read_session(command.file));
    if (!session.closed_cleanly) {
        spdlog::warn("{}: the recording was cut off; what it holds is replayed", command.file);
    }
    for (const auto& [key, value] : session.header.config) {
        // What is recorded about the place it ran at does not bind the replay.
        if (key != "target.name" && key != "vulkan.device" && !key.ends_with(".validation")) {
            value_or_throw(settings.set(key, value, command.file));
        }
    }
    value_or_throw(settings.set("target.name", "headless", "replay of a session"));
    value_or_throw(command.options.apply_to(settings, false));
    if (command.clock == "wall") {
        return replay_trace(command, trace_of(session, command.file), settings, request);
    }
    if (command.speed != 1.0) {
        throw SetupError(ExitCode::Usage,
                         "--speed: a session's own time line is replayed as it was; use --clock "
                         "wall to play its gaze faster or slower");
    }
    if (session.frames.empty()) {
        throw SetupError(ExitCode::BadInput,
                         fmt::format("{}: the session holds no frame to replay", command.file));
    }
    std::vector<drivers::SessionSource::Sample> samples;
    for (std::size_t i = 0; i < session.frames.size(); ++i) {
        if (session.frames[i].frame.index != i) {
            throw SetupError(ExitCode::BadInput,
                             fmt::format("{}: frame {} is missing from the recording; replay its "
                                         "gaze with --clock wall instead",
                                         command.file, i));
        }
    }
    for (const session::RecordedSample& recorded : session.samples) {
        if (recorded.frame < session.frames.size()) {
            samples.push_back(
                {session.frames[recorded.frame].frame.stamps.latch.ns, recorded.sample});
        }
    }
    request.make_source = [samples, file = command.file](std::int64_t) {
        return std::make_unique<drivers::SessionSource>(file, samples);
    };
    request.clock = RunClock::Recorded;
    request.session = &session;
    const auto now = settings.list();
    request.same_rendering = std::ranges::all_of(now, [&](const session::NamedValue& setting) {
        return !decides_picture(setting.name) || session.config(setting.name) == setting.value;
    });
    return frame_run(request);
}

ExitCode replay(const ReplayCommand& command, const std::string& command_line) {
    Settings settings;
    FrameRunRequest request;
    request.settings = &settings;
    request.command_line = command_line;
    command.options.fill(request);
    if (session::looks_like_session(command.file)) {
        return replay_session(command, settings, request);
    }
    // In virtual time nothing that is configured on this machine may change the result.
    value_or_throw(settings.set("target.name", "headless", "replay"));
    value_or_throw(command.options.apply_to(settings, command.clock == "wall"));
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    return replay_trace(command, value_or_throw(drivers::read_trace(command.file, command.format)),
                        settings, request);
}

}  // namespace

void add_replay_command(CLI::App& program, const std::string& command_line, Action& action) {
    CLI::App* const app =
        program.add_subcommand("replay", "replay a gaze trace or a recorded session");
    const auto command = std::make_shared<ReplayCommand>();
    app->add_option("file", command->file, "a trace, or a session written by --record")
        ->required()
        ->type_name("TRACE|SESSION");
    app->add_option("--format", command->format, "auto, gazeloop, htc-vive-pro");
    app->add_option("--clock", command->clock,
                    "virtual: the same result on every run; wall: in real time")
        ->check(CLI::IsMember({"virtual", "wall"}));
    app->add_option("--speed", command->speed, "how many times as fast as recorded")
        ->type_name("X")
        ->check(CLI::Range(1e-3, 1e3));
    command->options.add_to(*app);
    app->callback([=, &action] {
        command->options.common.apply_log_level();
        action = [=] { return replay(*command, command_line); };
    });
}

}  // namespace gazeloop::cli
