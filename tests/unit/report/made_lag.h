#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/report/lag_reasons.h"

namespace gazeloop::report {

using latency::DurationRow;
using latency::Stage;
using latency::SummaryReport;
using latency::Verdict;

inline constexpr std::uint64_t kFrames = 200;

inline DurationRow row(double mean_ms, std::uint64_t frames = kFrames) {
    DurationRow made;
    made.count = frames;
    made.frames_by_kind[static_cast<std::size_t>(time::StampKind::Measured)] = frames;
    if (frames > 0) {
        made.min_ms = 0.5 * mean_ms;
        made.mean_ms = made.p50_ms = mean_ms;
        made.p95_ms = 1.2 * mean_ms;
        made.p99_ms = 1.3 * mean_ms;
        made.max_ms = 1.5 * mean_ms;
    }
    return made;
}

inline const std::vector<NamedValue> kSoftware{{"vulkan device", "llvmpipe"},
                                               {"processor", "some CPU"}};

/// A run that keeps up, with everything known and 36 ms in 8 stages; the tracker costs most.
struct Made {
    SummaryReport report;
    std::vector<NamedValue> settings{{"render.scale", "0.5"},
                                     {"render.method", "kfr"},
                                     {"kfr.sigma", "1.8"},
                                     {"acuity.mar", "0.022"},
                                     {"sim.delay_ms", "15"},
                                     {"profile.tracker", "generic"},
                                     {"gaze.stale_ms", "100"},
                                     {"gaze.minimum_confidence", "0.6"},
                                     {"render.frames_in_flight", "2"},
                                     {"render.wait_before_latch", "false"}};
    latency::LatencyBudget budget{
        .name = "albert2017", .description = "", .source = "", .total_ns = 70'000'000};
    LagFacts facts;

    Made() {
        report.config.period_ns = 10'000'000;
        report.config.switching_ns = 1'000'000;
        report.config.rolling_ns = 0;
        report.verdict = Verdict::RealTime;
        report.frames.total = report.frames.rendered = kFrames;
        report.frames.by_state[static_cast<std::size_t>(gaze::FoveaState::Tracking)] = kFrames;
        report.gaze.received = 2 * kFrames;
        report.gaze_age_at_latch = row(14.0);
        for (DurationRow& stage : report.stages) {
            stage = row(1.0);
        }
        report.stages[static_cast<std::size_t>(Stage::Present)] = {};
        report.unaccounted = row(1.0);
        report.frame_interval = row(10.0);
        set(Stage::Tracker, 12.0);
        facts.report = &report;
        facts.settings = settings;
        facts.origin = GazeOrigin::Tracker;
        facts.smoothing.rate_hz = 120.0;
        facts.use.rendered = facts.use.with_gaze = kFrames;
        facts.use.comparable = kFrames - 1;
    }
    Made(const Made&) = delete;
    Made& operator=(const Made&) = delete;
    ~Made() = default;

    void set(Stage stage, double mean_ms) {
        report.stages[static_cast<std::size_t>(stage)] = row(mean_ms);
        sum_up();
    }
    void sum_up() {
        double sum_ms = report.unaccounted.mean_ms.value_or(0.0);
        for (const DurationRow& stage : report.stages) {
            sum_ms += stage.mean_ms.value_or(0.0);
        }
        report.gaze_age_at_display = row(sum_ms);
    }
    void forget_gaze(std::uint64_t received) {
        report.frames.by_state = {};
        report.frames.by_state[static_cast<std::size_t>(gaze::FoveaState::Ahead)] = kFrames;
        report.gaze = {.received = received, .invalid = received};
        for (DurationRow& stage : report.stages) {
            stage = {};
        }
        report.unaccounted = report.gaze_age_at_display = report.gaze_age_at_latch = {};
        facts.use = {.rendered = kFrames, .lost = kFrames, .before_first = kFrames};
    }
    /// So many of the frames, for a cause that is known, or for None.
    void lose(std::uint64_t frames, gaze::LossCause cause) {
        facts.use.lost = frames;
        facts.use.with_gaze -= frames;
        facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Invalid)] = frames;
        facts.use.lost_by_cause[static_cast<std::size_t>(cause)] = frames;
    }
    void forget_frames(std::uint64_t total) {
        forget_gaze(0);
        report.frames = {};
        report.frames.total = total;
        facts.use = {};
    }
    [[nodiscard]] LagReasons reasons() const {
        LagFacts known = facts;
        if (!known.settings.empty()) {
            known.settings = settings;  // which may have grown since, and so have moved
        }
        return lag_reasons(known);
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const LagSentence& sentence : reasons().paragraph) {
            text += sentence.text + "\n";
        }
        return text;
    }
    [[nodiscard]] std::vector<std::string_view> rules() const {
        std::vector<std::string_view> names;
        for (const LagSentence& sentence : reasons().paragraph) {
            names.push_back(sentence.rule);
        }
        return names;
    }
};

}  // namespace gazeloop::report
