#include "runtime/report/gaze_page/gaze_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>
#include <optional>

#include "runtime/gaze/main_sequence.h"
#include "runtime/report/gaze_events_text.h"
#include "runtime/report/page/page_tables.h"

namespace gazeloop::report::page {
namespace {

constexpr std::size_t kParts = 24;  ///< of a recording, in the tables beside its plots

std::string number(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

std::string of_mean(const AngleRange& range) {
    return range.count > 0 ? number(range.sum_deg / static_cast<double>(range.count), 2) : "-";
}

void add_range(std::vector<std::string>& cells, const AngleRange& range) {
    const bool known = range.count > 0;
    cells.push_back(known ? number(range.least_deg, 2) : "-");
    cells.push_back(of_mean(range));
    cells.push_back(known ? number(range.greatest_deg, 2) : "-");
}

TableRow part_row(const GazeBin& part) {
    return {.label = time_text(part.begin_s), .cells = {fmt::format("{}", part.samples)}};
}

void add_spread(std::vector<std::string>& cells, const std::optional<gaze::Spread>& spread,
                int decimals) {
    for (const auto& value : {spread ? std::optional(spread->p05) : std::nullopt,
                              spread ? std::optional(spread->median) : std::nullopt,
                              spread ? std::optional(spread->p95) : std::nullopt}) {
        cells.push_back(value ? number(*value, decimals) : "-");
    }
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

Table angle_table(const GazeBins& bins, std::size_t first, std::size_t second,
                  const std::string& first_name, const std::string& second_name) {
    Table table{.heads = {{"from"}, {"samples"}}, .rows = {}};
    for (const std::string& name : {first_name, second_name}) {
        for (const char* const which : {"least", "mean", "greatest"}) {
            table.heads.push_back({fmt::format("{}, {} (deg)", name, which)});
        }
    }
    for (const GazeBin& part : in_parts(bins, kParts)) {
        TableRow& row = table.rows.emplace_back(part_row(part));
        add_range(row.cells, part.angles[first]);
        add_range(row.cells, part.angles[second]);
    }
    return table;
}

Table difference_table(const GazeBins& bins, std::size_t first, std::size_t second) {
    Table table{.heads = {{"from"},
                          {"samples"},
                          {"first, mean (deg)"},
                          {"second, mean (deg)"},
                          {"second less first (deg)"}},
                .rows = {}};
    for (const GazeBin& part : in_parts(bins, kParts)) {
        TableRow& row = table.rows.emplace_back(part_row(part));
        const AngleRange& a = part.angles[first];
        const AngleRange& b = part.angles[second];
        row.cells.push_back(of_mean(a));
        row.cells.push_back(of_mean(b));
        row.cells.push_back(a.count > 0 && b.count > 0
                                ? number(b.sum_deg / static_cast<double>(b.count) -
                                             a.sum_deg / static_cast<double>(a.count),
                                         2)
                                : "-");
    }
    return table;
}

Table event_share_table(const GazeBins& bins) {
    Table table{.heads = {{"from"}, {"samples"}}, .rows = {}};
    for (const std::string_view event : gaze::kEyeEventNames) {
        table.heads.push_back({fmt::format("{} (%)", event)});
    }
    for (const GazeBin& part : in_parts(bins, kParts)) {
        TableRow& row = table.rows.emplace_back(part_row(part));
        for (const std::uint64_t samples : part.by_event) {
            row.cells.push_back(number(
                100.0 * static_cast<double>(samples) / static_cast<double>(part.samples), 1));
        }
    }
    return table;
}

Table histogram_table(const Histogram& histogram, const std::string& quantity,
                      const std::string& what) {
    Table table{.heads = {{quantity}, {what}, {"%"}}, .rows = {}};
    const auto add = [&](const std::string& label, std::uint64_t count) {
        table.rows.push_back(
            {.label = label,
             .cells = {fmt::format("{}", count), number(100.0 * static_cast<double>(count) /
                                                            static_cast<double>(histogram.known),
                                                        1)}});
    };
    const auto edge = [&](std::size_t bin) {
        return histogram.first + static_cast<double>(bin) * histogram.width;
    };
    for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
        if (histogram.counts[bin] > 0) {
            add(fmt::format("{:.6g} to {:.6g}", edge(bin), edge(bin + 1)), histogram.counts[bin]);
        }
    }
    if (histogram.above > 0) {
        add(fmt::format("{:.6g} and more", edge(histogram.counts.size())), histogram.above);
    }
    return table;
}

Table precision_table(const GazeFindings& found) {
    Table table{.heads = {{"eye"},
                          {"windows"},
                          {"sample to sample, RMS (deg)"},
                          {"SD (deg)"},
                          {"BCEA, 68 % (deg2)"},
                          {"RMS / SD"}},
                .rows = {}};
    for (const gaze::Eye eye : gaze::kEyes) {
        const auto& precision = found.quality.precision[gaze::index(eye)];
        TableRow row{.label = std::string(gaze::kEyeNames[gaze::index(eye)])};
        if (precision) {
            row.cells = {fmt::format("{}", precision->windows),
                         number(precision->sample_to_sample_deg, 3),
                         number(precision->deviation_deg, 3), number(precision->bcea_deg2, 4),
                         number(precision->step_per_deviation, 2)};
        } else {
            row.cells = {"0", "-", "-", "-", "-"};
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table event_kind_table(const gaze::EventStatistics& statistics) {
    Table table{.heads = {{"event"},
                          {"count"},
                          {"a minute"},
                          {"% of the time"},
                          {"p5 (ms)"},
                          {"median (ms)"},
                          {"p95 (ms)"}},
                .rows = {}};
    for (const auto& [name, kind] : kinds_of(statistics)) {
        std::string label(name);
        std::ranges::replace(label, '_', ' ');
        TableRow row{.label = label,
                     .cells = {fmt::format("{}", kind->count), number(kind->per_minute, 1),
                               number(kind->percent, 1)},
                     .key = std::string(name)};
        add_spread(row.cells, kind->duration_ms, 0);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table sequence_table(const gaze::EventStatistics& statistics) {
    Table table{.heads = {{""}, {"this recording"}, {"published"}}, .rows = {}};
    const auto& fit = statistics.main_sequence;
    if (!fit) {
        return table;
    }
    constexpr double kPublishedSaturation_deg_per_s = 596.0;
    constexpr double kPublishedBend_deg = 6.47;
    const auto row = [&](const char* label, const std::string& here, const std::string& published) {
        table.rows.push_back({.label = label, .cells = {here, published}});
    };
    row("saccades of 2 deg or more", fmt::format("{}", fit->saccades), "543");
    row("peak velocity saturates at (deg/s)",
        fit->saturates ? number(fit->saturation_deg_per_s, 0) : "does not",
        number(kPublishedSaturation_deg_per_s, 0));
    row("bend (deg)", fit->saturates ? number(fit->bend_deg, 2) : "-",
        number(kPublishedBend_deg, 2));
    row("slope at 0 (per s)", number(fit->saturation_deg_per_s / fit->bend_deg, 1),
        number(kPublishedSaturation_deg_per_s / kPublishedBend_deg, 1));
    row("peak velocity, RMSE (deg/s)", number(fit->peak_rmse_deg_per_s, 0), "110");
    row("peak over the published one, median", number(fit->peak_over_published, 2), "1.00");
    row("duration (ms per deg)", number(fit->ms_per_deg, 2), "2.54");
    row("duration at 0 (ms)", number(fit->intercept_ms, 1), "15.9");
    row("duration, RMSE (ms)", number(fit->duration_rmse_ms, 1), "-");
    return table;
}

Table saccade_table(std::span<const gaze::RecordedEvent> events) {
    constexpr std::array kEdges_deg{0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 180.0};
    Table table{.heads = {{"amplitude (deg)"},
                          {"saccades"},
                          {"peak, median (deg/s)"},
                          {"published (deg/s)"},
                          {"duration, median (ms)"},
                          {"published (ms)"}},
                .rows = {}};
    for (std::size_t bin = 0; bin + 1 < kEdges_deg.size(); ++bin) {
        std::vector<double> amplitudes;
        std::vector<double> peaks;
        std::vector<double> durations;
        for (const gaze::RecordedEvent& event : events) {
            if (event.event == gaze::EyeEvent::Saccade && event.amplitude_deg > kEdges_deg[bin] &&
                event.amplitude_deg <= kEdges_deg[bin + 1]) {
                amplitudes.push_back(event.amplitude_deg);
                peaks.push_back(event.peak_deg_per_s);
                durations.push_back(event.duration_ms());
            }
        }
        if (amplitudes.empty()) {
            continue;
        }
        const gaze::MainSequence published = gaze::main_sequence(median(amplitudes));
        table.rows.push_back(
            {.label = fmt::format("{} to {}", kEdges_deg[bin], kEdges_deg[bin + 1]),
             .cells = {fmt::format("{}", amplitudes.size()), number(median(peaks), 0),
                       number(published.peak_deg_per_s, 0), number(median(durations), 0),
                       number(published.duration_s * 1e3, 0)}});
    }
    return table;
}

Table place_table(std::span<const gaze::RecordedEvent> events) {
    constexpr double kCell_deg = 10.0;
    std::map<std::pair<int, int>, double> ms;  // by elevation downwards, then azimuth
    double all_ms = 0.0;
    for (const gaze::RecordedEvent& event : events) {
        if (event.event == gaze::EyeEvent::Fixation && event.middle != glm::dvec3{0.0}) {
            const glm::dvec3& middle = event.middle;
            const double right = glm::degrees(std::atan2(middle.x, -middle.z));
            const double up = glm::degrees(std::atan2(middle.y, std::hypot(middle.x, middle.z)));
            ms[{-static_cast<int>(std::floor(up / kCell_deg)),
                static_cast<int>(std::floor(right / kCell_deg))}] += event.duration_ms();
            all_ms += event.duration_ms();
        }
    }
    Table table{.heads = {{"elevation (deg)"}, {"azimuth (deg)"}, {"fixation time (s)"}, {"%"}},
                .rows = {}};
    for (const auto& [cell, spent_ms] : ms) {
        const double up = -cell.first * kCell_deg;
        const double right = cell.second * kCell_deg;
        table.rows.push_back(
            {.label = fmt::format("{} to {}", up, up + kCell_deg),
             .cells = {fmt::format("{} to {}", right, right + kCell_deg),
                       number(spent_ms * 1e-3, 2),
                       all_ms > 0.0 ? number(100.0 * spent_ms / all_ms, 1) : "-"}});
    }
    return table;
}

Table agreement_table(const gaze::GazeComparison& comparison) {
    Table table{
        .heads = {{"axis"}, {"gain"}, {"offset (deg)"}, {"left over, RMS (deg)"}, {"correlation"}},
        .rows = {}};
    const auto add = [&](const char* axis, const gaze::AxisAgreement& agreement) {
        table.rows.push_back(
            {.label = axis,
             .cells = {number(agreement.gain, 3), fmt::format("{:+.2f}", agreement.offset_deg),
                       number(agreement.residual_deg, 2), number(agreement.correlation, 3)}});
    };
    add("azimuth", comparison.azimuth);
    add("elevation", comparison.elevation);
    return table;
}

Table lag_table(const gaze::GazeComparison& comparison) {
    constexpr double kEvery_ms = 100.0;
    Table table{.heads = {{"lag (ms)"}, {"correlation of the velocities"}}, .rows = {}};
    const auto each =
        static_cast<std::size_t>(std::max(1.0, std::round(kEvery_ms / comparison.step_ms)));
    for (std::size_t i = 0; i < comparison.correlation_at.size(); i += each) {
        const double correlation = comparison.correlation_at[i];
        table.rows.push_back({.label = number(comparison.lag_at_ms(i), 0),
                              .cells = {std::isnan(correlation) ? "-" : number(correlation, 3)}});
    }
    return table;
}

}  // namespace gazeloop::report::page
