#pragma once

#include <span>
#include <string>

#include "runtime/error.h"
#include "runtime/report/gaze_page/gaze_page.h"

namespace gazeloop::report {

/// Where what is found in recorded gaze goes. Empty: nowhere, "-": stdout.
struct GazeOutputs {
    std::string json;
    std::string html;
    std::string events;  ///< the events as CSV; of one recording

    /// Whether stdout is taken, so that nothing else may be written there.
    [[nodiscard]] bool take_stdout() const { return json == "-" || html == "-" || events == "-"; }
};

/// Before the work: whether they can be written, are apart from each other and from what is read.
/// Errors: BadInput, Usage.
[[nodiscard]] Expected<void> check_outputs(const GazeOutputs& outputs,
                                           std::span<const std::string> recordings);

/// Of one recording. Errors (BadInput): a file cannot be written.
[[nodiscard]] Expected<void> write_gaze(const page::PageRecording& recording,
                                        const GazeOutputs& outputs);
/// Of one that cannot be read even with repairs: its JSON, if it is asked for, names the file and
/// says why ("refused").
[[nodiscard]] Expected<void> write_refusal(const std::string& file, const std::string& refusal,
                                           const GazeOutputs& outputs);
/// Of two that were compared.
[[nodiscard]] Expected<void> write_comparison(std::span<const page::PageRecording> recordings,
                                              const gaze::GazeComparison& comparison,
                                              const GazeOutputs& outputs);

}  // namespace gazeloop::report
