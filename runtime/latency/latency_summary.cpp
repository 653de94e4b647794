#include "runtime/latency/latency_summary.h"

#include "runtime/latency/frame_account.h"
#include "runtime/time/milliseconds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gazeloop::latency {
namespace {

constexpr double kRealTimeIntervalFactor = 1.05;
constexpr double kRealTimeMissedPercent = 5.0;

Verdict verdict_of(const SummaryReport& report) {
    if (report.config.clock == LoopClock::Virtual) {
        return Verdict::VirtualTime;
    }
    const std::optional<double> interval_ms = report.frame_interval.p50_ms;
    if (!interval_ms || report.config.period_ns <= 0) {
        return Verdict::Unknown;
    }
    const double period_ms = static_cast<double>(report.config.period_ns) / time::kNsPerMs;
    const bool slow = *interval_ms > kRealTimeIntervalFactor * period_ms ||
                      report.missed_percent().value_or(0.0) > kRealTimeMissedPercent;
    return slow ? Verdict::NotRealTime : Verdict::RealTime;
}

template <std::size_t N>
std::array<DurationRow, N> rows(const std::array<SpanSeries, N>& series) {
    std::array<DurationRow, N> result;
    std::transform(series.begin(), series.end(), result.begin(),
                   [](const SpanSeries& one) { return one.row(); });
    return result;
}

}  // namespace

std::optional<double> SummaryReport::missed_percent() const {
    const std::uint64_t known = frames.rendered - frames.in_time_unknown;
    if (known == 0) {
        return std::nullopt;
    }
    return 100.0 * static_cast<double>(frames.missed) / static_cast<double>(known);
}

std::optional<double> SummaryReport::samples_saved_factor() const {
    const std::uint64_t shaded = samples.shaded();
    if (shaded == 0) {
        return std::nullopt;
    }
    const std::uint64_t hidden = std::min(samples.pixels_hidden, samples.pixels_output);
    return static_cast<double>(samples.pixels_output - hidden) / static_cast<double>(shaded);
}

LatencySummary::LatencySummary(const SummaryConfig& config) : config_(config) {}

void LatencySummary::add_event(const time::Stamp& time, std::string_view kind,
                               std::string_view text) {
    if (frame::weight_of(kind) != frame::EventWeight::Routine) {
        happenings_.add(time, kind, text);
    }
}

void LatencySummary::add(const gaze::GazeSample& sample) { gaze_.add(sample); }

void LatencySummary::add(const frame::FrameRecord& record) {
    ++frames_.total;
    began_ = began_.value_or(record.stamps.wake_up);
    if (before_ && before_->index + 1 == record.index) {
        frame_interval_.add(time::between(before_->wake_up, record.stamps.wake_up));
    }
    before_ = {record.index, record.stamps.wake_up};
    loop_time_.add(time::between(record.stamps.wake_up, record.stamps.end_frame));
    if (!record.should_render) {
        return;
    }
    pending_.add(record, [this](const FinishedFrame& finished) { complete(finished); });
}

void LatencySummary::add(const frame::FrameGpuRecord& record) {
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        if (const auto ns = record.passes[pass]) {
            passes_[pass].add({*ns, time::StampKind::Measured});
        }
    }
    pending_.add(record, [this](const FinishedFrame& finished) { complete(finished); });
}

void LatencySummary::complete(const FinishedFrame& finished) {
    ++frames_.rendered;
    samples_ += finished.frame.samples;

    const std::int64_t period_ns = period_in_force_ns();
    const FrameAccount of_profile =
        account_of(finished, period_ns,
                   {.switching_ns = config_.switching_ns, .rolling_ns = config_.rolling_ns});
    const FrameAccount of_unknown = account_of(finished, period_ns, {});
    const ShownFrame& shown = of_profile.shown;
    frames_.in_time_unknown += shown.in_time_known ? 0 : 1;
    frames_.display_unknown += finished.frame.stamps.display.known() ? 0 : 1;
    frames_.missed += shown.periods_missed > 0 ? 1 : 0;
    frames_.periods_missed += shown.periods_missed;
    ++frames_.by_state[static_cast<std::size_t>(of_profile.state)];
    if (of_profile.with_gaze()) {
        add_tracking(of_unknown.age);
        of_profile_.add_tracking(of_profile.age);
        of_unknown_.add_tracking(of_unknown.age);
    } else if (of_profile.state != gaze::FoveaState::Ahead) {
        of_profile_.held_gaze_age.add(of_profile.age.at_display);
        of_unknown_.held_gaze_age.add(of_unknown.age.at_display);
    }
}

void LatencySummary::add_tracking(const GazeAge& age) {
    gaze_age_at_latch_.add(age.at_latch);
    gaze_age_read_at_begin_.add(age.read_at_begin);
    gaze_age_uncertainty_.add(age.uncertainty);
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        stages_[stage].add(age.stages[stage]);
    }
}

void LatencySummary::AtDisplay::add_tracking(const GazeAge& age) {
    gaze_age.add(age.at_display);
    row.add(age.stages[static_cast<std::size_t>(Stage::Row)]);
    switching.add(age.stages[static_cast<std::size_t>(Stage::Switching)]);
    unaccounted.add(age.unaccounted);
    const auto add_length = [this](time::StampKind kind, const time::Span& span) {
        length_by_kind_ns[static_cast<std::size_t>(kind)] += std::abs(static_cast<double>(span.ns));
    };
    for (const time::Span& stage : age.stages) {
        if (age.at_display.known() && stage.known()) {
            add_length(stage.kind, stage);
        }
    }
    if (age.unaccounted.known()) {
        add_length(time::StampKind::Unknown, age.unaccounted);
    }
}

SummaryReport LatencySummary::report() const {
    LatencySummary finished = *this;
    finished.pending_.finish([&finished](const FinishedFrame& frame) { finished.complete(frame); });
    return finished.report_of_complete();
}

SummaryReport LatencySummary::report_of_complete() const {
    SummaryReport report;
    report.config = config_;
    report.config.period_ns = period_in_force_ns();
    const bool profiles_display = may_be_of_period(report.config.period_ns, config_.period_ns);
    if (!profiles_display) {
        report.config.switching_ns.reset();
        report.config.rolling_ns.reset();
        report.config.persistence_ns.reset();
    }
    const AtDisplay& at_display = profiles_display ? of_profile_ : of_unknown_;
    report.gaze_age_at_latch = gaze_age_at_latch_.row();
    report.gaze_age_read_at_begin = gaze_age_read_at_begin_.row();
    report.gaze_age_at_display = at_display.gaze_age.row();
    report.gaze_age_uncertainty = gaze_age_uncertainty_.row();
    report.stages = rows(stages_);
    report.stages[static_cast<std::size_t>(Stage::Row)] = at_display.row.row();
    report.stages[static_cast<std::size_t>(Stage::Switching)] = at_display.switching.row();
    report.unaccounted = at_display.unaccounted.row();
    report.held_gaze_age_at_display = at_display.held_gaze_age.row();
    report.frame_interval = frame_interval_.row();
    report.loop_time = loop_time_.row();
    report.passes = rows(passes_);
    report.frames = frames_;
    report.gaze = gaze_counts_.value_or(gaze_.counts());
    report.samples = samples_;
    report.happenings.assign(happenings_.list().begin(), happenings_.list().end());
    report.other_happenings = happenings_.others();
    report.began = began_.value_or(time::Stamp{});

    const double length_ns = std::accumulate(at_display.length_by_kind_ns.begin(),
                                             at_display.length_by_kind_ns.end(), 0.0);
    if (length_ns > 0.0) {
        report.share_by_kind_percent.emplace();
        std::transform(at_display.length_by_kind_ns.begin(), at_display.length_by_kind_ns.end(),
                       report.share_by_kind_percent->begin(),
                       [length_ns](double kind_ns) { return 100.0 * kind_ns / length_ns; });
    }
    report.verdict = verdict_of(report);
    return report;
}

}  // namespace gazeloop::latency
