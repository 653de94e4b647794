#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <utility>

#include "drivers/session/session_source.h"
#include "drivers/trace/read_trace.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/recordings/trace_of_session.h"
#include "runtime/run/frame_run.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/session/playback.h"
#include "runtime/settings/recorded_values.h"

namespace gazeloop::cli {
namespace {

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
    const std::int64_t delay_ns = trace.format == recordings::kSessionFormat ? 0 : tracker.delay_ns;
    request.make_source = run::trace_player(std::move(trace), delay_ns, command.speed);
    request.clock = command.clock == "wall" ? run::RunClock::Wall : run::RunClock::Virtual;
    request.loop.end_with_source = true;
    return exit_code(run::frame_run(request));
}

void play_to(frame::FrameObserver& observer, const session::OpenSession& session) {
    const std::array<frame::FrameObserver*, 1> observers{&observer};
    value_or_throw(session::play(session, observers));
}

/// Looks through a recording before it is run again. Throws SetupError (BadInput) for what the
/// program cannot have recorded.
class ReplayableFrames final : public frame::FrameObserver {
  public:
    explicit ReplayableFrames(std::string file) : file_(std::move(file)) {}

    void on_sample(const gaze::GazeSample&, std::uint64_t) override { ++samples_told_; }
    void on_frame(const frame::FrameRecord& frame) override {
        if (frame.index != frames_) {
            throw damaged("missing");
        }
        if (frames_ == 0) {
            first_views_ = frame.views;
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            check_view(frame, eye);
        }
        ++frames_;
        samples_consumed_ = samples_told_;
    }

    /// Throws SetupError (BadInput) if there are none.
    [[nodiscard]] std::uint64_t frames() const {
        if (frames_ == 0) {
            throw SetupError(ErrorKind::BadInput,
                             fmt::format("{}: the session holds no frame to replay", file_));
        }
        return frames_;
    }
    [[nodiscard]] std::uint64_t samples_consumed() const { return samples_consumed_; }
    [[nodiscard]] const gaze::StereoView& first_views() const { return first_views_; }

  private:
    [[nodiscard]] SetupError damaged(std::string_view what) const {
        return {ErrorKind::BadInput, fmt::format("{}: frame {}: {}: the recording is damaged; "
                                                 "replay its gaze with --clock wall instead",
                                                 file_, frames_, what)};
    }

    void check_view(const frame::FrameRecord& frame, gaze::Eye eye) const {
        const gaze::EyeView& view = frame.views[gaze::index(eye)];
        const gaze::EyeView& first = first_views_[gaze::index(eye)];
        const double turn =
            glm::length(view.pose.orientation) + glm::length(frame.head.orientation);
        const glm::dvec3 place = view.pose.position_m + frame.head.position_m;
        const auto [smallest, largest] = std::minmax(view.width_px, view.height_px);
        if (!gaze::is_valid(view) || smallest < 2 || largest > 16384 ||
            !(std::abs(turn - 2.0) < 1e-3) || !std::isfinite(place.x + place.y + place.z) ||
            !std::isfinite(frame.scene_time_s)) {
            throw damaged(
                fmt::format("impossible view of the {} eye", gaze::kEyeNames[gaze::index(eye)]));
        }
        if (view.width_px != first.width_px || view.height_px != first.height_px) {
            throw damaged("the picture changes its size");
        }
    }

    std::string file_;
    std::uint64_t frames_ = 0;
    std::uint64_t samples_told_ = 0;
    std::uint64_t samples_consumed_ = 0;  ///< by these frames
    gaze::StereoView first_views_{};
};

ExitCode replay_session(const ReplayCommand& command, run::ProgramSettings& settings,
                        run::FrameRunRequest& request) {
    const auto session = value_or_throw(session::OpenSession::open(command.file));
    const session::SessionInfo& info = session.info();
    if (!info.closed_cleanly) {
        spdlog::warn("{}: the recording was not closed; what it holds is replayed{}{}",
                     command.file, info.missing_log.empty() ? "" : "; ", info.missing_log);
    }
    if (const auto taken = settings::take_recorded(info.header.config, command.file, settings);
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
        return replay_trace(command, recordings::trace_of_session(session), settings, request);
    }
    if (command.speed != 1.0) {
        throw SetupError(ErrorKind::Usage,
                         "--speed: a session's own time line is replayed as it was; use --clock "
                         "wall to play its gaze faster or slower");
    }
    ReplayableFrames found(command.file);
    play_to(found, session);
    request.recording = {&session, found.frames(), found.first_views()};
    request.make_source = [&session, samples = found.samples_consumed()](std::int64_t) {
        return std::make_unique<drivers::SessionSource>(session, samples);
    };
    request.clock = run::RunClock::Recorded;
    const auto as_recorded = [&](settings::Concerns what) {
        return settings::are_as_recorded(info.header.config, what, settings);
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
    request.reads.push_back({"the recording", command.file});
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
    drivers::ReadOptions options = drivers::read_options(settings.values().trace);
    options.format = command.format;
    return replay_trace(command, value_or_throw(drivers::read_trace(command.file, options)),
                        settings, request);
}

}  // namespace

void add_replay_command(Command program, const std::string& command_line) {
    Command app = program.command("replay", "replay a gaze trace or a recorded session");
    const auto command = std::make_shared<ReplayCommand>();
    app.option("file", command->file, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("--format", command->format, trace_formats_text());
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
