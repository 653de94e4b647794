#include "runtime/latency/predicted_latency.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/time/milliseconds.h"

namespace gazeloop::latency {
namespace {

/// -ln(.001): an exponential delay is longer than so many means once in a thousand times.
constexpr double kRareJitter = 6.9;

struct Figure {
    std::string_view name;
    std::optional<double> DurationRow::* value;
};
constexpr std::array<Figure, 5> kFigures{Figure{"min", &DurationRow::min_ms},
                                         {"p50", &DurationRow::p50_ms},
                                         {"p95", &DurationRow::p95_ms},
                                         {"p99", &DurationRow::p99_ms},
                                         {"max", &DurationRow::max_ms}};

std::int64_t rounded(double ns) {
    constexpr double kLimit = 9e18;
    return std::llround(std::clamp(ns, -kLimit, kLimit));
}

std::optional<std::int64_t> to_ns(const std::optional<double>& ms) {
    return ms ? std::optional(rounded(*ms * time::kNsPerMs)) : std::nullopt;
}

double to_ms(std::int64_t ns) { return static_cast<double>(ns) / time::kNsPerMs; }

constexpr std::size_t place(Part part) { return static_cast<std::size_t>(part); }
constexpr std::size_t place(Stage stage) { return static_cast<std::size_t>(stage); }

/// 0 with a rate without end: gaze that is there whenever it is asked for.
std::optional<std::int64_t> period_of(const std::optional<double>& rate_hz) {
    if (!rate_hz || !(*rate_hz > 0.0)) {
        return std::nullopt;
    }
    return rounded(1e9 / *rate_hz);
}

PredictedSum sum_of(const std::array<PartRange, kPartCount>& parts, bool with_phase) {
    PredictedSum sum;
    __int128 best = 0;
    __int128 worst = 0;
    for (std::size_t part = 0; part < kPartCount; ++part) {
        if (part == place(Part::Phase) && !with_phase) {
            continue;
        }
        best += parts[part].least_ns.value_or(0);
        worst += parts[part].greatest_ns.value_or(0);
        sum.best_at_least = sum.best_at_least || !parts[part].least_ns;
        sum.worst_at_least = sum.worst_at_least || !parts[part].greatest_ns;
    }
    sum.best_ns = time::saturated(best);
    sum.worst_ns = time::saturated(worst);
    return sum;
}

/// What was measured of a part, ms; none where no frame knows it.
std::optional<double> measured_ms(const SummaryReport& report, Part part, const Figure& figure) {
    if (part != Part::Loop) {
        const DurationRow* const row = measured_row(report, part);
        return row == nullptr ? std::nullopt : row->*figure.value;
    }
    const auto submit = report.stages[place(Stage::Submit)].*figure.value;
    if (!submit) {
        return std::nullopt;
    }
    return *submit + (report.stages[place(Stage::Filter)].*figure.value).value_or(0.0) +
           (report.unaccounted.*figure.value).value_or(0.0);
}

/// The part that is farthest outside its own range at this figure.
void blame(OutsidePrediction& outside, const PredictedLatency& predicted,
           const SummaryReport& report, const Figure& figure) {
    // Where the earliest time of a sample at the host is unknown, delivery is in the tracker's row.
    const bool delivery_apart = report.stages[place(Stage::Delivery)].count > 0;
    double farthest_ms = 0.0;
    for (std::size_t p = 0; p < kPartCount; ++p) {
        const Part part{static_cast<std::uint8_t>(p)};
        const auto measured = measured_ms(report, part, figure);
        auto limit_ns =
            outside.above ? predicted.parts[p].greatest_ns : predicted.parts[p].least_ns;
        if (part == Part::Tracker && !delivery_apart && limit_ns) {
            const PartRange& delivery = predicted.parts[place(Part::Delivery)];
            const auto more = outside.above ? delivery.greatest_ns : delivery.least_ns;
            limit_ns =
                more ? std::optional(time::saturated(static_cast<__int128>(*limit_ns) + *more))
                     : std::nullopt;
        }
        if (!measured || !limit_ns) {
            continue;
        }
        const double excess_ms =
            outside.above ? *measured - to_ms(*limit_ns) : to_ms(*limit_ns) - *measured;
        if (excess_ms > farthest_ms) {
            farthest_ms = excess_ms;
            outside.part = part;
            outside.part_measured_ms = *measured;
            outside.part_limit_ms = to_ms(*limit_ns);
        }
    }
}

}  // namespace

PredictedSum PredictedLatency::gaze_age() const { return sum_of(parts, false); }
PredictedSum PredictedLatency::eye_to_photon() const { return sum_of(parts, true); }

PredictedLatency predicted_latency(const TrackerFigures& tracker, const SummaryReport& report) {
    PredictedLatency predicted;
    const auto set = [&predicted](Part part, std::optional<std::int64_t> least_ns,
                                  std::optional<std::int64_t> greatest_ns) {
        predicted.parts[place(part)] = {.least_ns = least_ns, .greatest_ns = greatest_ns};
    };
    set(Part::Tracker, tracker.delay_ns, tracker.delay_ns);
    set(Part::Delivery, 0,
        tracker.jitter_ns
            ? std::optional(rounded(kRareJitter * static_cast<double>(*tracker.jitter_ns)))
            : std::nullopt);
    set(Part::Sampling, 0, period_of(tracker.rate_hz));
    const std::optional<std::int64_t> period_ns =
        report.config.period_ns > 0 ? std::optional(report.config.period_ns) : std::nullopt;
    const auto interval_ns = to_ns(report.frame_interval.p50_ms);
    set(Part::Phase, 0, interval_ns ? interval_ns : period_ns);
    set(Part::Loop, 0, 0);
    const DurationRow& gpu = report.stages[place(Stage::Gpu)];
    // Clocks that are related may put the GPU's end before its submit by their deviation.
    const auto least_gpu_ns = to_ns(gpu.min_ms);
    set(Part::Render,
        least_gpu_ns ? std::optional(std::max<std::int64_t>(*least_gpu_ns, 0)) : std::nullopt,
        to_ns(gpu.p99_ms ? gpu.p99_ms : gpu.max_ms));
    set(Part::Display, 0, period_ns);
    if (const auto rolling_ns = report.config.rolling_ns) {
        set(Part::Row, -(*rolling_ns / 2), *rolling_ns / 2);
    }
    set(Part::Switching, report.config.switching_ns, report.config.switching_ns);
    return predicted;
}

const DurationRow* measured_row(const SummaryReport& report, Part part) {
    const auto stage = [&report](Stage one) { return &report.stages[place(one)]; };
    switch (part) {
        case Part::Tracker:
            return stage(Stage::Tracker);
        case Part::Delivery:
            return stage(Stage::Delivery);
        case Part::Sampling:
            return stage(Stage::Queue);
        case Part::Render:
            return stage(Stage::Gpu);
        case Part::Display:
            return stage(Stage::Wait);
        case Part::Row:
            return stage(Stage::Row);
        case Part::Switching:
            return stage(Stage::Switching);
        case Part::Phase:
        case Part::Loop:
            break;
    }
    return nullptr;
}

PredictionCheck check_prediction(const TrackerFigures& tracker, const SummaryReport& report) {
    PredictionCheck check{.predicted = predicted_latency(tracker, report),
                          .tracker_uncertainty_ns = tracker.uncertainty_ns};
    for (const Part part : {Part::Tracker, Part::Delivery, Part::Sampling, Part::Render,
                            Part::Display, Part::Row, Part::Switching}) {
        // Ages leave out the rows and the switching of a display that does not state them.
        const bool of_display = part == Part::Row || part == Part::Switching;
        if (!check.predicted.parts[place(part)].greatest_ns &&
            !(of_display && measured_row(report, part)->count == 0)) {
            check.unknown.push_back(part);
        }
    }
    const DurationRow& age = report.gaze_age_at_display;
    check.comparable = age.count > 0 && check.unknown.empty();
    if (age.count == 0) {
        return check;
    }
    const PredictedSum sum = check.predicted.gaze_age();
    for (const Figure& figure : kFigures) {
        const std::optional<double> measured = age.*figure.value;
        if (!measured) {
            continue;
        }
        const bool above = check.comparable && *measured > to_ms(sum.worst_ns);
        const bool below = *measured < to_ms(sum.best_ns);
        if (above || below) {
            OutsidePrediction outside{.what = figure.name,
                                      .measured_ms = *measured,
                                      .limit_ms = to_ms(above ? sum.worst_ns : sum.best_ns),
                                      .above = above};
            blame(outside, check.predicted, report, figure);
            check.outside.push_back(outside);
        }
    }
    return check;
}

}  // namespace gazeloop::latency
