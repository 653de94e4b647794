#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <memory>
#include <thread>

#include "drivers/hid/hid_source.h"
#include "drivers/psvr2/psvr2_source.h"
#include "drivers/steam_frame/steam_frame_source.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/doctor/checks.h"
#include "runtime/doctor/device_report.h"
#include "runtime/doctor/openxr_gaze_report.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/report/output_file.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/run/interrupt.h"
#include "runtime/time/clock.h"

namespace gazeloop::cli {
namespace {

struct DevicesCommand {
    LogOptions log;
    std::vector<std::string> config_files;
    std::vector<std::string> assignments;
    std::string json;
    bool watch = false;
    double seconds = 2.0;
};

std::string eye_text(const gaze::EyeRay& ray) {
    if (!ray.valid) {
        return "      -       -  ";
    }
    return fmt::format("{:+7.2f} {:+7.2f}  ",
                       glm::degrees(std::atan2(ray.direction.x, -ray.direction.z)),
                       glm::degrees(std::asin(std::clamp(ray.direction.y, -1.0, 1.0))));
}

std::string watched_text(const gaze::GazeSample& last, std::size_t samples) {
    const std::string age =
        last.sampled.known()
            ? fmt::format("{:.1f} +/- {:.1f} ms at its arrival",
                          static_cast<double>(last.arrived.ns - last.sampled.ns) * 1e-6,
                          static_cast<double>(last.uncertainty_ns.value_or(0)) * 1e-6)
            : std::string("unknown");
    return fmt::format("{}{}{:4}  {}", eye_text(last.eyes[0]), eye_text(last.eyes[1]), samples,
                       age);
}

/// Live gaze, ten times a second: in one line of a terminal, else a line each. Silence is told,
/// each second of it where lines stay.
ExitCode watch(const std::vector<drivers::GazeSource*>& sources, const DevicesCommand& command) {
    constexpr std::int64_t kEvery_ns = 100'000'000;
    constexpr std::int64_t kSilent = 2;  // ticks; a slow tracker may miss one
    constexpr std::int64_t kSecond = 10;
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    std::vector<gaze::GazeSample> samples;
    bool any = false;
    std::int64_t last_heard = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    fmt::print("degrees right, up: left eye, right eye; samples; age\n");
    for (std::int64_t i = 1; !run::interrupted(); ++i) {
        const std::int64_t now_ns = begin_ns + i * kEvery_ns;
        if (static_cast<double>(now_ns - begin_ns) * 1e-9 > command.seconds) {
            break;
        }
        time::sleep_until_ns(now_ns);
        samples.clear();
        for (drivers::GazeSource* const source : sources) {
            source->poll(now_ns, samples);
            for (const drivers::SourceEvent& event : source->take_events()) {
                fmt::print("{}{}\n", terminal ? "\r\x1b[K" : "", event.text);
            }
        }
        const std::int64_t silent = samples.empty() ? i - last_heard : 0;
        std::string line;
        if (!samples.empty()) {
            last_heard = i;
            const gaze::GazeSample& last = samples.back();
            any = any || last.eyes[0].valid || last.eyes[1].valid;
            line = watched_text(last, samples.size());
        } else if (terminal ? silent >= kSilent : silent % kSecond == 0) {
            line = fmt::format("{}{}   0  nothing for {} s", eye_text({}), eye_text({}),
                               silent / kSecond);
        }
        if (!line.empty()) {
            fmt::print("{}{}{}", terminal ? "\r\x1b[K" : "", line, terminal ? "" : "\n");
        }
        std::fflush(stdout);
    }
    fmt::print("{}", terminal ? "\n" : "");
    return any ? ExitCode::Ok : ExitCode::NoDevice;
}

doctor::Findings listen_to_openxr(const run::ProgramSettings& settings, double seconds) {
    constexpr std::chrono::seconds kPatience{20};
    const auto listening = std::chrono::milliseconds(std::llround(seconds * 1e3));
    return doctor::check_eye_gaze(
        {.display = value_or_throw(profiles::display_in_force(settings.values().profile, settings)),
         .is_target = false},
        seconds, {.patience = kPatience + listening, .stop = [] { return run::interrupted(); }});
}

ExitCode devices(const DevicesCommand& command) {
    run::ProgramSettings settings;
    RunOptions configured;
    configured.config_files = command.config_files;
    configured.assignments = command.assignments;
    value_or_throw(configured.apply_to(settings, true));
    const auto profile_in_force = [&settings] {
        return value_or_throw(profiles::tracker_in_force(settings.values().profile, settings));
    };
    const drivers::hid::HidOptions hid = run::hid_options(profile_in_force(), settings.values());
    // Each has a profile of its own, unless one was chosen.
    const bool chosen = !settings.is_built_in("profile.tracker");
    const auto profile_of = [&](std::string_view source) {
        return chosen ? profile_in_force()
                      : value_or_throw(profiles::load_tracker(run::certain_tracker(source)));
    };
    const drivers::psvr2::Psvr2Options psvr2 = run::psvr2_options(profile_of("psvr2"));
    const drivers::steam_frame::SteamFrameOptions steam_frame =
        run::steam_frame_options(profile_of("steam-frame"), settings.values());
    if (command.watch) {
        drivers::hid::HidSource hid_source(hid);
        drivers::psvr2::Psvr2Source psvr2_source(psvr2);
        drivers::steam_frame::SteamFrameSource steam_frame_source(steam_frame);
        return watch({&hid_source, &psvr2_source, &steam_frame_source}, command);
    }
    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
    }
    const doctor::Findings openxr = listen_to_openxr(settings, command.seconds);
    const std::chrono::milliseconds listen(std::llround(command.seconds * 1e3));
    const auto stop = [] { return run::interrupted(); };
    std::vector<drivers::TrackerProbe> probes =
        drivers::hid::probe_trackers(drivers::hid::find_trackers(), hid, listen, stop);
    std::ranges::move(drivers::psvr2::probe_headsets(psvr2, listen, stop),
                      std::back_inserter(probes));
    std::ranges::move(drivers::steam_frame::probe_services(steam_frame, listen, stop),
                      std::back_inserter(probes));
    if (run::interrupted()) {
        fmt::print(stderr, "interrupted before every tracker was listened to\n");
        return ExitCode::Interrupted;
    }
    if (!command.json.empty()) {
        value_or_throw(report::write_text(command.json, doctor::devices_json(probes, openxr)));
    }
    if (command.json != "-") {
        fmt::print("{}{}", doctor::devices_text(probes), doctor::openxr_gaze_text(openxr));
    }
    return doctor::any_gaze(probes) || doctor::any_gaze(openxr) ? ExitCode::Ok : ExitCode::NoDevice;
}

}  // namespace

void add_devices_command(Command program) {
    Command app = program.command(
        "devices", "list eye trackers, listen to each, and say why one does not track");
    const auto command = std::make_shared<DevicesCommand>();
    command->log.add_to(app);
    app.option("--config", command->config_files, "TOML file with settings; may be repeated")
        .type("FILE");
    app.option("--set", command->assignments, "a setting; may be repeated").type("KEY=VALUE");
    const Option seconds =
        app.option("--seconds", command->seconds,
                   "how long to listen to each (2), or to watch (until interrupted)")
            .type("S")
            .number_between(0.1, 1e9);
    const Option json =
        app.option("--json", command->json, "write it as JSON; without a file, to stdout")
            .value_optional("-")
            .type("[FILE]");
    app.flag("--watch", command->watch, "show live gaze").not_with(json);
    app.does([=] {
        command->log.apply();
        if (command->watch && !seconds.given()) {
            command->seconds = 1e9;
        }
        return devices(*command);
    });
}

}  // namespace gazeloop::cli
