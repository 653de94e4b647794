#include "runtime/simulate/tracker.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "runtime/gaze/sample_rate.h"
#include "runtime/time/clock.h"
#include "sim/uhid_device.h"
#include "sim/virtual_tracker.h"

namespace gazeloop::simulate {

std::uint64_t play_as_tracker(const PlayedGaze& played, const Interrupted& interrupted) {
    const gaze::GazeTrace trace = played.samples();
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
    played.play(
        trace, begin_ns, interrupted,
        [&](std::int64_t due_ns) {
            const std::int64_t wait_ns = due_ns - time::monotonic_ns();
            device.answer_for(std::chrono::nanoseconds(std::max<std::int64_t>(wait_ns, 1)),
                              interrupted);
        },
        [&](const gaze::GazeSample& sample, std::int64_t taken_ns) {
            if ((modes & (sim::kVirtualGaze | sim::kVirtualEyes)) != 0) {
                value_or_throw(device.send(sim::virtual_tracker_report(
                    sample, static_cast<std::uint64_t>((taken_ns - begin_ns) / 1000), modes)));
                ++sent;
            }
        });
    return sent;
}

}  // namespace gazeloop::simulate
