#include <memory>

#include "runtime/cli/study_commands.h"
#include "runtime/study/tell_analysis.h"

namespace gazeloop::cli {

void add_study_analyse(Command parent) {
    const auto command = std::make_shared<study::AnalysisRequest>();
    Command app = parent.command("analyse", "what several subjects' answers say");
    app.option("plan", command->plan, "the study's plan").required().type("PLAN.toml");
    app.option("files", command->files, "recorded sittings, or answers as CSV")
        .required()
        .type("FILE...");
    app.option("--json", command->json, "write all of it as JSON; without a file, to stdout")
        .file_or_stdout();
    app.option("--csv", command->csv, "write a line per cell").type("FILE").not_empty();
    app.option("--r-csv", command->r_csv, "write a line per decision, for R").type("FILE");
    app.option("--html", command->html, "write a page with the papers' figures").type("FILE");
    app.does([=] {
        study::tell_analysis(*command);
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
