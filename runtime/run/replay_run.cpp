#include "runtime/run/replay_run.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "drivers/session/session_source.h"
#include "drivers/trace/read_trace.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/recordings/trace_of_session.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/run/govern.h"
#include "runtime/run/replayable_frames.h"
#include "runtime/run/study_request.h"
#include "runtime/session/playback.h"
#include "runtime/session/study_rows.h"
#include "runtime/settings/recorded_values.h"

namespace gazeloop::run {
namespace {

std::optional<ErrorKind> play_gaze(const Replay& replay, gaze::GazeTrace trace,
                                   ProgramSettings& settings, FrameRunRequest& request) {
    const profiles::TrackerProfile tracker =
        value_or_throw(profiles::tracker_in_force(settings.values().profile, settings));
    // A session knows when its samples arrived; other traces get the profile's delay.
    const std::int64_t delay_ns = trace.format == recordings::kSessionFormat ? 0 : tracker.delay_ns;
    request.make_source = trace_player(std::move(trace), delay_ns, replay.speed);
    request.clock = replay.wall_clock ? RunClock::Wall : RunClock::Virtual;
    request.loop.end_with_source = true;
    const auto governed = govern(settings, request);
    return frame_run(request);
}

void play_to(frame::FrameObserver& observer, const session::OpenSession& session) {
    const std::array<frame::FrameObserver*, 1> observers{&observer};
    value_or_throw(session::play(session, observers));
}

}  // namespace

session::OpenSession open_for_replay(const std::string& file, ProgramSettings& settings) {
    auto session = value_or_throw(session::OpenSession::open(file));
    const session::SessionInfo& info = session.info();
    if (!info.closed_cleanly) {
        spdlog::warn("{}: the recording was not closed; what it holds is replayed{}{}", file,
                     info.missing_log.empty() ? "" : "; ", info.missing_log);
    }
    if (const auto taken = settings::take_recorded(info.header.config, file, settings); !taken) {
        throw SetupError(ErrorKind::BadInput, taken.error().message);
    }
    value_or_throw(settings.set("target.name", "headless", "replay of a session"));
    return session;
}

std::optional<ErrorKind> replay_session(const Replay& replay, const session::OpenSession& session,
                                        ProgramSettings& settings, FrameRunRequest& request) {
    if (replay.wall_clock) {
        return play_gaze(replay, gaze::in_memory(recordings::trace_of_session(session)), settings,
                         request);
    }
    if (replay.speed != 1.0) {
        throw SetupError(ErrorKind::Usage,
                         "--speed: a session's own time line is replayed as it was; use --clock "
                         "wall to play its gaze faster or slower");
    }
    ReplayableFrames found(replay.file);
    play_to(found, session);
    request.recording = {&session, found.frames(), found.first_views()};
    request.make_source = [&session, samples = found.samples_consumed()](std::int64_t) {
        return std::make_unique<drivers::SessionSource>(session, samples);
    };
    request.clock = RunClock::Recorded;
    const auto as_recorded = [&](settings::Concerns what) {
        return settings::are_as_recorded(session.info().header.config, what, settings);
    };
    const auto& device = session.info().header.device;
    const auto application = std::ranges::find(device, "application", &NamedValue::name);
    if (application != device.end()) {
        request.other_foveae =
            fmt::format("{} drew what the OpenXR API layer recorded", application->value);
    } else if (!as_recorded(settings::Concerns::Foveae)) {
        request.other_foveae = "gaze settings differ from the recorded ones";
    }
    request.same_rendering = as_recorded(settings::Concerns::Picture);
    std::unique_ptr<study::ReplayedStudy> study;
    if (const auto trials = value_or_throw(session::read_trials(session)); !trials.empty()) {
        study = value_or_throw(study::ReplayedStudy::create(trials));
        show_study(*study, settings, request);
    }
    const auto governed = govern(settings, request);
    return frame_run(request);
}

std::optional<ErrorKind> replay_trace(const Replay& replay, ProgramSettings& settings,
                                      FrameRunRequest& request) {
    drivers::ReadOptions options = drivers::read_options(settings.values().trace);
    options.format = replay.format;
    request.reads_trace = true;
    return play_gaze(replay, value_or_throw(drivers::read_trace(replay.file, options)), settings,
                     request);
}

}  // namespace gazeloop::run
