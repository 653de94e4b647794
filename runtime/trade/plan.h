#pragma once

#include <string>

#include "runtime/display/display_profile.h"
#include "runtime/error.h"
#include "runtime/methods/method_settings.h"
#include "runtime/settings/settings.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::trade {

/// As PlanRequest::widening: as much as the tracker's figures say.
inline constexpr const char* kByTracker = "tracker";

/// Which plans are asked for, and where they go.
struct PlanRequest {
    std::string method = "all";  ///< a method's name, or "all"
    std::string model = "all";   ///< an acuity model's name, or "all"
    std::string gaze = "0,0";    ///< see drivers::parse_fixed_gaze
    gaze::Eye eye = gaze::Eye::Left;
    std::string widening = "0";  ///< degrees, or kByTracker
    std::string chart;           ///< densities by eccentricity, .png or .svg; empty: none
    std::string figures;         ///< a folder: write_layer_figures() instead; empty: none
    std::string json;            ///< "-": stdout; empty: not asked for
    bool quiet = false;          ///< no table on stdout
};

/// By what is planned. `settings` hold the rows of `methods` and `simulation`.
struct PlanSubject {
    display::DisplayProfile display;
    const std::string& tracker;
    const methods::MethodSettings& methods;
    const sim::GazeSimulation& simulation;
    const settings::Settings& settings;
};

/// Says what methods sample and what eyes need, and writes what was asked for. @throws SetupError:
/// Usage for names that there are not, and for what does not fit together; BadInput for a file
/// that cannot be written
void plan(const PlanRequest& request, const PlanSubject& subject);

}  // namespace gazeloop::trade
