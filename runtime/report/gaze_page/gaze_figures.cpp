#include "runtime/report/gaze_page/gaze_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

#include "runtime/gaze/main_sequence.h"
#include "runtime/memory/long_vector.h"
#include "runtime/report/gaze_page/gaze_tables.h"
#include "runtime/report/gaze_page/histogram.h"

namespace gazeloop::report::page {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 2000;

/// Each of them where there is room, else evenly chosen ones.
Json thinned(const std::vector<std::pair<double, double>>& points) {
    const std::size_t each = (points.size() + kMostPoints - 1) / kMostPoints;
    Json chosen = Json::array();
    for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(each, 1)) {
        chosen.push_back({points[i].first, points[i].second});
    }
    return chosen;
}

std::string thinned_note(std::size_t points) {
    const std::size_t each = (points + kMostPoints - 1) / kMostPoints;
    return each > 1 ? fmt::format(" One of {} is drawn.", each) : std::string{};
}

Json series(const char* first, const char* first_name, const char* second,
            const char* second_name) {
    return Json::array({Json::array({first, first_name}), Json::array({second, second_name})});
}

DrawnFigure time_figure(const std::string& id, const std::string& title, const std::string& note,
                        Table table, std::size_t stream, const Json& series) {
    return {
        .figure = {.id = id, .title = title, .note = note, .table = std::move(table)},
        .drawn = {
            {"id", id}, {"kind", "time"}, {"stream", stream}, {"unit", "deg"}, {"series", series}}};
}

DrawnFigure bars_figure(const std::string& id, const std::string& title, const std::string& note,
                        const std::string& quantity, const std::string& what,
                        memory::LongVector<double> values, double finest) {
    const Histogram bars = histogram(std::move(values), finest);
    const std::string above =
        bars.above > 0
            ? fmt::format(" {} are beyond the right edge; the table counts them.", bars.above)
            : std::string{};
    return {.figure = {.id = id,
                       .title = title,
                       .note = note + above,
                       .table = histogram_table(bars, quantity, what),
                       .moves = false},
            .drawn = {{"id", id},
                      {"kind", "bars"},
                      {"empty", bars.known == 0},
                      {"x", quantity},
                      {"what", what},
                      {"first", bars.first},
                      {"width", bars.width},
                      {"counts", bars.counts},
                      {"known", bars.known}}};
}

DrawnFigure points_figure(const std::string& id, const std::string& title, const std::string& note,
                          Table table, const std::string& x, const std::string& y, Json sets,
                          bool empty) {
    return {.figure =
                {.id = id, .title = title, .note = note, .table = std::move(table), .moves = false},
            .drawn = {{"id", id},
                      {"kind", "points"},
                      {"empty", empty},
                      {"x", x},
                      {"y", y},
                      {"sets", std::move(sets)}}};
}

Json line_of(const char* name, double most, const auto& y_of) {
    constexpr int kSteps = 60;
    Json points = Json::array();
    for (int i = 1; i <= kSteps; ++i) {
        const double x = most * i / kSteps;
        points.push_back({x, y_of(x)});
    }
    return {{"name", name}, {"form", "line"}, {"points", std::move(points)}};
}

std::vector<DrawnFigure> main_sequence_figures(const GazeFindings& found,
                                               const std::string& ending) {
    std::vector<std::pair<double, double>> peaks;
    std::vector<std::pair<double, double>> durations;
    double most = 0.0;
    for (const gaze::RecordedEvent& event : found.events) {
        if (event.event == gaze::EyeEvent::Saccade && event.amplitude_deg > 0.0) {
            peaks.emplace_back(event.amplitude_deg, event.peak_deg_per_s);
            durations.emplace_back(event.amplitude_deg, event.duration_ms());
            most = std::max(most, event.amplitude_deg);
        }
    }
    const auto& fit = found.statistics.main_sequence;
    Json peak_sets =
        Json::array({{{"name", "saccades"}, {"form", "points"}, {"points", thinned(peaks)}}});
    Json duration_sets =
        Json::array({{{"name", "saccades"}, {"form", "points"}, {"points", thinned(durations)}}});
    if (fit) {
        peak_sets.push_back(line_of("this recording", most, [&](double a) {
            return -fit->saturation_deg_per_s * std::expm1(-a / fit->bend_deg);
        }));
        duration_sets.push_back(line_of("this recording", most, [&](double a) {
            return fit->intercept_ms + fit->ms_per_deg * a;
        }));
    }
    peak_sets.push_back(
        line_of("published", most, [](double a) { return gaze::main_sequence(a).peak_deg_per_s; }));
    duration_sets.push_back(line_of(
        "published", most, [](double a) { return gaze::main_sequence(a).duration_s * 1e3; }));
    const Table table = saccade_table(found.events);
    return {
        points_figure("peaks" + ending, "Peak velocity of saccades",
                      "Over their amplitude, with the curve that fits those of 2 degrees or "
                      "more and the published one. Coarse samples and filters lower a peak." +
                          thinned_note(peaks.size()),
                      table, "amplitude, deg", "peak, deg/s", std::move(peak_sets), peaks.empty()),
        points_figure("durations" + ending, "Duration of saccades",
                      "Over their amplitude. A duration is a whole number of samples." +
                          thinned_note(durations.size()),
                      table, "amplitude, deg", "duration, ms", std::move(duration_sets),
                      durations.empty())};
}

DrawnFigure place_figure(const GazeFindings& found, bool in_world, const std::string& ending) {
    std::vector<std::pair<double, double>> places;
    for (const gaze::RecordedEvent& event : found.events) {
        if (event.event == gaze::EyeEvent::Fixation && event.middle != glm::dvec3{0.0}) {
            const glm::dvec3& middle = event.middle;
            places.emplace_back(glm::degrees(std::atan2(middle.x, -middle.z)),
                                glm::degrees(std::atan2(middle.y, std::hypot(middle.x, middle.z))));
        }
    }
    const bool empty = places.empty();
    DrawnFigure figure = points_figure(
        "places" + ending, "Where fixations were",
        fmt::format("The mean direction of each, in the {}.{}", in_world ? "world" : "head",
                    thinned_note(places.size())),
        place_table(found.events), "azimuth, deg (right is positive)",
        "elevation, deg (up is positive)",
        Json::array({{{"name", "fixations"}, {"form", "points"}, {"points", thinned(places)}}}),
        empty);
    figure.drawn["centred"] = true;
    return figure;
}

/// Times between samples, ms.
memory::LongVector<double> intervals_ms(const gaze::RecordingView& trace) {
    memory::LongVector<double> intervals;
    std::optional<std::int64_t> before_ns;
    for (const gaze::GazeSample& sample : trace.samples) {
        if (!sample.sampled.known() || (before_ns && sample.sampled.ns <= *before_ns)) {
            continue;
        }
        if (before_ns) {
            intervals.push_back(static_cast<double>(sample.sampled.ns - *before_ns) * 1e-6);
        }
        before_ns = sample.sampled.ns;
    }
    return intervals;
}

/// Of the events of a kind, what is above 0.
memory::LongVector<double> of_events(const GazeFindings& found, gaze::EyeEvent kind,
                                     const auto& value_of) {
    memory::LongVector<double> values;
    for (const gaze::RecordedEvent& event : found.events) {
        if (event.event == kind && value_of(event) > 0.0) {
            values.push_back(value_of(event));
        }
    }
    return values;
}

}  // namespace

RecordingFigures recording_figures(const gaze::RecordingView& trace, const GazeFindings& found,
                                   const GazeBins& bins, std::size_t number, std::size_t stream) {
    constexpr double kFinest_ms = 0.01;
    constexpr double kFinest_deg = 0.01;
    const std::string ending = fmt::format("-{}", number);
    const bool in_world = std::ranges::any_of(
        trace.samples, [](const gaze::GazeSample& sample) { return sample.head.has_value(); });
    const std::string reduced = bins.bins.size() < trace.samples.size()
                                    ? " Least and greatest of each point's samples."
                                    : std::string{};
    RecordingFigures figures;
    figures.over_time = {
        time_figure("azimuth" + ending, "Azimuth", "In the head, right is positive." + reduced,
                    angle_table(bins, 0, 1, "left", "right"), stream,
                    series("left_azimuth", "left eye", "right_azimuth", "right eye")),
        time_figure("elevation" + ending, "Elevation", "In the head, up is positive." + reduced,
                    angle_table(bins, 2, 3, "left", "right"), stream,
                    series("left_elevation", "left eye", "right_elevation", "right eye")),
        time_figure("doing" + ending, "What the eyes did", "Share of each point's samples.",
                    event_share_table(bins), stream, Json::array())};
    figures.over_time.back().drawn["events"] = true;
    figures.over_time.back().drawn["unit"] = "%";
    figures.quality = {
        bars_figure("intervals" + ending, "Time between samples", "How evenly they come.",
                    "interval, ms", "intervals", intervals_ms(trace), kFinest_ms),
        bars_figure("losses" + ending, "How long the gaze was lost",
                    "From the last sample with gaze to the next one; blinks last "
                    "100 to 400 ms.",
                    "lost for, ms", "losses",
                    of_events(found, gaze::EyeEvent::Lost,
                              [](const gaze::RecordedEvent& event) {
                                  return static_cast<double>(event.unseen_ns) * 1e-6;
                              }),
                    1.0)};
    figures.events = main_sequence_figures(found, ending);
    figures.events.push_back(
        bars_figure("amplitudes" + ending, "Amplitude of saccades", "From begin to end.",
                    "amplitude, deg", "saccades",
                    of_events(found, gaze::EyeEvent::Saccade,
                              [](const gaze::RecordedEvent& event) { return event.amplitude_deg; }),
                    kFinest_deg));
    figures.events.push_back(
        bars_figure("fixations" + ending, "Duration of fixations", "Without pursuit.",
                    "duration, ms", "fixations",
                    of_events(found, gaze::EyeEvent::Fixation,
                              [](const gaze::RecordedEvent& event) { return event.duration_ms(); }),
                    1.0));
    figures.events.push_back(place_figure(found, in_world, ending));
    return figures;
}

std::vector<DrawnFigure> comparison_figures(const gaze::GazeComparison& comparison,
                                            const GazeBins& bins, std::size_t stream) {
    Json points = Json::array();
    for (std::size_t i = 0; i < comparison.correlation_at.size(); ++i) {
        if (!std::isnan(comparison.correlation_at[i])) {
            points.push_back({comparison.lag_at_ms(i), comparison.correlation_at[i]});
        }
    }
    DrawnFigure lag = points_figure(
        "lag", "Correlation at each lag",
        "Of the velocities, where the second recording is taken to be so much later.",
        lag_table(comparison), "lag, ms", "correlation",
        Json::array({{{"name", "correlation"}, {"form", "line"}, {"points", std::move(points)}}}),
        false);
    lag.drawn["centred"] = true;
    return {std::move(lag),
            time_figure("both-azimuths", "Azimuth of both",
                        "The second recording moved by the lag; right is positive.",
                        difference_table(bins, 0, 1), stream,
                        series("one_azimuth", "first", "other_azimuth", "second")),
            time_figure("both-elevations", "Elevation of both",
                        "The second recording moved by the lag; up is positive.",
                        difference_table(bins, 2, 3), stream,
                        series("one_elevation", "first", "other_elevation", "second"))};
}

}  // namespace gazeloop::report::page
