#pragma once

#include <optional>
#include <string>

#include "runtime/calibration/target_schedule.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// What a run is to calibrate.
struct CalibrationRun {
    std::string gaze;  ///< the source, as --gaze has it
    calibration::TargetSchedule schedule;
    std::string user;                   ///< whose eyes they are; empty: who is logged in
    std::string out;                    ///< empty: calibrate::personal_file()
    std::optional<unsigned> bad_point;  ///< 1 or more; of a simulated person alone
    std::string json;                   ///< "-": stdout; empty: not asked for
    bool quiet = false;
};

/// Shows the points, fits, writes the calibration and says what came of it. `request` is the run
/// that shows them, `settings` its own. None: all went well; GateFailed: no eye could be
/// calibrated, and nothing was written. @throws SetupError as frame_run() and personal_file(), and
/// for outputs that cannot be written
std::optional<ErrorKind> calibration_run(const CalibrationRun& wanted, FrameRunRequest request,
                                         ProgramSettings& settings);

}  // namespace gazeloop::run
