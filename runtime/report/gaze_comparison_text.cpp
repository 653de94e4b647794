#include "runtime/report/gaze_comparison_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

std::string axis_text(const gaze::AxisAgreement& axis) {
    return fmt::format("gain {:.3f}, offset {:+.2f} deg, {:.2f} deg left, correlation {:.3f}",
                       axis.gain, axis.offset_deg, axis.residual_deg, axis.correlation);
}

Json axis_json(const gaze::AxisAgreement& axis) {
    return {{"gain", axis.gain},
            {"offset_deg", axis.offset_deg},
            {"residual_deg", axis.residual_deg},
            {"correlation", axis.correlation}};
}

}  // namespace

std::string lag_text(const gaze::GazeComparison& comparison) {
    const std::string interval =
        comparison.lag_interval_ms
            ? fmt::format("95 % {:+.1f} to {:+.1f}", (*comparison.lag_interval_ms)[0],
                          (*comparison.lag_interval_ms)[1])
            : std::string{"too short for an interval"};
    return fmt::format(
        "the second is {:+.1f} ms later ({}), each from its own first sample; velocities correlate "
        "by {:.3f}",
        comparison.lag_ms, interval, comparison.correlation);
}

std::string doubt_text() {
    return fmt::format(
        "velocities of the same eyes correlate by more than {:.1f}: these may be of other eyes, or "
        "of another time",
        gaze::GazeComparison::kLeastCorrelation);
}

std::string gaze_comparison_text(const gaze::GazeComparison& comparison) {
    return wrapped_row("lag", lag_text(comparison)) +
           wrapped_row("azimuth", axis_text(comparison.azimuth)) +
           wrapped_row("height", axis_text(comparison.elevation)) +
           wrapped_row("over", fmt::format("{:.1f} s with gaze in both, every {:.1f} ms",
                                           comparison.overlap_s, comparison.step_ms)) +
           (comparison.doubtful() ? wrapped_row("doubt", doubt_text()) : std::string{});
}

Json gaze_comparison_json(const gaze::GazeComparison& comparison) {
    Json json{{"lag_ms", comparison.lag_ms},
              {"lag_interval_ms", nullptr},
              {"correlation", comparison.correlation},
              {"doubtful", comparison.doubtful()},
              {"azimuth", axis_json(comparison.azimuth)},
              {"elevation", axis_json(comparison.elevation)},
              {"overlap_s", comparison.overlap_s},
              {"step_ms", comparison.step_ms}};
    if (comparison.lag_interval_ms) {
        json["lag_interval_ms"] = *comparison.lag_interval_ms;
    }
    return json;
}

}  // namespace gazeloop::report
