#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/cli/study_commands.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/study_files.h"

namespace gazeloop::cli {
namespace {

void add_plan(Command study) {
    struct Options {
        std::string name;
        std::string file = "-";
    };
    const auto options = std::make_shared<Options>();
    Command app = study.command("plan", "write a published design, to be run or changed");
    std::vector<std::string> names;
    for (const study::Plan& plan : study::published_plans()) {
        names.push_back(plan.name);
    }
    app.option("name", options->name, "kfr-pilot, kfr-final, f3d-pair, f3d-ramp or f3d-slider")
        .required()
        .check([names](const std::string& text) {
            return study::published_plan(text) != nullptr
                       ? std::string()
                       : settings::unknown_name("design", text, names);
        });
    app.option("file", options->file, "where to (stdout)").type("PLAN.toml");
    app.does([=] {
        value_or_throw(
            study::write_published_plan(*study::published_plan(options->name), options->file));
        return ExitCode::Ok;
    });
}

void add_forget(Command study) {
    struct Options {
        unsigned subject = 0;
        std::vector<std::string> files;
    };
    const auto options = std::make_shared<Options>();
    Command app = study.command("forget", "remove one subject's answers from files");
    app.option("subject", options->subject, "its number")
        .required()
        .type("N")
        .number_between(1, 1e9);
    app.option("files", options->files, "recorded sittings, answers as CSV, or what --r-csv wrote")
        .required()
        .type("FILE...");
    app.does([=] {
        const std::vector<std::filesystem::path> files(options->files.begin(),
                                                       options->files.end());
        bool any = false;
        for (const std::string& line : value_or_throw(study::forget(options->subject, files))) {
            fmt::print("{}{}", line, line.empty() ? "" : "\n");
            any = any || !line.empty();
        }
        if (!any) {
            fmt::print("subject {} is in none of these files: nothing was removed\n",
                       options->subject);
        }
        return ExitCode::Ok;
    });
}

}  // namespace

void add_study_command(Command program, const std::string& command_line) {
    Command study = program.command("study", "the papers' user tests, with simulated people too");
    study.require_command();
    add_study_run(study, command_line);
    add_plan(study);
    add_study_analyse(study);
    add_study_power(study);
    add_study_simulate(study);
    add_study_published(study);
    add_forget(study);
}

}  // namespace gazeloop::cli
