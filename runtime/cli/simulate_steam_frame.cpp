#include "runtime/cli/simulate_steam_frame.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>

#include "drivers/steam_frame/eye_service.h"
#include "drivers/steam_frame/raw_clock.h"
#include "runtime/cli/played_gaze.h"
#include "runtime/run/interrupt.h"
#include "runtime/time/clock.h"
#include "sim/steam_frame_file.h"

namespace gazeloop::cli {
namespace {

struct SimulateSteamFrameCommand {
    PlayedGaze gaze;
    std::string file = drivers::steam_frame::kServiceFile;
    std::uint64_t version = 5;
    double delay_ms = 17.0;
};

/// Publishes the gaze again and again, each sample so long after it was taken.
ExitCode simulate_steam_frame(const SimulateSteamFrameCommand& command) {
    using drivers::steam_frame::ClockPair;
    const gaze::GazeTrace trace = command.gaze.samples();
    auto file = value_or_throw(
        sim::SteamFrameFile::create(command.file, static_cast<std::uint32_t>(command.version)));
    spdlog::info("publishing in {}; gazeloop run --gaze steam-frame{} reads it", command.file,
                 command.file == drivers::steam_frame::kServiceFile ? "" : ":" + command.file);
    const std::int64_t delay_ns = std::llround(command.delay_ms * 1e6);
    command.gaze.play(
        trace, time::monotonic_ns(),
        [delay_ns](std::int64_t due_ns) { time::sleep_until_ns(due_ns + delay_ns); },
        [&file](const gaze::GazeSample& sample, std::int64_t taken_ns) {
            const ClockPair pair = drivers::steam_frame::read_clocks();
            const std::int64_t raw_ns = pair.raw_ns + (taken_ns - pair.monotonic_ns);
            file.publish(sim::steam_frame_record(sim::steam_frame_gaze(sample, raw_ns)));
        });
    if (!command.gaze.log.quiet) {
        fmt::print("{} samples published\n", file.counter());
    }
    return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
}

}  // namespace

void add_simulate_steam_frame_command(Command simulate) {
    Command app = simulate.command(
        "steam-frame", "be a Steam Frame's eye service: write the file that it publishes gaze in");
    const auto command = std::make_shared<SimulateSteamFrameCommand>();
    command->gaze.gaze.tracker.rate_hz = 90.0;
    command->gaze.gaze.tracker.noise_deg = 0.28;  // so that it has variances to state
    app.option("file", command->file, "the file, which must not be there yet").type("FILE");
    app.option("--layout", command->version, "version of its layout: 4, 5, or an unknown one")
        .whole_number(UINT32_MAX);
    app.option("--delay", command->delay_ms, "from the eye to the file, ms")
        .number_between(0.0, 1000.0);
    command->gaze.add_to(app);
    app.does([=] {
        command->gaze.log.apply();
        return simulate_steam_frame(*command);
    });
}

}  // namespace gazeloop::cli
