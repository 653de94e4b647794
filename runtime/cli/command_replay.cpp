#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "drivers/session/session_source.h"
#include "drivers/trace/read_trace.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/frame_run.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/session/session_file.h"
#include "runtime/settings/recorded_values.h"

namespace gazeloop::cli {
namespace {

constexpr const char* kSessionFormat = "session";

struct ReplayCommand {
    RunOptions options;
    std::string file;
    std::string format = "auto";
    std::string clock = "virtual";
    double speed = 1.0;
};

ExitCode replay_trace(const ReplayCommand& command, gaze::GazeTrace trace,
                      const run::ProgramSettings& settings, run::FrameRunRequest& request) {
    const profiles::TrackerProfile tracker =
        value_or_throw(profiles::tracker_in_force(settings.values().profile, settings));
    // A session knows when its samples arrived; other traces get the profile's delay.
    const std::int64_t delay_ns = trace.format == kSessionFormat ? 0 : tracker.delay_ns;
    request.make_source = run::trace_player(std::move(trace), delay_ns, command.speed);
    request.clock = command.clock == "wall" ? run::RunClock::Wall : run::RunClock::Virtual;
    request.loop.end_with_source = true;
    return exit_code(run::frame_run(request));
}

/// A session's gaze as a trace, in the order in which it arrived, the first of it at 0. What has no
/// known time keeps none: losses, and what came before the tracker's clock was known.
gaze::GazeTrace trace_of(const session::SessionFile& session, const std::string& file) {
    gaze::GazeTrace trace;
    trace.file = file;
    trace.format = kSessionFormat;
    trace.device = "recorded session";
    if (session.samples.empty()) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{}: the session holds no gaze to replay", file));
    }
    const gaze::GazeSample& first = session.samples.front().sample;
    const time::Stamp start = first.arrived.known() ? first.arrived : first.sampled;
    for (const session::RecordedSample& recorded : session.samples) {
        gaze::GazeSample sample = recorded.sample;
        for (time::Stamp* const stamp : {&sample.sampled, &sample.ready, &sample.arrived}) {
            // Eleven days; --speed may stretch them a thousandfold.
            constexpr std::int64_t kLongest_ns = 1'000'000'000'000'000;
            std::int64_t since_start_ns = 0;
            if (__builtin_sub_overflow(stamp->ns, start.ns, &since_start_ns) ||
                since_start_ns < -kLongest_ns || since_start_ns > kLongest_ns) {
                stamp->kind = time::StampKind::Unknown;
            }
            *stamp = stamp->known() ? time::Stamp{since_start_ns, stamp->kind} : time::Stamp{};
        }
        trace.samples.push_back(sample);
    }
    return trace;
}

/// Refuses what the program cannot have recorded.
void check_frames(const session::SessionFile& session, const std::string& file) {
    const auto damaged = [&](std::size_t frame, std::string_view what) {
        return SetupError(ErrorKind::BadInput, fmt::format("{}: frame {}: {}: the recording is "
                                                           "damaged; replay its gaze with --clock "
                                                           "wall instead",
                                                           file, frame, what));
    };
    if (session.frames.empty()) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{}: the session holds no frame to replay", file));
    }
    for (std::size_t i = 0; i < session.frames.size(); ++i) {
        const frame::FrameRecord& frame = session.frames[i].frame;
        if (frame.index != i) {
            throw damaged(i, "missing");
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeView& view = frame.views[gaze::index(eye)];
            const gaze::EyeView& first = session.frames[0].frame.views[gaze::index(eye)];
            const double turn =
                glm::length(view.pose.orientation) + glm::length(frame.head.orientation);
            const glm::dvec3 place = view.pose.position_m + frame.head.position_m;
            const auto [smallest, largest] = std::minmax(view.width_px, view.height_px);
            if (!gaze::is_valid(view) || smallest < 2 || largest > 16384 ||
                !(std::abs(turn - 2.0) < 1e-3) || !std::isfinite(place.x + place.y + place.z) ||
                !std::isfinite(frame.scene_time_s)) {
                throw damaged(i, fmt::format("impossible view of the {} eye",
                                             gaze::kEyeNames[gaze::index(eye)]));
            }
            if (view.width_px != first.width_px || view.height_px != first.height_px) {
                throw damaged(i, "the picture changes its size");
            }
        }
    }
}

ExitCode replay_session(const ReplayCommand& command, run::ProgramSettings& settings,
                        run::FrameRunRequest& request) {
    const session::SessionFile session = value_or_throw(session::read_session(command.file));
    if (!session.closed_cleanly) {
        spdlog::warn("{}: the recording was not closed; what it holds is replayed", command.file);
    }
    if (const auto taken = settings::take_recorded(session.header.config, command.file, settings);
        !taken) {
        throw SetupError(ErrorKind::BadInput, taken.error().message);
    }
    value_or_throw(settings.set("target.name", "headless", "replay of a session"));
    value_or_throw(command.options.apply_to(settings, false));
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    if (command.clock == "wall") {
        return replay_trace(command, trace_of(session, command.file), settings, request);
    }
    if (command.speed != 1.0) {
        throw SetupError(ErrorKind::Usage,
                         "--speed: a session's own time line is replayed as it was; use --clock "
                         "wall to play its gaze faster or slower");
    }
    check_frames(session, command.file);
    std::vector<drivers::SessionSource::Sample> samples;
    for (const session::RecordedSample& recorded : session.samples) {
        if (recorded.frame < session.frames.size()) {
            samples.push_back(
                {session.frames[recorded.frame].frame.stamps.latch.ns, recorded.sample});
        }
    }
    request.make_source = [samples, file = command.file](std::int64_t) {
        return std::make_unique<drivers::SessionSource>(file, samples);
    };
    request.clock = run::RunClock::Recorded;
    request.session = &session;
    const auto as_recorded = [&](settings::Concerns what) {
        return settings::are_as_recorded(session.header.config, what, settings);
    };
    request.same_gaze = as_recorded(settings::Concerns::Foveae);
    request.same_rendering = as_recorded(settings::Concerns::Picture);
    return exit_code(run::frame_run(request));
}

ExitCode replay(const ReplayCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    run::FrameRunRequest request;
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
    value_or_throw(settings.check());
    return replay_trace(command, value_or_throw(drivers::read_trace(command.file, command.format)),
                        settings, request);
}

}  // namespace

void add_replay_command(Command program, const std::string& command_line) {
    Command app = program.command("replay", "replay a gaze trace or a recorded session");
    const auto command = std::make_shared<ReplayCommand>();
    app.option("file", command->file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("--format", command->format, "auto, gazeloop, htc-vive-pro");
    app.option("--clock", command->clock,
               "virtual: the same result on every run; wall: in real time")
        .one_of({"virtual", "wall"});
    app.option("--speed", command->speed, "how many times as fast as recorded")
        .type("X")
        .number_between(1e-3, 1e3);
    command->options.add_to(app);
    app.does([=] {
        command->options.log.apply();
        return replay(*command, command_line);
    });
}

}  // namespace gazeloop::cli
