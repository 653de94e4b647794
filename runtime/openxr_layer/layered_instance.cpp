#include "runtime/openxr_layer/layered_instance.h"

#include <fmt/format.h>

#include "runtime/openxr_layer/layer_log.h"

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

}  // namespace

bool LayeredInstance::permits_gaze(std::int64_t now_ns) {
    return verdict(now_ns) == GazePermission::Verdict::Allowed;
}

bool LayeredInstance::permits_foveation(std::int64_t now_ns) {
    const auto given = verdict(now_ns);
    return given == GazePermission::Verdict::Allowed ||
           given == GazePermission::Verdict::FoveationOnly;
}

std::optional<GazePermission::Verdict> LayeredInstance::verdict(std::int64_t now_ns) {
    if (!permission) {
        return std::nullopt;
    }
    const GazePermission::Verdict verdict = permission->verdict(now_ns);
    const std::string_view text = text_of(verdict);
    if (sighting.permission != text) {
        sighting.permission = text;
        keep(sighting);
        if (verdict == GazePermission::Verdict::Allowed) {
            say(LogLevel::Info, fmt::format("{} may have gaze", sighting.executable));
        } else if (verdict == GazePermission::Verdict::FoveationOnly) {
            say(LogLevel::Info,
                fmt::format("{} may have foveation, and no gaze", sighting.executable));
        } else {
            say(LogLevel::Warning,
                fmt::format("{0} gets no gaze ({1}): gazeloop layer allow {0}", sighting.executable,
                            verdict == GazePermission::Verdict::Asked ? "it asks for permission"
                                                                      : "it is denied"));
        }
    }
    return verdict;
}

void LayeredInstance::note_foveation_read(LayeredSession& session) {
    if (session.foveation_was_read) {
        return;
    }
    session.foveation_was_read = true;
    const std::string text = fmt::format("{} ({}) follows where it is looked, by {}", application,
                                         sighting.executable, configuration.values.layer.gaze);
    say(LogLevel::Info, text);
    if (session.tap != nullptr) {
        session.tap->event("foveation-read", text);
    }
}

void LayeredInstance::note_gaze_read(LayeredSession& session) {
    if (session.gaze_was_read) {
        return;
    }
    session.gaze_was_read = true;
    if (sighting.read_gaze_utc.empty()) {
        sighting.read_gaze_utc = utc_now();
        keep(sighting);
    }
    const std::string text = fmt::format("{} ({}) reads gaze of {}", application,
                                         sighting.executable, configuration.values.layer.gaze);
    say(LogLevel::Info, text);
    if (session.tap != nullptr) {
        session.tap->event("gaze-read", text);
    }
}

}  // namespace gazeloop::openxr_layer
