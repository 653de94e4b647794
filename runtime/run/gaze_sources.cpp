#include "runtime/run/gaze_sources.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "drivers/datagram/datagram_source.h"
#include "drivers/fixed/fixed_source.h"
#include "drivers/hid/hid_source.h"
#include "drivers/psvr2/psvr2_source.h"
#include "drivers/simulated/simulated_source.h"
#include "drivers/steam_frame/steam_frame_source.h"
#include "drivers/trace/read_trace.h"
#include "drivers/trace/trace_source.h"
#include "runtime/session/open_session.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::run {

namespace {

constexpr std::string_view kSteamFrame = "steam-frame";

std::string_view kind_of(std::string_view gaze) { return gaze.substr(0, gaze.find(':')); }

}  // namespace

std::string_view certain_tracker(std::string_view gaze) {
    return gaze == "psvr2" ? "psvr2" : kind_of(gaze) == kSteamFrame ? "steam_frame" : "";
}

bool is_device(std::string_view gaze) {
    return gaze == "openxr" || gaze == "psvr2" || kind_of(gaze) == "hid" ||
           kind_of(gaze) == "osc" || kind_of(gaze) == kSteamFrame;
}

drivers::hid::HidOptions hid_options(const profiles::TrackerProfile& tracker,
                                     const SourceValues& values) {
    return {.path = "",
            .delay = {tracker.delay_ns, tracker.delay_uncertainty_ns},
            .geometry = {values.hid.screen_width_m, values.hid.screen_height_m,
                         values.hid.viewing_distance_m, values.hid.eye_distance_m}};
}

drivers::psvr2::Psvr2Options psvr2_options(const profiles::TrackerProfile& tracker) {
    return {.delay = {tracker.delay_ns, tracker.delay_uncertainty_ns}};
}

drivers::steam_frame::SteamFrameOptions steam_frame_options(const profiles::TrackerProfile& tracker,
                                                            const SourceValues& values) {
    return drivers::steam_frame::options_of(
        values.steam_frame,
        {.least_ns = tracker.delay_ns, .uncertainty_ns = tracker.delay_uncertainty_ns});
}

Expected<void> default_tracker(std::string_view gaze, settings::Settings& settings) {
    const std::string_view tracker = certain_tracker(gaze);
    if (tracker.empty()) {
        return {};
    }
    const std::string origin = fmt::format("--gaze {}", kind_of(gaze));
    if (kind_of(gaze) == kSteamFrame) {
        // Public users saw it never below about .2 when closed, and .75 to .9 when open.
        if (auto set = settings.set_default("gaze.closed_below", "0.4", origin); !set) {
            return set;
        }
    }
    return settings.set_default("profile.tracker", tracker, origin);
}

Expected<void> default_widening(const profiles::TrackerProfile& tracker,
                                settings::Settings& settings) {
    for (const auto& [term, key] : {std::pair{"bias_deg", "gaze.widen_error_deg"},
                                    std::pair{"noise_deg", "gaze.widen_noise_deg"}}) {
        const auto found =
            std::ranges::find(tracker.terms, term, &std::pair<std::string, double>::first);
        if (found == tracker.terms.end()) {
            continue;
        }
        if (auto set = settings.set_default(key, fmt::format("{}", found->second),
                                            "tracker " + tracker.name);
            !set) {
            return set;
        }
    }
    return {};
}

Expected<MakeSource> gaze_source_named(std::string_view text,
                                       const profiles::TrackerProfile& tracker,
                                       const SourceValues& values) {
    const std::size_t colon = text.find(':');
    const std::string_view kind = kind_of(text);
    const std::string_view argument =
        colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
    if (kind == "trace" && !argument.empty()) {
        if (session::looks_like_session(argument)) {
            return std::unexpected(
                Error{ErrorKind::BadInput,
                      fmt::format("{0}: a recorded session, not a trace: gazeloop replay {0} "
                                  "(--clock wall plays it in real time)",
                                  argument)});
        }
        auto trace =
            drivers::read_trace(std::string(argument), drivers::read_options(values.trace));
        if (!trace) {
            return std::unexpected(std::move(trace.error()));
        }
        return trace_player(std::move(*trace), tracker.delay_ns, 1.0);
    }
    if (kind == "fixed" && !argument.empty()) {
        const auto gaze = drivers::parse_fixed_gaze(argument);
        if (!gaze) {
            return std::unexpected(gaze.error());
        }
        return
            [gaze = *gaze](std::int64_t) { return std::make_unique<drivers::FixedSource>(gaze); };
    }
    if (text == "sim") {
        return [simulation = values.sim](std::int64_t start_ns) {
            return std::make_unique<drivers::SimulatedSource>(simulation, start_ns);
        };
    }
    if (kind == "hid" && (colon == std::string_view::npos || !argument.empty())) {
        drivers::hid::HidOptions options = hid_options(tracker, values);
        options.path = argument;
        return [options = std::move(options)](std::int64_t) {
            return std::make_unique<drivers::hid::HidSource>(options);
        };
    }
    if (text == "psvr2") {
        return [options = psvr2_options(tracker)](std::int64_t) {
            return std::make_unique<drivers::psvr2::Psvr2Source>(options);
        };
    }
    if (kind == kSteamFrame && (colon == std::string_view::npos || !argument.empty())) {
        drivers::steam_frame::SteamFrameOptions options = steam_frame_options(tracker, values);
        if (!argument.empty()) {
            options.file = argument;
        }
        return [options = std::move(options)](std::int64_t) {
            return std::make_unique<drivers::steam_frame::SteamFrameSource>(options);
        };
    }
    if (kind == "osc" && !argument.empty()) {
        const auto endpoint = drivers::datagram::parse_endpoint(argument);
        if (!endpoint) {
            return std::unexpected(endpoint.error());
        }
        return [endpoint = *endpoint](std::int64_t) {
            return std::make_unique<drivers::datagram::DatagramSource>(endpoint);
        };
    }
    const std::vector<std::string> known{"hid",         "hid:/dev/hidrawN", "psvr2",
                                         "steam-frame", "osc:PORT",         "openxr",
                                         "trace:FILE",  "fixed:AZ,EL",      "sim"};
    return std::unexpected(
        Error{ErrorKind::Usage, "--gaze: " + settings::unknown_name("source", text, known)});
}

MakeSource trace_player(gaze::GazeTrace trace, std::int64_t delay_ns, double speed) {
    return [trace = std::move(trace), delay_ns, speed](std::int64_t start_ns) {
        return std::make_unique<drivers::TraceSource>(trace, start_ns, delay_ns, speed);
    };
}

}  // namespace gazeloop::run
