#include "runtime/report/lag_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "runtime/frame/event.h"

namespace gazeloop::report {

GazeOrigin origin_of(std::string_view description) {
    constexpr std::array<std::pair<std::string_view, GazeOrigin>, 7> kBegins{
        std::pair{"simulated tracker", GazeOrigin::Simulated},
        {"trace ", GazeOrigin::Trace},
        {"fixed gaze", GazeOrigin::Fixed},
        {"OpenXR eye gaze", GazeOrigin::Runtime},
        {"HID eye tracker", GazeOrigin::Tracker},
        {"PlayStation VR2", GazeOrigin::Tracker},
        {"Steam Frame", GazeOrigin::Tracker}};
    const auto* const known = std::ranges::find_if(
        kBegins, [description](const auto& begin) { return description.starts_with(begin.first); });
    return known != kBegins.end() ? known->second : GazeOrigin::Unknown;
}

namespace {

std::string_view value_of(std::span<const NamedValue> values, std::string_view name) {
    const auto found = std::ranges::find(values, name, &NamedValue::name);
    return found != values.end() ? std::string_view(found->value) : std::string_view();
}

}  // namespace

std::string_view LagFacts::setting(std::string_view name) const { return value_of(settings, name); }
std::string_view LagFacts::device_value(std::string_view name) const {
    return value_of(device, name);
}

std::optional<DearestStage> dearest_stage(const latency::SummaryReport& report) {
    const std::optional<double> age_ms = report.gaze_age_at_display.mean_ms;
    if (!age_ms || !(*age_ms > 0.0)) {
        return std::nullopt;
    }
    DearestStage dearest{.mean_ms = report.unaccounted.mean_ms.value_or(0.0)};
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        const double mean_ms = report.stages[stage].mean_ms.value_or(0.0);
        if (mean_ms > dearest.mean_ms) {
            dearest = {.stage = latency::Stage{stage}, .mean_ms = mean_ms};
        }
    }
    dearest.percent = 100.0 * dearest.mean_ms / *age_ms;
    return dearest;
}

std::string milliseconds_text(double ms) {
    return fmt::format("{:.{}f} ms", ms, std::abs(ms) < 0.95 ? 2 : 1);
}

void LagObserver::on_event(time::Stamp, std::string_view kind, std::string_view text) {
    if (kind == frame::kGazeSourceEvent.name) {
        // A replay's source is the recording, which tells whose gaze that was.
        const GazeOrigin told = origin_of(text);
        origin_ = told != GazeOrigin::Unknown ? told : origin_;
    } else if (kind == frame::kUnplacedGazeEvent.name) {
        unplaced_ = FixedText<240>(text);
    }
}

}  // namespace gazeloop::report
