#pragma once

#include <string>
#include <string_view>

#include "runtime/display/display_profile.h"
#include "runtime/error.h"
#include "runtime/settings/settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::trade {

/// By how much a fovea must be wider because of a tracker's errors.
struct TrackerWidening {
    double deg = 0.0;
    std::string terms;  ///< "bias 1.10, noise .27, pursuit .76"
};

/// For the tracker in force (sim.*: the bias that 95 % of fixations stay under, and noise), looking
/// `off_axis_deg` away from straight ahead. The eye follows something at sim.pursuit_deg_per_s for
/// the age of its gaze when the display shows it. That age is the tracker's delay and jitter, half
/// a sample's period and one of the display's. The head's pose is known. Errors (Usage): nobody has
/// stated the tracker's bias or noise. Preconditions: `settings` hold the rows of `simulation`;
/// profiles::simulate_tracker_in_force(), which gave `tracker`.
Expected<TrackerWidening> tracker_widening(std::string_view tracker,
                                           const sim::GazeSimulation& simulation,
                                           const settings::Settings& settings,
                                           const display::DisplayProfile& display,
                                           double off_axis_deg);

}  // namespace gazeloop::trade
