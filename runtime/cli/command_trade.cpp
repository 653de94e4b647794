#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/cli/trade_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/recordings/compared_gaze.h"
#include "runtime/run/interrupt.h"

namespace gazeloop::cli {
namespace {

struct TradeCommand {
    RunOptions options;
    TradeOptions trade;
};

ExitCode trade_of(const TradeCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    if (!command.options.settle(settings)) {
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    for (const RunOptions::Alias& alias : command.options.aliases) {
        const bool of_scene = std::string_view(alias.flag) == "--scene";
        if (!alias.text.empty() && of_scene && !command.trade.asked.scenes.empty()) {
            throw SetupError(ErrorKind::Usage, "--scenes excludes --scene: name all in --scenes");
        }
        if (!alias.text.empty() && !command.trade.asked.merge.empty()) {
            throw SetupError(ErrorKind::Usage,
                             fmt::format("--merge excludes {}: it measures nothing", alias.flag));
        }
    }
    trade::TradeRequest request = command.trade.request();
    for (const std::string& text : command.trade.gazes) {
        if (std::ranges::count(command.trade.gazes, text) > 1) {
            throw SetupError(ErrorKind::Usage, fmt::format("--gaze {} is there twice", text));
        }
        const auto gaze = value_or_throw(recordings::ComparedGaze::parse(text, request.eye));
        request.gazes.push_back(
            {text, [gaze](std::int64_t time_ns) { return gaze.direction_at(time_ns); }});
    }
    request.command_line = command_line;
    request.outputs.json = command.options.json;
    request.outputs.text = !command.options.log.quiet;
    const run::ProgramValues& values = settings.values();
    const run::CatchesInterrupts catches;
    const bool all = trade::trade_off(
        request,
        {.display = value_or_throw(profiles::display_in_force(values.profile, settings)),
         .render = values.render,
         .vulkan = values.vulkan,
         .methods = values.methods,
         .light_field = values.light_field},
        settings,
        {.progress = [](const std::string& said) { spdlog::info("{}", said); },
         .interrupted = run::interrupted,
         .judged = {},
         .timed = {}});
    return all ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_trade_command(Command program, const std::string& command_line) {
    Command app = program.command(
        "trade", "time and samples against quality: methods and their settings, side by side");
    const auto command = std::make_shared<TradeCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file"},
        {"--scene", "render.scene",
         "scene to render: raymarch, gallery, lightfield, or a .gltf, .glb or .lightfield file"},
        {"--spp", "render.spp", "samples per texel or pixel, 1 to 16"},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    command->trade.add_to(app);
    app.option("--json", options.json, "write the result as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.does([=] {
        command->options.log.apply();
        return trade_of(*command, command_line);
    });
}

}  // namespace gazeloop::cli
