#include <spdlog/spdlog.h>

#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/quality_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/interrupt.h"
#include "runtime/trade/trade_off.h"

namespace gazeloop::cli {
namespace {

struct TradeCommand {
    RunOptions options;
    QualityOptions quality;
    trade::TradeRequest request;
};

ExitCode trade_off(const TradeCommand& command) {
    run::ProgramSettings settings;
    if (!command.options.settle(settings)) {
        return ExitCode::Ok;
    }
    trade::TradeRequest request = command.request;
    request.eye = command.quality.which_eye();
    request.gaze = command.quality.gaze;
    request.metrics = command.quality.metric_choice();
    request.contrast = command.quality.contrast();
    request.quiet = command.options.log.quiet;
    const run::ProgramValues& values = settings.type("LIST").not_empty();
    const bool rendered = trade::trade_off(
        request,
        {.display = value_or_throw(profiles::display_in_force(values.profile, settings)),
         .render = values.render,
         .vulkan = values.vulkan,
         .methods = values.methods},
        settings,
        {.progress = [](const std::string& said) { spdlog::info("{}", said); },
         .interrupted = run::interrupted});
    return rendered ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_trade_command(Command program) {
    Command app = program.command(
        "trade", "time and samples against quality: methods and their settings, side by side");
    const auto command = std::make_shared<TradeCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file"},
        {"--scene", "render.scene", "scene to render: raymarch, gallery, or a .gltf or .glb file"},
        {"--spp", "render.spp", "samples per texel or pixel, 1 to 16"},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("--methods", command->request.methods, "which, with commas between (kfr,acuity)")
        .type("LIST")
        .not_empty();
    app.option("--sigma", command->request.sigmas, "values of kfr.sigma, with commas between")
        .type("LIST")
        .not_empty();
    app.option("--alpha", command->request.alphas, "values of kfr.alpha").type("LIST").not_empty();
    app.option("--mar", command->request.slopes, "values of acuity.mar").type("LIST").not_empty();
    app.option("--vary", command->request.varied,
               "values of any setting of a method; may be repeated: all combinations are rendered")
        .type("KEY=V1,V2,...");
    app.option("--frames", command->request.frames, "frames at the display's rate (4); 1: a still")
        .number_between(1, 100'000);
    app.option("--rounds", command->request.rounds,
               "how often each frame is timed, all points in turns (3)")
        .number_between(1, 1000);
    app.option("--reference-spp", command->request.reference_samples,
               "samples per pixel of the reference, 1 to 16 (16)")
        .number_between(1, 16);
    command->quality.add_to(app);
    app.option("--csv", command->request.csv, "write a line per point").type("FILE").not_empty();
    app.option("--json", command->request.json,
               "write the result as JSON; without a file, to stdout")
        .file_or_stdout();
    app.does([=] {
        command->options.log.apply();
        return trade_off(*command);
    });
}

}  // namespace gazeloop::cli
