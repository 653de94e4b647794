#include "runtime/latency/latency_summary.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

const SummaryConfig kWallConfig{.period_ns = kExamplePeriodNs, .switching_ns = 2 * kMs};

const DurationRow& row(const SummaryReport& report, Stage stage) {
    return report.stages[static_cast<std::size_t>(stage)];
}

std::uint64_t frames_in(const SummaryReport& report, gaze::FoveaState state) {
    return report.frames.by_state[static_cast<std::size_t>(state)];
}

double share(const SummaryReport& report, time::StampKind kind) {
    return report.share_by_kind_percent->at(static_cast<std::size_t>(kind));
}

void set_state(frame::FrameRecord& frame, gaze::FoveaState state, gaze::LossReason reason) {
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.state = state;
        eye.reason = reason;
    }
}

TEST(LatencySummary, SaysNothingOfNoFrames) {
    const SummaryReport report = LatencySummary(kWallConfig).report();
    EXPECT_EQ(report.verdict, Verdict::Unknown);
    EXPECT_EQ(report.frames.total, 0U);
    EXPECT_EQ(report.gaze_age_at_display.count, 0U);
    EXPECT_EQ(report.gaze_age_at_display.kind(), time::StampKind::Unknown);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, std::nullopt);
    EXPECT_EQ(report.share_by_kind_percent, std::nullopt);
    EXPECT_EQ(report.missed_percent(), std::nullopt);
    EXPECT_EQ(report.samples_saved_factor(), std::nullopt);
}

TEST(LatencySummary, KnowsTheAgesOfALoopThatKeepsUp) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 200; ++index) {
        summary.add(example_frame(index));
        summary.add(example_gpu(index));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.verdict, Verdict::RealTime);
    EXPECT_EQ(report.frames.total, 200U);
    EXPECT_EQ(report.frames.rendered, 200U);
    EXPECT_EQ(report.frames.missed, 0U);
    EXPECT_EQ(report.frames.in_time_unknown, 0U);
    EXPECT_EQ(report.missed_percent(), 0.0);
    EXPECT_EQ(frames_in(report, gaze::FoveaState::Tracking), 200U);

    EXPECT_EQ(report.gaze_age_at_latch.min_ms, 5.0);
    EXPECT_EQ(report.gaze_age_at_latch.max_ms, 5.0);
    EXPECT_EQ(report.gaze_age_at_latch.p99_ms, 5.0);
    EXPECT_EQ(report.gaze_age_read_at_begin.p50_ms, 6.0);
    EXPECT_EQ(report.gaze_age_read_at_begin.p99_ms, 6.0);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 18.0);
    EXPECT_EQ(row(report, Stage::Tracker).mean_ms, 3.0);
    EXPECT_EQ(row(report, Stage::Queue).mean_ms, 2.0);
    EXPECT_EQ(row(report, Stage::Submit).mean_ms, 1.0);
    EXPECT_EQ(row(report, Stage::Gpu).mean_ms, 4.0);
    EXPECT_EQ(row(report, Stage::Wait).mean_ms, 6.0);
    EXPECT_EQ(row(report, Stage::Switching).mean_ms, 2.0);
    EXPECT_EQ(report.unaccounted.max_ms, 0.0);
    EXPECT_EQ(report.held_gaze_age_at_display.count, 0U);
    EXPECT_EQ(report.frame_interval.count, 199U);
    EXPECT_EQ(report.frame_interval.p50_ms, 10.0);
    EXPECT_EQ(report.loop_time.max_ms, 4.0);

    EXPECT_EQ(row(report, Stage::Tracker).kind(), time::StampKind::Profile);
    EXPECT_EQ(row(report, Stage::Gpu).kind(), time::StampKind::Measured);
    EXPECT_EQ(report.gaze_age_at_display.kind(), time::StampKind::Predicted);
    EXPECT_FALSE(report.gaze_age_at_display.mixed());
    EXPECT_NEAR(share(report, time::StampKind::Measured), 100.0 * 7 / 18, 1e-9);
    EXPECT_NEAR(share(report, time::StampKind::Profile), 100.0 * 5 / 18, 1e-9);
    EXPECT_NEAR(share(report, time::StampKind::Predicted), 100.0 * 6 / 18, 1e-9);
    EXPECT_EQ(share(report, time::StampKind::Unknown), 0.0);

    EXPECT_EQ(report.passes[0].mean_ms, 3.0);
    EXPECT_EQ(report.passes[1].count, 0U);
    EXPECT_EQ(report.passes[2].mean_ms, 1.0);
    EXPECT_EQ(report.samples.grid_count, 2U);
    EXPECT_EQ(report.samples.grids[0].planned, 200'000U);
    EXPECT_EQ(report.samples_saved_factor(), 3.4);
}

TEST(LatencySummary, AMissedFrameIsShownAPeriodLaterByAModel) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        const bool late = index % 50 == 7;
        summary.add(example_frame(index));
        summary.add(example_gpu(index, late ? 11 : 4));  // due after 10
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.verdict, Verdict::RealTime);
    EXPECT_EQ(report.frames.missed, 2U);
    EXPECT_EQ(report.frames.periods_missed, 2U);
    EXPECT_EQ(report.missed_percent(), 2.0);
    EXPECT_EQ(report.gaze_age_at_display.min_ms, 18.0);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 28.0);
    EXPECT_EQ(row(report, Stage::Wait).max_ms, 9.0);
    EXPECT_TRUE(report.gaze_age_at_display.mixed());
    EXPECT_EQ(report.gaze_age_at_display
                  .frames_by_kind[static_cast<std::size_t>(time::StampKind::Modelled)],
              2U);
}

TEST(LatencySummary, ManyMissedFramesAreNotRealTime) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        summary.add(example_frame(index));
        summary.add(example_gpu(index, index < 6 ? 11 : 4));
    }
    EXPECT_EQ(summary.report().verdict, Verdict::NotRealTime);
}

TEST(LatencySummary, LongFrameIntervalsAreNotRealTime) {
    SummaryConfig config = kWallConfig;
    config.period_ns = 9 * kMs;
    LatencySummary summary(config);
    for (std::uint64_t index = 0; index < 100; ++index) {
        summary.add(example_frame(index));
    }
    EXPECT_EQ(summary.report().verdict, Verdict::NotRealTime);
}

TEST(LatencySummary, GivesNoVerdictWithoutADisplayPeriod) {
    LatencySummary summary({});
    summary.add(example_frame(0));
    summary.add(example_frame(1));
    summary.add(example_frame(2));
    EXPECT_EQ(summary.report().verdict, Verdict::Unknown);
}

TEST(LatencySummary, UnknownGpuTimesLeaveTheirShareUnaccounted) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        summary.add(example_frame(index));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frames.rendered, 100U);
    EXPECT_EQ(report.frames.in_time_unknown, 100U);
    EXPECT_EQ(report.missed_percent(), std::nullopt);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 18.0);
    EXPECT_EQ(row(report, Stage::Gpu).count, 0U);
    EXPECT_EQ(row(report, Stage::Gpu).max_ms, std::nullopt);
    EXPECT_EQ(row(report, Stage::Wait).count, 0U);
    EXPECT_EQ(report.unaccounted.mean_ms, 10.0);
    EXPECT_NEAR(share(report, time::StampKind::Unknown), 100.0 * 10 / 18, 1e-9);
}

TEST(LatencySummary, VirtualTimeUsesTheFramesOwnGpuStamps) {
    LatencySummary summary({.clock = LoopClock::Virtual, .period_ns = kExamplePeriodNs});
    for (std::uint64_t index = 0; index < 100; ++index) {
        frame::FrameRecord frame = example_frame(index, time::StampKind::Modelled);
        frame.stamps.gpu_begin = frame.stamps.submit;
        frame.stamps.gpu_end = {frame.stamps.submit.ns + 5 * kMs, time::StampKind::Modelled};
        summary.add(frame);
        summary.add(example_gpu(index, 100));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.verdict, Verdict::VirtualTime);
    EXPECT_EQ(report.frames.missed, 0U);
    EXPECT_EQ(row(report, Stage::Gpu).max_ms, 5.0);
    EXPECT_EQ(row(report, Stage::Switching).kind(), time::StampKind::Unknown);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 16.0);
    EXPECT_EQ(share(report, time::StampKind::Modelled), 100.0);
    EXPECT_EQ(report.passes[0].count, 100U);
}

TEST(LatencySummary, GazeThatNeverCameHasNoAge) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        frame::FrameRecord frame = example_frame(index);
        frame.fovea = {};
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(frames_in(report, gaze::FoveaState::Ahead), 100U);
    EXPECT_EQ(report.gaze_age_at_latch.count, 0U);
    EXPECT_EQ(report.gaze_age_at_display.count, 0U);
    EXPECT_EQ(report.share_by_kind_percent, std::nullopt);
    EXPECT_EQ(report.frame_interval.count, 99U);
}

TEST(LatencySummary, HeldGazeHasAnAgeOfItsOwn) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        frame::FrameRecord frame = example_frame(index);
        if (index >= 90) {
            set_state(frame, index < 95 ? gaze::FoveaState::Held : gaze::FoveaState::Returning,
                      gaze::LossReason::Invalid);
            for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
                eye.sampled.ns -= 100 * kMs;
            }
        } else if (index >= 80) {
            frame.fovea.eyes[1].state = gaze::FoveaState::OtherEye;
        }
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(frames_in(report, gaze::FoveaState::Tracking), 80U);
    EXPECT_EQ(frames_in(report, gaze::FoveaState::OtherEye), 10U);
    EXPECT_EQ(frames_in(report, gaze::FoveaState::Held), 5U);
    EXPECT_EQ(frames_in(report, gaze::FoveaState::Returning), 5U);
    EXPECT_EQ(report.gaze_age_at_display.count, 90U);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 18.0);
    EXPECT_EQ(report.held_gaze_age_at_display.count, 10U);
    EXPECT_EQ(report.held_gaze_age_at_display.min_ms, 118.0);
}

TEST(LatencySummary, TheEyeWithTheOlderSampleCounts) {
    LatencySummary summary(kWallConfig);
    frame::FrameRecord frame = example_frame(0);
    frame.fovea.eyes[1].sampled.ns -= 7 * kMs;
    summary.add(frame);
    EXPECT_EQ(summary.report().gaze_age_at_latch.max_ms, 12.0);
}

TEST(LatencySummary, FramesThatAreNotRenderedOnlyCount) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 10; ++index) {
        frame::FrameRecord frame = example_frame(index);
        frame.should_render = index != 3;
        summary.add(frame);
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frames.total, 10U);
    EXPECT_EQ(report.frames.rendered, 9U);
    EXPECT_EQ(report.gaze_age_at_latch.count, 9U);
    EXPECT_EQ(report.frame_interval.count, 9U);
    EXPECT_EQ(report.samples.pixels_output, 9U * 3400U);
}

TEST(LatencySummary, GapsInTheFrameNumbersAreNoIntervals) {
    LatencySummary summary(kWallConfig);
    summary.add(example_frame(0));
    summary.add(example_frame(1));
    summary.add(example_frame(9));
    summary.add(example_frame(10));
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frame_interval.count, 2U);
    EXPECT_EQ(report.frame_interval.max_ms, 10.0);
}

TEST(LatencySummary, JoinsGpuPartsThatComeLate) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        summary.add(example_frame(index));
        if (index >= 15) {
            summary.add(example_gpu(index - 15));
        }
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frames.rendered, 100U);
    EXPECT_EQ(row(report, Stage::Gpu).count, 85U);
}

TEST(LatencySummary, AGpuPartThatComesTooLateStillCountsForThePasses) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 17; ++index) {
        summary.add(example_frame(index));
    }
    summary.add(example_gpu(0));
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frames.rendered, 17U);
    EXPECT_EQ(row(report, Stage::Gpu).count, 0U);
    EXPECT_EQ(report.passes[0].count, 1U);
}

TEST(LatencySummary, AReportDoesNotEndTheGathering) {
    LatencySummary summary(kWallConfig);
    summary.add(example_frame(0));
    EXPECT_EQ(row(summary.report(), Stage::Gpu).count, 0U);
    summary.add(example_gpu(0));
    EXPECT_EQ(row(summary.report(), Stage::Gpu).count, 1U);
    EXPECT_EQ(summary.report().frames.rendered, 1U);
}

TEST(LatencySummary, PercentilesAreWithheldFromFewFrames) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 30; ++index) {
        summary.add(example_frame(index));
    }
    const DurationRow age = summary.report().gaze_age_at_latch;
    EXPECT_NE(age.p50_ms, std::nullopt);
    EXPECT_NE(age.p95_ms, std::nullopt);
    EXPECT_EQ(age.p99_ms, std::nullopt);
}

TEST(LatencySummary, DoesNotAllocateWhileItGathers) {
    LatencySummary summary(kWallConfig);
    const gaze::GazeSample sample;
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::uint64_t index = 0; index < 100; ++index) {
        summary.add(sample);
        summary.add(example_frame(index));
        summary.add(example_gpu(index));
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
}

TEST(LatencySummary, CountsSamples) {
    LatencySummary summary(kWallConfig);
    gaze::GazeSample sample;
    for (const std::uint64_t sequence : {1U, 2U, 5U}) {
        sample.sequence = sequence;
        summary.add(sample);
    }
    EXPECT_EQ(summary.report().gaze, (GazeCounts{.received = 3, .invalid = 3, .lost = 2}));
}

// The profile's times are those of its display, whatever a few announcements say.
TEST(LatencySummary, LetsTheCommonestPeriodDecideWhoseDisplayItIs) {
    const auto report = [](std::uint64_t odd_frames) {
        LatencySummary summary(kWallConfig);
        for (std::uint64_t index = 0; index < 100; ++index) {
            summary.add_display_period(index < odd_frames ? 16 * kMs : kExamplePeriodNs);
            summary.add(example_frame(index));
            summary.add(example_gpu(index));
        }
        return summary.report();
    };
    for (const std::uint64_t odd_frames : {0U, 1U, 20U}) {
        const SummaryReport ours = report(odd_frames);
        EXPECT_EQ(ours.config.period_ns, kExamplePeriodNs);
        EXPECT_EQ(ours.config.switching_ns, 2 * kMs);
        EXPECT_EQ(row(ours, Stage::Switching).count, 100U) << "of all frames alike";
        EXPECT_EQ(ours.gaze_age_at_display.min_ms, 18.0);
        EXPECT_EQ(ours.gaze_age_at_display.max_ms, 18.0);
    }
    const SummaryReport another = report(80);
    EXPECT_EQ(another.config.period_ns, 16 * kMs);
    EXPECT_EQ(another.config.switching_ns, std::nullopt);
    EXPECT_EQ(row(another, Stage::Switching).count, 0U);
    EXPECT_EQ(another.gaze_age_at_display.min_ms, 16.0);
    EXPECT_EQ(another.gaze_age_at_display.max_ms, 16.0);
    EXPECT_EQ(another.unaccounted.max_ms, 0.0);
    EXPECT_NEAR(share(another, time::StampKind::Profile), 100.0 * 3 / 16, 1e-9);
}

TEST(LatencySummary, KeepsUnknownDisplayTimesOutAndCountsThem) {
    LatencySummary summary(kWallConfig);
    for (std::uint64_t index = 0; index < 100; ++index) {
        frame::FrameRecord frame = example_frame(index);
        if (index < 30) {
            frame.stamps.display = {};
        }
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    const SummaryReport report = summary.report();
    EXPECT_EQ(report.frames.display_unknown, 30U);
    EXPECT_EQ(report.frames.in_time_unknown, 30U);
    EXPECT_EQ(report.gaze_age_at_display.count, 70U);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 18.0);
    EXPECT_EQ(report.gaze_age_at_latch.count, 100U);
}

TEST(LatencySummary, GathersWhatAUserShouldKnow) {
    LatencySummary summary(kWallConfig);
    summary.add_event({}, frame::kSessionEvent.name, "session state: FOCUSED");
    summary.add(example_frame(3));
    summary.add_event({35 * kMs, time::StampKind::Measured}, frame::kHeadLostEvent.name, "lost");
    const SummaryReport report = summary.report();
    ASSERT_EQ(report.happenings.size(), 1U);
    EXPECT_EQ(report.happenings[0].text.view(), "lost");
    EXPECT_EQ(report.began, example_frame(3).stamps.wake_up);
}

}  // namespace
}  // namespace gazeloop::latency
