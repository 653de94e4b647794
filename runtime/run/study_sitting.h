#pragma once

#include <optional>
#include <string>

#include "runtime/run/frame_run.h"
#include "runtime/study/people_question.h"

namespace gazeloop::run {

/// One subject before one study.
struct StudySitting {
    std::string plan;              ///< a file
    std::string folder = "study";  ///< where sittings are recorded
    unsigned subject = 0;
    /// Who answers in the subject's place; none: the subject, by keyboard.
    std::optional<study::PeopleQuestion> simulated{};
    bool quiet = false;
};

/// Shows the trials that are left, recorded as the subject's next sitting, and says on stderr how
/// it goes. `request` must not record. What went wrong in the run; none: nothing.
/// @throws SetupError: as frame_run(), take_plan() and people_of(); NoDevice where pictures were
/// over before they were drawn
std::optional<ErrorKind> run_sitting(const StudySitting& sitting, ProgramSettings& settings,
                                     FrameRunRequest& request);

}  // namespace gazeloop::run
