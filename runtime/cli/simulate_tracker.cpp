#include "runtime/cli/simulate_tracker.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/read_trace.h"
#include "runtime/cli/run_options.h"
#include "runtime/gaze/sample_rate.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/trace_log.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"
#include "sim/uhid_device.h"
#include "sim/virtual_tracker.h"

namespace gazeloop::cli {
namespace {

/// Simulated gaze repeats after this.
constexpr double kLap_s = 60.0;

struct SimulateTrackerCommand {
    LogOptions log;
    std::string trace;
    std::string axes = "none";
    drivers::ReadOptions read;
    double seconds = 1e9;
    sim::GazeSimulation gaze;
};

gaze::GazeTrace gaze_of(const SimulateTrackerCommand& command) {
    if (command.trace.empty()) {
        return sim::generate_gaze(command.gaze, kLap_s);
    }
    drivers::ReadOptions options = command.read;
    options.axes = drivers::axes_correction_named(command.axes);
    gaze::GazeTrace trace = value_or_throw(drivers::read_trace(command.trace, options));
    run::log_trace(trace);
    return trace;
}

/// Plays the gaze again and again, each sample at its time, to whoever has started the tracker.
ExitCode simulate_tracker(const SimulateTrackerCommand& command) {
    const gaze::GazeTrace trace = gaze_of(command);
    const auto hz = static_cast<std::uint16_t>(
        std::clamp(gaze::sample_rate_hz(trace.samples) + 0.5, 0.0, 65535.0));
    std::uint8_t modes = 0;
    auto device = value_or_throw(sim::UhidDevice::create(
        {"gazeloop virtual eye tracker", sim::kVirtualVendor, sim::kVirtualProduct},
        sim::virtual_tracker_descriptor(),
        {.get_feature = [hz](std::uint8_t id) { return sim::virtual_tracker_feature(id, hz); },
         .set_feature =
             [&modes](std::span<const std::uint8_t> report) {
                 if (report.size() >= 2 && report[0] == sim::kVirtualControlId) {
                     modes = report[1];
                     spdlog::info("{}", modes != 0 ? "asked to start" : "asked to stop");
                 }
             }}));
    spdlog::info("plugged in: a virtual eye tracker, {} Hz; gazeloop run --gaze hid uses it", hz);

    std::uint64_t sent = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    std::int64_t lap_ns = begin_ns;
    const auto over = [&] {
        return run::interrupted() ||
               static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9 > command.seconds;
    };
    while (!over()) {
        for (const gaze::GazeSample& sample : trace.samples) {
            const std::int64_t wait_ns = lap_ns + sample.sampled.ns - time::monotonic_ns();
            device.answer_for(std::chrono::nanoseconds(std::max<std::int64_t>(wait_ns, 1)),
                              [] { return run::interrupted(); });
            if (over()) {
                break;
            }
            if ((modes & (sim::kVirtualGaze | sim::kVirtualEyes)) != 0) {
                const std::int64_t taken_ns = lap_ns + sample.sampled.ns - begin_ns;
                value_or_throw(device.send(sim::virtual_tracker_report(
                    sample, static_cast<std::uint64_t>(taken_ns / 1000), modes)));
                ++sent;
            }
        }
        constexpr std::int64_t kBetweenLaps_ns = 10'000'000;
        lap_ns += trace.samples.back().sampled.ns + kBetweenLaps_ns;
    }
    if (!command.log.quiet) {
        fmt::print("{} reports sent\n", sent);
    }
    return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
}

}  // namespace

void add_simulate_tracker_command(Command simulate) {
    Command app =
        simulate.command("tracker", "be a HID eye tracker (usage page 0x12), through /dev/uhid");
    const auto command = std::make_shared<SimulateTrackerCommand>();
    app.option("--trace", command->trace, "what it sees; without: simulated gaze").type("FILE");
    app.option("--axes", command->axes, "turn the trace's directions")
        .one_of({drivers::kAxesCorrectionNames.begin(), drivers::kAxesCorrectionNames.end()});
    app.flag("--accept-repairs", command->read.accept_repairs,
             "read a trace of which much was dropped or changed");
    app.option("--seconds", command->seconds, "end after S seconds (until interrupted)")
        .number_between(0.0, 1e9);
    app.option("--rate", command->gaze.tracker.rate_hz, "samples per second, Hz")
        .number_between(1.0, 1e4);
    app.option("--seed", command->gaze.seed, "the same seed gives the same gaze");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        return simulate_tracker(*command);
    });
}

}  // namespace gazeloop::cli
