#pragma once

#include "runtime/run/frame_run.h"
#include "runtime/study/replayed_study.h"
#include "runtime/study/study_run.h"

namespace gazeloop::run {

/// Sets what all of a study's pictures share. Errors (Usage): a method, a key or a value that there
/// is not; a factor that does nothing with the plan's method; settings too long to be recorded.
[[nodiscard]] Expected<void> take_plan(const study::Plan& plan, ProgramSettings& settings);

/// Has a run's frames drawn as a study chooses. All must outlive the run. Throws SetupError (Usage)
/// for a run that takes a snapshot.
void show_study(study::StudyRun& study, ProgramSettings& settings, FrameRunRequest& request);
/// Likewise as a recording of one has it.
void show_study(study::ReplayedStudy& study, ProgramSettings& settings, FrameRunRequest& request);

}  // namespace gazeloop::run
