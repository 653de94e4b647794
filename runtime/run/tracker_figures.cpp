#include "runtime/run/tracker_figures.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include "runtime/profiles/profiles.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::run {
namespace {

std::string_view value_of(std::span<const NamedValue> settings, std::string_view name) {
    const auto found = std::ranges::find(settings, name, &NamedValue::name);
    return found != settings.end() ? std::string_view(found->value) : std::string_view();
}

std::optional<double> number_of(std::span<const NamedValue> settings, std::string_view name) {
    const std::string_view text = value_of(settings, name);
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end && std::isfinite(value) ? std::optional(value)
                                                                       : std::nullopt;
}

std::optional<std::int64_t> to_ns(const std::optional<double>& ms) {
    return ms ? std::optional(time::ms_to_ns(*ms)) : std::nullopt;
}

}  // namespace

latency::TrackerFigures tracker_figures(std::span<const NamedValue> settings,
                                        report::GazeOrigin origin) {
    if (origin == report::GazeOrigin::Fixed) {
        return {.delay_ns = 0,
                .uncertainty_ns = 0,
                .jitter_ns = 0,
                .rate_hz = std::numeric_limits<double>::infinity()};
    }
    if (origin == report::GazeOrigin::Simulated) {
        return {.delay_ns = to_ns(number_of(settings, "sim.delay_ms")),
                .uncertainty_ns = 0,
                .jitter_ns = to_ns(number_of(settings, "sim.jitter_ms")),
                .rate_hz = number_of(settings, "sim.rate_hz")};
    }
    const auto profile = profiles::load_tracker(value_of(settings, "profile.tracker"));
    if (!profile) {
        return {};
    }
    const auto term = [&profile](std::string_view name) -> std::optional<double> {
        const auto found =
            std::ranges::find(profile->terms, name, &std::pair<std::string, double>::first);
        return found != profile->terms.end() ? std::optional(found->second) : std::nullopt;
    };
    return {.delay_ns = profile->delay_ns,
            .uncertainty_ns = profile->delay_uncertainty_ns,
            .jitter_ns = to_ns(term("jitter_ms")),
            .rate_hz = term("rate_hz")};
}

}  // namespace gazeloop::run
