#include "runtime/trade/tracker_widening.h"

#include <fmt/core.h>

#include "runtime/foveation/eye/fovea_widening.h"

namespace gazeloop::trade {

Expected<TrackerWidening> tracker_widening(std::string_view tracker,
                                           const sim::GazeSimulation& simulation,
                                           const settings::Settings& settings,
                                           const display::DisplayProfile& display,
                                           double off_axis_deg) {
    for (const char* key : {"sim.bias_deg", "sim.noise_deg"}) {
        if (settings.is_built_in(key)) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("--widen tracker: the tracker '{}' states no {}: state it with "
                                  "--set {}=..., name another --tracker, or give --widen degrees",
                                  tracker, key, key)});
        }
    }
    const sim::TrackerTerms& terms = simulation.tracker;
    const double median_deg =
        terms.bias_deg * (1.0 + terms.bias_growth_percent / 100.0 * off_axis_deg);
    const foveation::GazeUncertainty uncertainty{
        .bias95_deg = foveation::bias95_deg(median_deg),
        .sample_sd_deg =
            terms.noise_deg * (1.0 + terms.noise_growth_percent / 100.0 * off_axis_deg),
        .pursuit_deg_s = simulation.eye.pursuit_deg_per_s,
        .latency_s = (terms.delay_ms + terms.jitter_ms) * 1e-3 + 0.5 / terms.rate_hz +
                     1.0 / display.refresh_hz};
    const auto deg = foveation::widening_deg(uncertainty);
    if (!deg) {
        return std::unexpected(deg.error());
    }
    return TrackerWidening{
        .deg = *deg,
        .terms =
            fmt::format("{}: bias {:.2f}, noise {:.2f}, pursuit at {:g} deg/s over {:.0f} ms "
                        "{:.2f}",
                        tracker, uncertainty.bias95_deg, uncertainty.z * uncertainty.sample_sd_deg,
                        uncertainty.pursuit_deg_s, uncertainty.latency_s * 1e3,
                        uncertainty.pursuit_deg_s * uncertainty.latency_s)};
}

}  // namespace gazeloop::trade
