#include <fmt/core.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/cli/study_commands.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/study/analysis_page.h"
#include "runtime/study/analysis_report.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/study_files.h"

namespace gazeloop::cli {
namespace {

struct AnalyseCommand {
    std::string plan;
    std::vector<std::string> files;
    std::string json;
    std::string csv;
    std::string r_csv;
    std::string html;
};

ExitCode analyse(const AnalyseCommand& command) {
    const study::Plan plan = value_or_throw(study::read_plan(command.plan));
    const std::array<report::NamedFile, 4> outputs{{{"--json", command.json},
                                                    {"--csv", command.csv},
                                                    {"--r-csv", command.r_csv},
                                                    {"--html", command.html}}};
    std::vector<report::NamedFile> inputs{{"the plan", command.plan}};
    const std::vector<std::filesystem::path> files(command.files.begin(), command.files.end());
    for (const std::filesystem::path& file : files) {
        inputs.emplace_back("the answers", file);
    }
    value_or_throw(report::check_apart(outputs, inputs));
    const std::vector<study::Response> responses = value_or_throw(study::gather(plan, files));
    const study::StudyResult result = study::analyse(plan, responses);
    const auto write = [](const std::string& file, const auto& text) {
        if (!file.empty()) {
            value_or_throw(report::write_text(file, text()));
        }
    };
    if (command.json != "-" && command.csv != "-" && command.r_csv != "-") {
        fmt::print("{}", study::analysis_text(result));
    }
    write(command.json, [&] { return report::json_text(study::analysis_json(result)); });
    write(command.csv, [&] { return study::cells_csv(result); });
    write(command.r_csv, [&] { return study::decisions_csv(result, responses); });
    write(command.html, [&] { return study::analysis_page(result); });
    return ExitCode::Ok;
}

}  // namespace

void add_study_analyse(Command study) {
    const auto command = std::make_shared<AnalyseCommand>();
    Command app = study.command("analyse", "what several subjects' answers say");
    app.option("plan", command->plan, "the study's plan").required().type("PLAN.toml");
    app.option("files", command->files, "answers, as CSV").required().type("FILE...");
    app.option("--json", command->json, "write all of it as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.option("--csv", command->csv, "write a line per cell").type("FILE").not_empty();
    app.option("--r-csv", command->r_csv, "write a line per decision, for R").type("FILE");
    app.option("--html", command->html, "write a page with the papers' figures").type("FILE");
    app.does([=] { return analyse(*command); });
}

}  // namespace gazeloop::cli
