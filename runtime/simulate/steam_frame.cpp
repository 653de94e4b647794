#include "runtime/simulate/steam_frame.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "drivers/steam_frame/raw_clock.h"
#include "runtime/time/clock.h"
#include "sim/steam_frame_file.h"

namespace gazeloop::simulate {

std::uint64_t publish_as_steam_frame(const PlayedGaze& gaze, const SimulatedSteamFrame& service,
                                     const Interrupted& interrupted) {
    using drivers::steam_frame::ClockPair;
    if (service.version != 4 && service.version != 5) {
        spdlog::warn("layout {}: only 4 and 5 are known: whoever reads the file refuses it",
                     service.version);
    }
    const gaze::GazeTrace trace = gaze.samples();
    auto file = value_or_throw(
        sim::SteamFrameFile::create(service.file, static_cast<std::uint32_t>(service.version)));
    spdlog::info("publishing in {}; gazeloop run --gaze steam-frame{} reads it", service.file,
                 service.file == drivers::steam_frame::kServiceFile ? "" : ":" + service.file);
    const std::int64_t delay_ns = std::llround(service.delay_ms * 1e6);
    gaze.play(
        trace, time::monotonic_ns(), interrupted,
        [delay_ns](std::int64_t due_ns) { time::sleep_until_ns(due_ns + delay_ns); },
        [&file](const gaze::GazeSample& sample, std::int64_t taken_ns) {
            const ClockPair pair = drivers::steam_frame::read_clocks();
            const std::int64_t raw_ns = pair.raw_ns + (taken_ns - pair.monotonic_ns);
            value_or_throw(
                file.publish(sim::steam_frame_record(sim::steam_frame_gaze(sample, raw_ns))));
        });
    return file.counter();
}

}  // namespace gazeloop::simulate
