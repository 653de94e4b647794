#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/settings/settings.h"

namespace gazeloop::gaze {

/// The settings gaze.*
struct GazeSettings {
    std::string after_hold = "return";
    double blink_hold_ms = 300.0;
    std::string calibration;         ///< a file, until it is read (runtime/calibration)
    std::string calibration_values;  ///< what it says
    std::string calibration_device;  ///< as --gaze names it; empty: not known
    double closed_below = 0.0;
    double field_deg = 180.0;
    double stale_ms = 100.0;
    double hold_ms = 300.0;
    double reopen_ms = 0.0;
    double return_ms = 150.0;
    double minimum_confidence = 0.6;
    double unplugged_hold_ms = 300.0;
    bool widen = false;
    std::string widen_by = "age";  ///< or "events"
    bool widen_suppressed = false;
    double widen_suppressed_margin_ms = 6.0;
    double widen_error_deg = 0.5;
    double widen_head_deg_per_s = 40.0;
    double widen_lost_deg_per_s = 30.0;
    double widen_most_deg = 20.0;
    double widen_noise_deg = 0.2;
    double widen_pursuit_deg_per_s = 10.0;
    double fixation_distance_m = 1.5;
    bool fixation_from_depth = true;  ///< of sources with one ray for both eyes
    bool events = false;
    std::string filter = "none";  ///< of kGazeFilterNames
    double one_euro_least_hz = OneEuroFilter::Parameters{}.least_cutoff_hz;
    double one_euro_hz_per_deg_per_s = OneEuroFilter::Parameters{}.cutoff_hz_per_deg_per_s;
    double filter_memory_ms = 1e3 * FixationFilter::Parameters{}.memory_s;
    bool prediction = false;
    double longest_prediction_ms = 60.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(GazeSettings& gaze);

[[nodiscard]] FoveaPolicy fovea_policy(const GazeSettings& gaze);

/// Whether they fit together. Errors (Usage): which two do not, where they were set, and what would
/// fit. `all` holds the rows of `gaze`.
[[nodiscard]] Expected<void> check(const GazeSettings& gaze, const settings::Settings& all);

}  // namespace gazeloop::gaze
