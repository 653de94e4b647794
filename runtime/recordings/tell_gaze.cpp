#include "runtime/recordings/tell_gaze.h"

#include <fmt/core.h>

#include <array>
#include <vector>

#include "runtime/gaze/gaze_comparison.h"
#include "runtime/recordings/recorded_gaze.h"
#include "runtime/recordings/recording_memory.h"
#include "runtime/report/gaze_comparison_text.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"

namespace gazeloop::recordings {
namespace {

/// Two recordings of the same eyes.
void compare(const GazeQuestion& question) {
    const gaze::GazeRecording one = recorded_gaze(question.file, question.read);
    const gaze::GazeRecording other = recorded_gaze(question.other, question.read);
    const gaze::GazeComparison comparison =
        value_or_throw(gaze::compare_gaze(*one.samples, *other.samples));
    if (!question.outputs.take_stdout()) {
        value_or_throw(
            report::write_text("-", fmt::format("{}\n{}\n{}", one.file, other.file,
                                                report::gaze_comparison_text(comparison))));
    }
    const std::array found{report::gaze_findings(one), report::gaze_findings(other)};
    const std::array<report::page::PageRecording, 2> recordings{
        {{one, found[0], {}}, {other, found[1], {}}}};
    value_or_throw(report::write_comparison(recordings, comparison, question.outputs));
}

}  // namespace

void tell_gaze(const GazeQuestion& question) {
    std::vector<std::string> files{question.file};
    if (!question.other.empty()) {
        files.push_back(question.other);
    }
    value_or_throw(report::check_outputs(question.outputs, files));
    const RecordingMemory memory;
    if (!question.other.empty()) {
        compare(question);
        memory.warn();
        return;
    }
    std::string refusal;
    const gaze::GazeRecording trace = [&] {
        try {
            return recorded_gaze_even_refused(question.file, question.read, refusal);
        } catch (const SetupError& error) {
            if (error.kind() == ErrorKind::BadInput) {
                value_or_throw(
                    report::write_refusal(question.file, error.what(), question.outputs));
            }
            throw;
        }
    }();
    memory.warn();
    const report::GazeFindings found = report::gaze_findings(trace);
    if (!question.outputs.take_stdout()) {
        value_or_throw(report::write_text("-", report::gaze_text(trace, found)));
    }
    value_or_throw(report::write_gaze({trace, found, refusal}, question.outputs));
    if (!refusal.empty()) {
        throw SetupError(ErrorKind::BadInput, refusal);
    }
}

}  // namespace gazeloop::recordings
