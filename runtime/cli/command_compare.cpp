#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/quality_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/compare/compare_pictures.h"
#include "runtime/profiles/profiles_in_force.h"

namespace gazeloop::cli {
namespace {

struct CompareCommand {
    RunOptions options;
    QualityOptions quality;
    compare::CompareQuestion question;
};

ExitCode compare(const CompareCommand& command) {
    run::ProgramSettings settings;
    if (!command.options.settle(settings)) {
        return ExitCode::Ok;
    }
    compare::CompareQuestion question = command.question;
    question.display =
        value_or_throw(profiles::display_in_force(settings.values().profile, settings));
    question.eye = command.quality.which_eye();
    question.gaze = command.quality.gaze;
    question.metrics = command.quality.metric_choice();
    question.contrast = command.quality.contrast();
    question.line = {.slope = settings.values().methods.acuity.mar};
    question.reads = report::files_of(settings);
    question.quiet = command.options.log.quiet;
    return compare::compare_pictures(question) ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_compare_command(Command program) {
    Command app = program.command(
        "compare", "what a picture, or a sequence of them, lost against a reference, at its gaze");
    const auto command = std::make_shared<CompareCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file"},
        {"--mar", "acuity.mar", "slope of the acuity line that weighs PSNR and SSIM"},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("reference", command->question.reference,
               "a PNG, or a folder of numbered PNG frames")
        .required()
        .type("REFERENCE");
    app.option("test", command->question.test, "the same of what is to be judged")
        .required()
        .type("TEST");
    command->quality.add_to(app);
    app.option("--fps", command->question.frames_per_second,
               "frames per second of a sequence; the display's refresh rate without it")
        .number_between(0.1, 1e4);
    app.option("--limit", command->question.limits,
               "exit code 1 if this figure's mean is worse; may be repeated")
        .type("FIGURE=NUMBER");
    app.option("--heat-map", command->question.heat_map,
               "where the pictures differ, as PNG: contrast in thresholds, else FLIP; a folder for "
               "a sequence")
        .type("FILE|DIR");
    app.option("--json", command->question.json,
               "write the result as JSON; without a file, to stdout")
        .file_or_stdout();
    app.does([=] {
        command->options.log.apply();
        return compare(*command);
    });
}

}  // namespace gazeloop::cli
