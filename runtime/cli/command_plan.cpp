#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/trade/plan.h"

namespace gazeloop::cli {
namespace {

struct PlanCommand {
    RunOptions options;
    trade::PlanRequest request;
    std::string eye = "left";
};

ExitCode plan(const PlanCommand& command) {
    run::ProgramSettings settings;
    const run::ProgramValues& values = settings.values();
    value_or_throw(command.options.apply_to(settings, true));
    if (command.request.widening == trade::kByTracker) {
        value_or_throw(profiles::simulate_tracker_in_force(values.profile, settings));
    }
    if (command.options.prints(settings)) {
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    trade::PlanRequest request = command.request;
    request.eye = command.eye == "left" ? gaze::Eye::Left : gaze::Eye::Right;
    request.quiet = command.options.log.quiet;
    trade::plan(request,
                {.display = value_or_throw(profiles::display_in_force(values.profile, settings)),
                 .tracker = values.profile.tracker,
                 .methods = values.methods,
                 .simulation = values.sim,
                 .settings = settings});
    return ExitCode::Ok;
}

}  // namespace

void add_plan_command(Command program) {
    Command app = program.command("plan", "what methods sample, and what eyes need, on a display");
    const auto command = std::make_shared<PlanCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file"},
        {"--tracker", "profile.tracker", "tracker profile, by name or .toml file"},
        {"--sigma", "kfr.sigma", "picture width over LP-buffer width, .5 to 32"},
        {"--alpha", "kfr.alpha", "kernel K(x) = x^alpha, .25 to 16"},
        {"--mar", "acuity.mar", "slope of the acuity line, e.g. .022"},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("--method", command->request.method,
               "full, kfr, acuity, layers, rings, sparse, quad, interleaved, kfr3d, fixed or all");
    app.option("--model", command->request.model,
               "guenter, geisler-perry, stelacsf, ashraf2025 or all");
    app.option("--gaze", command->request.gaze, "direction of gaze, degrees to the right and up")
        .type("AZ,EL");
    app.option("--eye", command->eye, "left or right").one_of({"left", "right"});
    app.option("--widen", command->request.widening,
               "by how much the gaze may be off, degrees, or as much as the tracker's figures "
               "(sim.*) say: what eyes then need")
        .type("DEG|tracker");
    app.option("--json", command->request.json, "write the plan as JSON; without a file, to stdout")
        .file_or_stdout();
    app.option("--png", command->request.chart,
               "draw densities over eccentricity, all methods; .png or .svg")
        .type("FILE");
    app.option("--figures", command->request.figures,
               "instead: what layers save by field of view, as CSV and charts")
        .type("DIR");
    app.does([=] {
        command->options.log.apply();
        return plan(*command);
    });
}

}  // namespace gazeloop::cli
