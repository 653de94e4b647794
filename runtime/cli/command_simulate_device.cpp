#include <fmt/core.h>

#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/played_gaze_options.h"
#include "runtime/run/interrupt.h"
#include "runtime/simulate/steam_frame.h"
#include "runtime/simulate/tracker.h"

namespace gazeloop::cli {
namespace {

struct SteamFrameCommand {
    PlayedGazeOptions gaze;
    simulate::SimulatedSteamFrame service;
};

ExitCode ended(const LogOptions& log, std::uint64_t count, const char* what) {
    if (!log.quiet) {
        fmt::print("{} {}\n", count, what);
    }
    return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
}

ExitCode simulate_steam_frame(const SteamFrameCommand& command) {
    const run::CatchesInterrupts catches;
    return ended(
        command.gaze.log,
        simulate::publish_as_steam_frame(command.gaze.played(), command.service, run::interrupted),
        "samples published");
}

ExitCode simulate_tracker(const PlayedGazeOptions& command) {
    const run::CatchesInterrupts catches;
    return ended(command.log, simulate::play_as_tracker(command.played(), run::interrupted),
                 "reports sent");
}

}  // namespace

void add_simulate_steam_frame_command(Command simulate) {
    Command app = simulate.command(
        "steam-frame", "be a Steam Frame's eye service: write the file that it publishes gaze in");
    const auto command = std::make_shared<SteamFrameCommand>();
    command->gaze.gaze.gaze.tracker.rate_hz = 90.0;
    command->gaze.gaze.gaze.tracker.noise_deg = 0.28;  // so that it has variances to state
    app.option("file", command->service.file, "the file, which must not be there yet").type("FILE");
    app.option("--layout", command->service.version,
               "version of its layout: 4, 5, or an unknown one")
        .whole_number(UINT32_MAX);
    app.option("--delay", command->service.delay_ms, "from the eye to the file, ms")
        .number_between(0.0, 1000.0);
    command->gaze.add_to(app);
    app.does([=] {
        command->gaze.log.apply();
        return simulate_steam_frame(*command);
    });
}

void add_simulate_tracker_command(Command simulate) {
    Command app =
        simulate.command("tracker", "be a HID eye tracker (usage page 0x12), through /dev/uhid");
    const auto command = std::make_shared<PlayedGazeOptions>();
    command->add_to(app);
    app.does([=] {
        command->log.apply();
        return simulate_tracker(*command);
    });
}

}  // namespace gazeloop::cli
