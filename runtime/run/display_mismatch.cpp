#include "runtime/run/display_mismatch.h"

#include <fmt/core.h>

#include <cmath>

#include "runtime/latency/gaze_age.h"

namespace gazeloop::run {

std::optional<std::string> display_mismatch(std::int64_t period_ns,
                                            const display::DisplayProfile& profile) {
    constexpr double kTolerated = 0.01;
    const auto announced = static_cast<double>(period_ns);
    const auto expected = static_cast<double>(profile.period_ns());
    if (period_ns <= 0 || std::abs(announced - expected) <= kTolerated * expected) {
        return std::nullopt;
    }
    return fmt::format(
        "the runtime's display has a period of {:.2f} ms, the profile '{}' {:.2f} ms: the "
        "runtime's is used{}",
        announced * 1e-6, profile.name, expected * 1e-6,
        latency::may_be_of_period(period_ns, profile.period_ns())
            ? ""
            : ", and when its rows light up and its pixels switch is unknown (--display names "
              "another profile)");
}

}  // namespace gazeloop::run
