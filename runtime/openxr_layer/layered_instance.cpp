#include "runtime/openxr_layer/layered_instance.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "runtime/openxr_layer/layer_log.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

std::string_view text_of(GazePermission::Verdict verdict) {
    switch (verdict) {
        case GazePermission::Verdict::Allowed:
            return "allowed";
        case GazePermission::Verdict::Denied:
            return "denied";
        case GazePermission::Verdict::FoveationOnly:
            return "foveation only";
        case GazePermission::Verdict::Asked:
            return "asks";
    }
    return "";
}

/// In the log, and in the session's recording.
void tell_reading(LayeredSession& session, std::string_view kind, const std::string& text) {
    note(LogLevel::Info, text);
    if (session.tap != nullptr) {
        session.tap->event(kind, text);
    }
}

}  // namespace

bool LayeredInstance::permits_gaze() { return verdict() == GazePermission::Verdict::Allowed; }

bool LayeredInstance::permits_foveation() {
    const auto given = verdict();
    return given == GazePermission::Verdict::Allowed ||
           given == GazePermission::Verdict::FoveationOnly;
}

std::optional<GazePermission::Verdict> LayeredInstance::verdict() {
    if (!permission) {
        return std::nullopt;
    }
    const GazePermission::Verdict verdict = permission->verdict();
    const std::string_view text = text_of(verdict);
    if (sighting.permission != text) {
        sighting.permission = text;
        keep(sighting);
        if (verdict == GazePermission::Verdict::Allowed) {
            note(LogLevel::Info, fmt::format("{} may have gaze", sighting.executable));
        } else if (verdict == GazePermission::Verdict::FoveationOnly) {
            note(LogLevel::Info,
                 fmt::format("{} may have foveation, and no gaze", sighting.executable));
        } else {
            note(
                LogLevel::Warning,
                fmt::format("{0} gets no gaze ({1}): gazeloop layer allow {0}", sighting.executable,
                            verdict == GazePermission::Verdict::Asked ? "it asks for permission"
                                                                      : "it is denied"));
        }
    }
    return verdict;
}

void LayeredInstance::note_foveation_read(LayeredSession& session) {
    if (session.foveation_read.note(time::monotonic_ns())) {
        tell_reading(session, "foveation-read",
                     fmt::format("{} ({}) follows where it is looked, by {}", application,
                                 sighting.executable, configuration.values.layer.gaze));
    }
}

void LayeredInstance::note_gaze_read(LayeredSession& session, std::int64_t now_ns) {
    if (!session.gaze_read.note(now_ns)) {
        return;
    }
    if (sighting.read_gaze_utc.empty()) {
        sighting.read_gaze_utc = utc_now();
        keep(sighting);
    }
    tell_reading(session, "gaze-read",
                 fmt::format("{} ({}) reads gaze of {}", application, sighting.executable,
                             configuration.values.layer.gaze));
}

void LayeredInstance::end_session(XrSession session) {
    const auto found = sessions.find(session);
    if (found == sessions.end()) {
        return;
    }
    if (const std::uint64_t reads = found->second.gaze_read.times(); reads > 0) {
        note(LogLevel::Info, fmt::format("{} ({}) has read gaze {} times in the session that ends",
                                         application, sighting.executable, reads));
    }
    sessions.erase(found);
}

void LayeredInstance::end_sessions() {
    while (!sessions.empty()) {
        end_session(sessions.begin()->first);
    }
}

void LayeredInstance::end_without_the_application() {
    if (sighting.pid != ::getpid()) {
        return;  // a fork: it has none of the threads, and the recording is not its own
    }
    // The program may end in a callback of the runtime's, below a call that holds the lock.
    constexpr int kLooks = 100;
    constexpr std::chrono::milliseconds kLook{1};
    std::unique_lock lock(mutex, std::try_to_lock);
    for (int look = 0; !lock && look < kLooks; ++look) {
        std::this_thread::sleep_for(kLook);
        lock.try_lock();
    }
    if (lock) {
        end_sessions();
        feed.reset();
        permission.reset();
    }
}

}  // namespace gazeloop::openxr_layer
