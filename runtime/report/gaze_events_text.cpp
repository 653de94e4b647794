#include "runtime/report/gaze_events_text.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/gaze/main_sequence.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

std::string spread_text(const std::optional<gaze::Spread>& spread, int decimals,
                        std::string_view unit) {
    return spread ? fmt::format("{:.{}f} {} ({:.{}f} to {:.{}f})", spread->median, decimals, unit,
                                spread->p05, decimals, spread->p95, decimals)
                  : std::string("of unknown size");
}

std::string counted(const gaze::EventKindStatistics& kind) {
    return fmt::format("{}, {:.1f} a minute, {:.1f} % of the time", kind.count, kind.per_minute,
                       kind.percent);
}

std::string lasting(const gaze::EventKindStatistics& kind) {
    return kind.duration_ms ? ", each " + spread_text(kind.duration_ms, 0, "ms") : std::string{};
}

std::string sequence_text(const std::optional<gaze::MainSequenceFit>& fit) {
    if (!fit) {
        return fmt::format("unknown: fewer than {} saccades of 2 deg or more",
                           gaze::kFewestForMainSequence);
    }
    const std::string peak = fit->saturates
                                 ? fmt::format("{:.0f} (1 - exp(-A / {:.2f})) deg/s",
                                               fit->saturation_deg_per_s, fit->bend_deg)
                                 : fmt::format("{:.0f} A deg/s, and do not saturate",
                                               fit->saturation_deg_per_s / fit->bend_deg);
    return fmt::format(
        "{} saccades of A deg have peaks of {} (within {:.0f}), and last {:.2f} A + {:.1f} ms "
        "(within {:.1f}); their peaks are {:.2f} times the published ones",
        fit->saccades, peak, fit->peak_rmse_deg_per_s, fit->ms_per_deg, fit->intercept_ms,
        fit->duration_rmse_ms, fit->peak_over_published);
}

Json spread_json(const std::optional<gaze::Spread>& spread) {
    if (!spread) {
        return nullptr;
    }
    return {{"p05", spread->p05}, {"median", spread->median}, {"p95", spread->p95}};
}

Json kind_json(const gaze::EventKindStatistics& kind) {
    return {{"count", kind.count},
            {"per_minute", kind.per_minute},
            {"percent", kind.percent},
            {"duration_ms", spread_json(kind.duration_ms)}};
}

Json sequence_json(const std::optional<gaze::MainSequenceFit>& fit) {
    if (!fit) {
        return nullptr;
    }
    return {{"saccades", fit->saccades},
            {"saturates", fit->saturates},
            {"saturation_deg_per_s", fit->saturation_deg_per_s},
            {"bend_deg", fit->bend_deg},
            {"peak_rmse_deg_per_s", fit->peak_rmse_deg_per_s},
            {"duration_ms_per_deg", fit->ms_per_deg},
            {"duration_intercept_ms", fit->intercept_ms},
            {"duration_rmse_ms", fit->duration_rmse_ms},
            {"peak_over_published", fit->peak_over_published}};
}

/// "azimuth,elevation" in degrees; a comma alone: unknown.
std::string angles(const glm::dvec3& direction) {
    if (direction == glm::dvec3{0.0}) {
        return ",";
    }
    return fmt::format("{:.3f},{:.3f}", glm::degrees(std::atan2(direction.x, -direction.z)),
                       glm::degrees(std::atan2(direction.y, std::hypot(direction.x, direction.z))));
}

}  // namespace

std::array<std::pair<std::string_view, const gaze::EventKindStatistics*>, 6> kinds_of(
    const gaze::EventStatistics& statistics) {
    return {{{"fixations", &statistics.fixations},
             {"saccades", &statistics.saccades},
             {"oscillations", &statistics.oscillations},
             {"pursuits", &statistics.pursuits},
             {"blinks", &statistics.blinks},
             {"other_losses", &statistics.losses}}};
}

std::string events_text(const gaze::EventStatistics& statistics) {
    if (statistics.duration_s <= 0.0) {
        return wrapped_row("events", "unknown: no sample has a time");
    }
    std::string text = wrapped_row(
        "fixation", counted(statistics.fixations) + lasting(statistics.fixations) +
                        (statistics.fixation_deviation_deg
                             ? ", SD " + spread_text(statistics.fixation_deviation_deg, 2, "deg")
                             : std::string{}));
    text += wrapped_row(
        "saccade",
        counted(statistics.saccades) + lasting(statistics.saccades) +
            (statistics.saccade_amplitude_deg
                 ? ", " + spread_text(statistics.saccade_amplitude_deg, 1, "deg") + ", peaks of " +
                       spread_text(statistics.saccade_peak_deg_per_s, 0, "deg/s")
                 : std::string{}) +
            (statistics.instant_saccades > 0
                 ? fmt::format(", {} within one interval, of unknown size",
                               statistics.instant_saccades)
                 : std::string{}));
    text += wrapped_row("", sequence_text(statistics.main_sequence));
    text += wrapped_row("pursuit",
                        counted(statistics.pursuits) + lasting(statistics.pursuits) +
                            (statistics.pursuit_deg_per_s
                                 ? ", " + spread_text(statistics.pursuit_deg_per_s, 1, "deg/s")
                                 : std::string{}));
    return text + wrapped_row("blink", counted(statistics.blinks) + lasting(statistics.blinks)) +
           wrapped_row("other", counted(statistics.losses) +
                                    " (the eye unseen, or a movement that no eye makes)");
}

Json events_json(const gaze::EventStatistics& statistics) {
    Json json{{"duration_s", statistics.duration_s}};
    for (const auto& [name, kind] : kinds_of(statistics)) {
        json[std::string(name)] = kind_json(*kind);
    }
    json["fixations"]["deviation_deg"] = spread_json(statistics.fixation_deviation_deg);
    json["saccades"]["instant"] = statistics.instant_saccades;
    json["saccades"]["amplitude_deg"] = spread_json(statistics.saccade_amplitude_deg);
    json["saccades"]["peak_deg_per_s"] = spread_json(statistics.saccade_peak_deg_per_s);
    json["pursuits"]["deg_per_s"] = spread_json(statistics.pursuit_deg_per_s);
    json["main_sequence"] = sequence_json(statistics.main_sequence);
    return json;
}

std::string events_csv(std::span<const gaze::RecordedEvent> events, std::int64_t first_ns) {
    std::string text =
        "event,begin_s,end_s,duration_ms,samples,amplitude_deg,peak_deg_per_s,deviation_deg,"
        "from_azimuth_deg,from_elevation_deg,to_azimuth_deg,to_elevation_deg,"
        "middle_azimuth_deg,middle_elevation_deg,unseen_ms\n";
    for (const gaze::RecordedEvent& event : events) {
        const bool lost = event.event == gaze::EyeEvent::Lost;
        const std::string size = lost ? ",,"
                                      : fmt::format("{:.4f},{:.2f},{:.4f}", event.amplitude_deg,
                                                    event.peak_deg_per_s, event.deviation_deg);
        text += fmt::format(
            "{},{:.6f},{:.6f},{:.3f},{},{},{},{},{},{}\n", gaze::name(event.event),
            static_cast<double>(event.begin_ns - first_ns) * 1e-9,
            static_cast<double>(event.end_ns - first_ns) * 1e-9, event.duration_ms(), event.samples,
            size, angles(event.from), angles(event.to), angles(event.middle),
            lost ? fmt::format("{:.3f}", static_cast<double>(event.unseen_ns) * 1e-6)
                 : std::string{});
    }
    return text;
}

}  // namespace gazeloop::report
