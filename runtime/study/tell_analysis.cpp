#include "runtime/study/tell_analysis.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/study/analysis_page.h"
#include "runtime/study/analysis_report.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/study_files.h"

namespace gazeloop::study {

void tell_analysis(const AnalysisRequest& request) {
    const Plan plan = value_or_throw(read_plan(request.plan, nullptr));
    const std::array<report::NamedFile, 4> outputs{{{"--json", request.json},
                                                    {"--csv", request.csv},
                                                    {"--r-csv", request.r_csv},
                                                    {"--html", request.html}}};
    std::vector<report::NamedFile> inputs{{"the plan", request.plan}};
    const std::vector<std::filesystem::path> files(request.files.begin(), request.files.end());
    for (const std::filesystem::path& file : files) {
        inputs.emplace_back("the answers", file);
    }
    value_or_throw(report::check_outputs(outputs, inputs));
    const std::vector<Response> responses = value_or_throw(gather(plan, files));
    const StudyResult result = analyse(plan, responses, {.fit_subjects = true});
    const auto write = [](const std::string& file, const auto& text) {
        if (!file.empty()) {
            value_or_throw(report::write_text(file, text()));
        }
    };
    if (request.json != "-" && request.csv != "-" && request.r_csv != "-" && request.html != "-") {
        value_or_throw(report::write_text("-", analysis_text(result)));
    }
    // What has lines of single persons is theirs.
    const auto write_theirs = [](const std::string& file, const auto& text) {
        if (!file.empty()) {
            value_or_throw(report::write_text(file, text(), files::kOwnerOnly));
        }
    };
    write_theirs(request.json, [&] { return report::json_text(analysis_json(result)); });
    write(request.csv, [&] { return cells_csv(result); });
    write_theirs(request.r_csv, [&] { return decisions_csv(result, responses); });
    write(request.html, [&] { return analysis_page(result); });
}

}  // namespace gazeloop::study
