#include "runtime/recordings/tell_gaze.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

#include "runtime/gaze/gaze_comparison.h"
#include "runtime/recordings/recorded_gaze.h"
#include "runtime/report/gaze_comparison_text.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::recordings {
namespace {

/// Two recordings of the same eyes.
void compare(const GazeQuestion& question) {
    const gaze::GazeTrace one = recorded_gaze(question.file, question.read);
    const gaze::GazeTrace other = recorded_gaze(question.other, question.read);
    const gaze::GazeComparison comparison =
        value_or_throw(gaze::compare_gaze(one.samples, other.samples));
    if (question.json != "-") {
        fmt::print("{}\n{}\n{}", one.file, other.file, report::gaze_comparison_text(comparison));
    }
    if (!question.json.empty()) {
        nlohmann::ordered_json json{{"files", {one.file, other.file}},
                                    {"comparison", report::gaze_comparison_json(comparison)}};
        value_or_throw(report::write_text(question.json, report::json_text(json)));
    }
}

}  // namespace

void tell_gaze(const GazeQuestion& question) {
    if (!question.json.empty()) {
        value_or_throw(report::check_output(question.json));
        const std::array<report::NamedFile, 1> outputs{{{"--json", question.json}}};
        const std::array<report::NamedFile, 2> inputs{
            {{"the recording", question.file}, {"the other recording", question.other}}};
        value_or_throw(report::check_apart(outputs, inputs));
    }
    if (!question.other.empty()) {
        compare(question);
        return;
    }
    std::string refusal;
    const gaze::GazeTrace trace = recorded_gaze_even_refused(question.file, question.read, refusal);
    if (question.json != "-") {
        fmt::print("{}", report::gaze_text(trace));
    }
    if (!question.json.empty()) {
        nlohmann::ordered_json json = report::gaze_json(trace);
        json["refused"] = nullptr;
        if (!refusal.empty()) {
            json["refused"] = refusal;
        }
        value_or_throw(report::write_text(question.json, report::json_text(json)));
    }
    if (!refusal.empty()) {
        throw SetupError(ErrorKind::BadInput, refusal);
    }
}

}  // namespace gazeloop::recordings
