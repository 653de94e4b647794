#include "runtime/run/devices.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>

#include "drivers/hid/hid_source.h"
#include "drivers/psvr2/psvr2_source.h"
#include "drivers/steam_frame/steam_frame_source.h"
#include "runtime/doctor/checks.h"
#include "runtime/doctor/device_report.h"
#include "runtime/doctor/live_gaze.h"
#include "runtime/doctor/openxr_gaze_report.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/report/output_file.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/run/interrupt.h"

namespace gazeloop::run {
namespace {

doctor::Findings listen_to_openxr(const ProgramSettings& settings, double seconds) {
    constexpr std::chrono::seconds kPatience{20};
    const auto listening = std::chrono::milliseconds(std::llround(seconds * 1e3));
    return doctor::check_eye_gaze(
        {.display = value_or_throw(profiles::display_in_force(settings.values().profile, settings)),
         .is_target = false},
        seconds, {.patience = kPatience + listening, .stop = [] { return interrupted(); }});
}

}  // namespace

std::optional<ErrorKind> listen_to_devices(const DevicesRequest& wanted,
                                           const ProgramSettings& settings) {
    const auto profile_in_force = [&settings] {
        return value_or_throw(profiles::tracker_in_force(settings.values().profile, settings));
    };
    const drivers::hid::HidOptions hid = hid_options(profile_in_force(), settings.values());
    // Each has a profile of its own, unless one was chosen.
    const bool chosen = !settings.is_built_in("profile.tracker");
    const auto profile_of = [&](std::string_view source) {
        return chosen ? profile_in_force()
                      : value_or_throw(profiles::load_tracker(certain_tracker(source)));
    };
    const drivers::psvr2::Psvr2Options psvr2 = psvr2_options(profile_of("psvr2"));
    const drivers::steam_frame::SteamFrameOptions steam_frame =
        steam_frame_options(profile_of("steam-frame"), settings.values());
    if (wanted.watch) {
        drivers::hid::HidSource hid_source(hid);
        drivers::psvr2::Psvr2Source psvr2_source(psvr2);
        drivers::steam_frame::SteamFrameSource steam_frame_source(steam_frame);
        return doctor::watch_gaze({&hid_source, &psvr2_source, &steam_frame_source}, wanted.seconds,
                                  interrupted)
                   ? std::nullopt
                   : std::optional(ErrorKind::NoDevice);
    }
    const report::NamedFile output{"--json", wanted.json};
    value_or_throw(report::check_outputs(std::span{&output, 1}, report::files_of(settings)));
    const doctor::Findings openxr = listen_to_openxr(settings, wanted.seconds);
    const std::chrono::milliseconds listen(std::llround(wanted.seconds * 1e3));
    const auto stop = [] { return interrupted(); };
    std::vector<drivers::TrackerProbe> probes =
        drivers::hid::probe_trackers(drivers::hid::find_trackers(), hid, listen, stop);
    std::ranges::move(drivers::psvr2::probe_headsets(psvr2, listen, stop),
                      std::back_inserter(probes));
    std::ranges::move(drivers::steam_frame::probe_services(steam_frame, listen, stop),
                      std::back_inserter(probes));
    if (interrupted()) {
        fmt::print(stderr, "interrupted before every tracker was listened to\n");
        return ErrorKind::Interrupted;
    }
    if (!wanted.json.empty()) {
        value_or_throw(report::write_text(wanted.json, doctor::devices_json(probes, openxr)));
    }
    if (wanted.json != "-") {
        fmt::print("{}{}", doctor::devices_text(probes), doctor::openxr_gaze_text(openxr));
    }
    return doctor::any_gaze(probes) || doctor::any_gaze(openxr)
               ? std::nullopt
               : std::optional(ErrorKind::NoDevice);
}

}  // namespace gazeloop::run
