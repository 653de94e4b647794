// A tracker and a display whose delays are known: what the report says of them is the truth, age by
// age and stage by stage, at every percentile that it shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/device/sample_clock.h"
#include "runtime/display/display_profile.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/latency/summary_observer.h"
#include "runtime/report/frame_log.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "sim/random.h"

namespace gazeloop::latency {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kTrackerPeriod_ns = 5 * kMs;
constexpr std::int64_t kDisplayPeriod_ns = 11'111'111;
constexpr std::int64_t kSwitching_ns = 1'500'000;
constexpr std::int64_t kRolling_ns = 8 * kMs;
constexpr std::int64_t kDelay_ns = 8 * kMs;  ///< of the tracker, from exposure to arrival at best
constexpr std::int64_t kProfile_ns = 10 * kMs;  ///< what its profile takes this to be
constexpr std::int64_t kProfileWithin_ns = 3 * kMs;
constexpr std::int64_t kFirstFrame_ns = 3 * kSecond;  ///< the clock has been fitted by then
constexpr int kFrames = 5'000;
constexpr double kWithin_ms = 0.1;

enum class DelayKind {
    Fixed,
    Jittered,
    Drifting,  ///< the jitter grows
    Rising,    ///< the least delay grows, by 6 ms: to another clock the tracker's would look slow
};
enum class ClockKind { Shared, Independent };

struct Injected {
    const char* name;
    DelayKind delay;
    ClockKind clock;
};

void PrintTo(const Injected& injected, std::ostream* out) { *out << injected.name; }

/// One sample as it happened, and as the host is told.
struct TruthOfSample {
    std::int64_t exposed_ns;
    gaze::GazeSample sample;
};

/// A sample each 5 ms from 0 on, in the order of arrival.
std::vector<TruthOfSample> samples_of(const Injected& injected) {
    drivers::SampleClock clock(time::TickCounter{64, 1000.0},
                               {.least_ns = kProfile_ns, .uncertainty_ns = kProfileWithin_ns});
    sim::Random random(7, sim::Stream::Jitter);
    std::vector<TruthOfSample> samples;
    constexpr std::int64_t kStart_ns = 1'000 * kSecond;
    const std::int64_t last_ns = kFirstFrame_ns + (kFrames + 10) * kDisplayPeriod_ns;
    std::int64_t arrived_before_ns = 0;
    for (std::int64_t since_ns = 0; since_ns < last_ns; since_ns += kTrackerPeriod_ns) {
        const double share = static_cast<double>(since_ns) / static_cast<double>(last_ns);
        const double more_ns = injected.delay == DelayKind::Fixed      ? 0.0
                               : injected.delay == DelayKind::Jittered ? random.exponential(500e3)
                               : injected.delay == DelayKind::Drifting
                                   ? random.exponential(50e3 + 1.5e6 * share)
                                   : 6e6 * share + random.exponential(100e3);
        const std::int64_t exposed_ns = kStart_ns + since_ns;
        TruthOfSample truth{.exposed_ns = exposed_ns, .sample = {}};
        truth.sample.sequence = samples.size() + 1;
        for (gaze::EyeRay& eye : truth.sample.eyes) {
            eye.direction = {0.3 * std::sin(20.0 * share), 0.3 * std::cos(33.0 * share), -1.0};
            eye.valid = true;
        }
        // A queue: no sample overtakes another.
        const std::int64_t arrived_ns = std::max<std::int64_t>(
            arrived_before_ns, exposed_ns + kDelay_ns + std::llround(more_ns));
        arrived_before_ns = arrived_ns;
        if (injected.clock == ClockKind::Shared) {
            truth.sample.sampled = {exposed_ns, time::StampKind::Measured};
            truth.sample.arrived = {arrived_ns, time::StampKind::Measured};
        } else {
            // Microseconds of a clock that is 150 ppm fast and began at another time.
            const auto ticks = static_cast<std::uint64_t>(
                std::llround((static_cast<double>(since_ns) * (1.0 + 150e-6)) / 1000.0) + 77'777);
            clock.stamp(ticks, arrived_ns, truth.sample);
        }
        samples.push_back(truth);
    }
    return samples;
}

using Truth = std::map<std::string, std::vector<double>>;  // by the report's key, ms

/// How long it really took, and what the report says.
struct Ages {
    Truth truth;
    SummaryReport summary;
    std::vector<report::SessionRow> rows;
};

double to_ms(std::int64_t ns) { return static_cast<double>(ns) * 1e-6; }

Ages ages_of(const Injected& injected) {
    const std::vector<TruthOfSample> samples = samples_of(injected);
    const std::int64_t start_ns = samples.front().exposed_ns;
    display::DisplayProfile display;
    display.fov.fill({-0.8, 0.8, 0.8, -0.8});
    display.width_px = 1000;
    display.height_px = 1000;
    gaze::StereoView views;
    for (const gaze::Eye eye : gaze::kEyes) {
        views[gaze::index(eye)] = display::profile_view(display, eye, 1000, 1000);
    }
    const SummaryConfig config{
        .period_ns = kDisplayPeriod_ns, .switching_ns = kSwitching_ns, .rolling_ns = kRolling_ns};
    LatencySummary summary(config);
    SummaryObserver summing(summary);
    report::FrameLog log(config);
    const auto tell = [&](const auto& call) {
        call(static_cast<frame::FrameObserver&>(summing));
        call(static_cast<frame::FrameObserver&>(log));
    };
    gaze::GazeToFovea gaze(gaze::FoveaPolicy{});
    sim::Random random(11, sim::Stream::Noise);
    Ages ages;
    auto next = samples.begin();
    for (int index = 0; index < kFrames; ++index) {
        const std::int64_t wake_ns = start_ns + kFirstFrame_ns + index * kDisplayPeriod_ns;
        const auto at = [wake_ns](std::int64_t after_ns) {
            return time::Stamp{wake_ns + after_ns, time::StampKind::Measured};
        };
        frame::FrameRecord frame;
        frame.index = static_cast<std::uint64_t>(index);
        frame.period_ns = kDisplayPeriod_ns;
        frame.views = views;
        frame.stamps.wake_up = at(0);
        frame.stamps.begin = at(100'000);
        frame.stamps.latch = at(kMs + std::llround(random.exponential(300e3)));
        for (; next != samples.end() && next->sample.arrived.ns <= frame.stamps.latch.ns; ++next) {
            gaze.add(next->sample);
            tell([&](frame::FrameObserver& told) { told.on_sample(next->sample, frame.index); });
        }
        frame.fovea = gaze.latch(frame.stamps.latch, {}, views);
        frame.stamps.filtered = {frame.stamps.latch.ns + 20'000, time::StampKind::Measured};
        frame.stamps.submit = {frame.stamps.latch.ns + 400'000, time::StampKind::Measured};
        frame.stamps.end_frame = {frame.stamps.latch.ns + 500'000, time::StampKind::Measured};
        frame.stamps.display = {at(2 * kDisplayPeriod_ns).ns, time::StampKind::Predicted};
        frame::FrameGpuRecord gpu;
        gpu.index = frame.index;
        gpu.gpu_begin = {frame.stamps.submit.ns + 200'000, time::StampKind::Measured};
        // Now and then a frame is late, and the display shows it a period later or more.
        const double share = static_cast<double>(index) / kFrames;
        const double more_ns = injected.delay == DelayKind::Fixed      ? 0.0
                               : injected.delay == DelayKind::Jittered ? random.exponential(1e6)
                                                                       : 8e6 * share;
        const std::int64_t gpu_ns = (index % 50 == 49 ? 25 * kMs : 6 * kMs) + std::llround(more_ns);
        gpu.gpu_end = {gpu.gpu_begin.ns + gpu_ns, time::StampKind::Measured};
        tell([&](frame::FrameObserver& told) { told.on_frame(frame); });
        tell([&](frame::FrameObserver& told) { told.on_gpu(gpu); });

        const gaze::FoveaPoint& fovea = frame.fovea.eyes[0];
        const TruthOfSample& used = samples[fovea.sample_sequence - 1];
        std::int64_t shown_ns = frame.stamps.display.ns;
        while (shown_ns < gpu.gpu_end.ns) {
            shown_ns += kDisplayPeriod_ns;
        }
        const double row = std::clamp(fovea.position.y_px / 1000.0, 0.0, 1.0);
        const double row_ns = (row - 0.5) * static_cast<double>(kRolling_ns);
        const std::int64_t latch_ns = frame.stamps.latch.ns;
        const auto add = [&](const std::string& key, double ns) {
            ages.truth[key].push_back(ns * 1e-6);
        };
        const auto add_stage = [&](Stage stage, std::int64_t ns) {
            add(report::stage_name(static_cast<std::size_t>(stage)).key, static_cast<double>(ns));
        };
        add(report::kGazeAgeAtLatch.key, static_cast<double>(latch_ns - used.exposed_ns));
        add(report::kGazeAgeAtDisplay.key,
            static_cast<double>(shown_ns - used.exposed_ns + kSwitching_ns) + row_ns);
        if (injected.clock == ClockKind::Shared) {
            add_stage(Stage::Tracker, used.sample.arrived.ns - used.exposed_ns);
        } else {
            // No fit sees a delay that each sample has: the profile's figure stands for it.
            add_stage(Stage::Tracker, kDelay_ns);
            add_stage(Stage::Delivery, used.sample.arrived.ns - used.exposed_ns - kDelay_ns);
        }
        add_stage(Stage::Queue, latch_ns - used.sample.arrived.ns);
        add_stage(Stage::Filter, 20'000);
        add_stage(Stage::Submit, 380'000);
        add_stage(Stage::Gpu, gpu_ns);
        add_stage(Stage::Wait, shown_ns - gpu.gpu_end.ns);
        add(report::stage_name(static_cast<std::size_t>(Stage::Row)).key, row_ns);
        add_stage(Stage::Switching, kSwitching_ns);
        add(report::kUnaccounted.key, 200e3);
    }
    log.finish();
    for (auto& [key, values] : ages.truth) {
        std::ranges::sort(values);
    }
    ages.summary = summary.report();
    ages.rows = report::rows_of(log, report::Percentiles().percents());
    return ages;
}

/// The nearest rank; what 99.9 is off as a double must not make it the next one.
double percentile(const std::vector<double>& sorted, double percent) {
    constexpr double kRounding = 1e-9;
    const auto rank = static_cast<std::size_t>(
        std::ceil(percent * static_cast<double>(sorted.size()) / 100.0 - kRounding));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

void expect_truth(const report::SessionRow& row, const std::vector<double>& sorted,
                  double constant_ms) {
    SCOPED_TRACE(row.name.key);
    ASSERT_EQ(row.known, sorted.size());
    EXPECT_NEAR(*row.least - constant_ms, sorted.front(), kWithin_ms);
    EXPECT_NEAR(*row.greatest - constant_ms, sorted.back(), kWithin_ms);
    double sum = 0.0;
    for (const double value : sorted) {
        sum += value;
    }
    EXPECT_NEAR(*row.mean - constant_ms, sum / static_cast<double>(sorted.size()), kWithin_ms);
    const std::vector<double> percents = report::Percentiles().percents();
    ASSERT_EQ(row.percentiles.size(), percents.size());
    for (std::size_t place = 0; place < percents.size(); ++place) {
        ASSERT_TRUE(row.percentiles[place].has_value()) << percents[place];
        EXPECT_NEAR(*row.percentiles[place] - constant_ms, percentile(sorted, percents[place]),
                    kWithin_ms)
            << "p" << percents[place];
    }
}

/// What a run's own summary says of the same, whose percentiles are within .2 %.
void expect_truth(const DurationRow& row, const std::vector<double>& sorted, double constant_ms) {
    constexpr double kHistogram = 0.002;
    ASSERT_EQ(row.count, sorted.size());
    for (const auto& [told, percent] :
         {std::pair{row.p50_ms, 50.0}, {row.p95_ms, 95.0}, {row.p99_ms, 99.0}}) {
        EXPECT_NEAR(*told - constant_ms, percentile(sorted, percent),
                    kWithin_ms + kHistogram * *told)
            << "p" << percent;
    }
}

class LatencyTruth : public testing::TestWithParam<Injected> {};

TEST_P(LatencyTruth, IsWhatTheReportSays) {
    const Injected& injected = GetParam();
    const Ages ages = ages_of(injected);
    const SummaryReport& summary = ages.summary;
    ASSERT_EQ(summary.frames.with_gaze(), static_cast<std::uint64_t>(kFrames));
    const double constant_ms =
        injected.clock == ClockKind::Shared ? 0.0 : to_ms(kProfile_ns - kDelay_ns);
    std::size_t compared = 0;
    for (const report::SessionRow& row : ages.rows) {
        const auto truth = ages.truth.find(row.name.key);
        if (truth == ages.truth.end()) {
            continue;
        }
        const bool with_constant =
            row.name.key == report::kGazeAgeAtLatch.key ||
            row.name.key == report::kGazeAgeAtDisplay.key ||
            row.name.key == report::stage_name(static_cast<std::size_t>(Stage::Tracker)).key;
        expect_truth(row, truth->second, with_constant ? constant_ms : 0.0);
        ++compared;
    }
    EXPECT_EQ(compared, ages.truth.size()) << "every quantity that was injected is shown";
    expect_truth(summary.gaze_age_at_latch, ages.truth.at(report::kGazeAgeAtLatch.key),
                 constant_ms);
    expect_truth(summary.gaze_age_at_display, ages.truth.at(report::kGazeAgeAtDisplay.key),
                 constant_ms);
    if (injected.clock == ClockKind::Shared) {
        EXPECT_EQ(summary.gaze_age_at_latch.kind(), time::StampKind::Measured);
        EXPECT_EQ(summary.gaze_age_uncertainty.count, 0U);
    } else {
        // Said, and true: the constant lies inside the stated uncertainty.
        EXPECT_EQ(summary.gaze_age_at_latch.kind(), time::StampKind::Profile);
        ASSERT_EQ(summary.gaze_age_uncertainty.count, static_cast<std::uint64_t>(kFrames));
        EXPECT_GE(*summary.gaze_age_uncertainty.min_ms, constant_ms);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Delays, LatencyTruth,
    testing::Values(Injected{"FixedShared", DelayKind::Fixed, ClockKind::Shared},
                    Injected{"JitteredShared", DelayKind::Jittered, ClockKind::Shared},
                    Injected{"DriftingShared", DelayKind::Drifting, ClockKind::Shared},
                    Injected{"RisingShared", DelayKind::Rising, ClockKind::Shared},
                    Injected{"FixedIndependent", DelayKind::Fixed, ClockKind::Independent},
                    Injected{"JitteredIndependent", DelayKind::Jittered, ClockKind::Independent},
                    Injected{"DriftingIndependent", DelayKind::Drifting, ClockKind::Independent}),
    [](const testing::TestParamInfo<Injected>& injected) {
        return std::string(injected.param.name);
    });

}  // namespace
}  // namespace gazeloop::latency
