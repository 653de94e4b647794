#include "runtime/cli/simulate_tracker.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "runtime/cli/played_gaze.h"
#include "runtime/gaze/sample_rate.h"
#include "runtime/run/interrupt.h"
#include "runtime/time/clock.h"
#include "sim/uhid_device.h"
#include "sim/virtual_tracker.h"

namespace gazeloop::cli {
namespace {

/// Plays the gaze again and again, each sample at its time, to whoever has started the tracker.
ExitCode simulate_tracker(const PlayedGaze& command) {
    const gaze::GazeTrace trace = command.samples();
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
    command.play(
        trace, begin_ns,
        [&device](std::int64_t due_ns) {
            const std::int64_t wait_ns = due_ns - time::monotonic_ns();
            device.answer_for(std::chrono::nanoseconds(std::max<std::int64_t>(wait_ns, 1)),
                              [] { return run::interrupted(); });
        },
        [&](const gaze::GazeSample& sample, std::int64_t taken_ns) {
            if ((modes & (sim::kVirtualGaze | sim::kVirtualEyes)) != 0) {
                value_or_throw(device.send(sim::virtual_tracker_report(
                    sample, static_cast<std::uint64_t>((taken_ns - begin_ns) / 1000), modes)));
                ++sent;
            }
        });
    if (!command.log.quiet) {
        fmt::print("{} reports sent\n", sent);
    }
    return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
}

}  // namespace

void add_simulate_tracker_command(Command simulate) {
    Command app =
        simulate.command("tracker", "be a HID eye tracker (usage page 0x12), through /dev/uhid");
    const auto command = std::make_shared<PlayedGaze>();
    command->add_to(app);
    app.does([=] {
        command->log.apply();
        return simulate_tracker(*command);
    });
}

}  // namespace gazeloop::cli
