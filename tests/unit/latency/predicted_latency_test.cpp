#include "runtime/latency/predicted_latency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

SummaryReport example_report(std::uint64_t frames, std::int64_t gpu_ms = 4) {
    LatencySummary summary(
        {.period_ns = kExamplePeriodNs, .switching_ns = 2 * kMs, .rolling_ns = 0});
    for (std::uint64_t index = 0; index < frames; ++index) {
        summary.add(example_frame(index));
        summary.add(example_gpu(index, gpu_ms));
    }
    return summary.report();
}

/// The examples' tracker: 3 ms to the host, which reads each sample up to 3 ms later.
constexpr TrackerFigures kTracker{
    .delay_ns = 3 * kMs, .uncertainty_ns = 0, .jitter_ns = 0, .rate_hz = 1000.0 / 3.0};

PartRange& at(PredictedLatency& predicted, Part part) {
    return predicted.parts[static_cast<std::size_t>(part)];
}
const PartRange& at(const PredictedLatency& predicted, Part part) {
    return predicted.parts[static_cast<std::size_t>(part)];
}

// Guenter et al. 2012, "Foveated 3D Graphics", section 4.1 and Figure 5. The tracker takes 7 ms at
// best, 10 at worst, its sampling among them. Rendering takes 8 ms, and 8 more where the event
// arrives just after a frame has begun. The scan-out of the fovea's 200 lines takes 2 ms at best;
// at worst the line just after it is being scanned, which takes a whole 8 ms. Pixels take 6 ms.
TEST(PredictedLatency, IsThatOfThePapersFigure5) {
    PredictedLatency paper;
    at(paper, Part::Tracker) = {7 * kMs, 10 * kMs};
    at(paper, Part::Delivery) = {0, 0};
    at(paper, Part::Sampling) = {0, 0};
    at(paper, Part::Phase) = {0, 8 * kMs};
    at(paper, Part::Loop) = {0, 0};
    at(paper, Part::Render) = {8 * kMs, 8 * kMs};
    at(paper, Part::Display) = {0, 0};
    at(paper, Part::Row) = {2 * kMs, 8 * kMs};
    at(paper, Part::Switching) = {6 * kMs, 6 * kMs};
    const PredictedSum sum = paper.eye_to_photon();
    EXPECT_EQ(sum.best_ns, 23 * kMs);
    EXPECT_EQ(sum.worst_ns, 40 * kMs);
    EXPECT_FALSE(sum.best_at_least);
    EXPECT_FALSE(sum.worst_at_least);
    EXPECT_EQ(paper.gaze_age().worst_ns, 32 * kMs);
}

TEST(PredictedLatency, IsMadeOfTheTrackerTheDisplayAndTheRun) {
    SummaryReport report = example_report(200);
    report.config.rolling_ns = 8 * kMs;
    const PredictedLatency predicted = predicted_latency(
        {.delay_ns = 20 * kMs, .uncertainty_ns = 5 * kMs, .jitter_ns = kMs, .rate_hz = 100.0},
        report);
    EXPECT_EQ(at(predicted, Part::Tracker).least_ns, 20 * kMs);
    EXPECT_EQ(at(predicted, Part::Tracker).greatest_ns, 20 * kMs);
    EXPECT_EQ(at(predicted, Part::Delivery).least_ns, 0);
    EXPECT_EQ(at(predicted, Part::Delivery).greatest_ns, 6'900'000);
    EXPECT_EQ(at(predicted, Part::Sampling).greatest_ns, 10 * kMs);
    EXPECT_EQ(at(predicted, Part::Phase).greatest_ns, 10 * kMs);
    EXPECT_EQ(at(predicted, Part::Render).least_ns, 4 * kMs);
    EXPECT_NEAR(static_cast<double>(*at(predicted, Part::Render).greatest_ns), 4e6, 8e3);
    EXPECT_EQ(at(predicted, Part::Display).least_ns, 0);
    EXPECT_EQ(at(predicted, Part::Display).greatest_ns, 10 * kMs);
    EXPECT_EQ(at(predicted, Part::Row).least_ns, -4 * kMs);
    EXPECT_EQ(at(predicted, Part::Row).greatest_ns, 4 * kMs);
    EXPECT_EQ(at(predicted, Part::Switching).least_ns, 2 * kMs);
    EXPECT_EQ(predicted.gaze_age().best_ns, (20 + 4 - 4 + 2) * kMs);
}

TEST(PredictedLatency, IsAtLeastSoMuchWhereFiguresAreUnknown) {
    const PredictedLatency nothing = predicted_latency({}, SummaryReport{});
    EXPECT_EQ(nothing.eye_to_photon().best_ns, 0);
    EXPECT_TRUE(nothing.eye_to_photon().best_at_least);
    EXPECT_TRUE(nothing.eye_to_photon().worst_at_least);

    const PredictedLatency known = predicted_latency(kTracker, example_report(200));
    EXPECT_FALSE(known.gaze_age().best_at_least);
    EXPECT_FALSE(known.gaze_age().worst_at_least);
    SummaryReport report = example_report(200);
    report.config.switching_ns.reset();
    EXPECT_TRUE(predicted_latency(kTracker, report).gaze_age().best_at_least);
}

TEST(PredictedLatency, KeepsToItsRangeWithAbsurdFigures) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    SummaryReport report = example_report(200);
    report.config.rolling_ns = kMost;
    report.config.period_ns = kMost;
    const PredictedLatency predicted = predicted_latency(
        {.delay_ns = kMost, .uncertainty_ns = kMost, .jitter_ns = kMost, .rate_hz = 1e-300},
        report);
    EXPECT_EQ(predicted.eye_to_photon().worst_ns, kMost);
    EXPECT_EQ(at(predicted_latency({.rate_hz = std::numeric_limits<double>::infinity()}, report),
                 Part::Sampling)
                  .greatest_ns,
              0);
    for (const double rate_hz : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_FALSE(
            at(predicted_latency({.rate_hz = rate_hz}, report), Part::Sampling).greatest_ns);
    }
}

TEST(PredictionCheck, FindsAMeasuredAgeInItsRange) {
    // 3 tracker, 2 of at most 3 queue, 1 submit, 4 GPU, 6 of at most 10 wait, 2 switching.
    const PredictionCheck check = check_prediction(kTracker, example_report(200));
    EXPECT_TRUE(check.comparable);
    EXPECT_THAT(check.unknown, IsEmpty());
    EXPECT_THAT(check.outside, IsEmpty());
    EXPECT_EQ(check.predicted.gaze_age().best_ns, 9 * kMs);
}

TEST(PredictionCheck, NamesThePercentileAndThePartThatLieOutside) {
    // Every tenth frame is ready long before it is shown.
    LatencySummary summary(
        {.period_ns = kExamplePeriodNs, .switching_ns = 2 * kMs, .rolling_ns = 0});
    for (std::uint64_t index = 0; index < 1000; ++index) {
        frame::FrameRecord frame = example_frame(index);
        frame.stamps.display.ns += index % 10 == 0 ? 20 * kMs : 0;
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    const PredictionCheck check = check_prediction(kTracker, summary.report());
    ASSERT_EQ(check.outside.size(), 3U);
    EXPECT_EQ(check.outside[0].what, "p95");
    EXPECT_EQ(check.outside[1].what, "p99");
    EXPECT_EQ(check.outside[2].what, "max");
    for (const OutsidePrediction& outside : check.outside) {
        EXPECT_TRUE(outside.above);
        EXPECT_EQ(outside.part, Part::Display);
        EXPECT_NEAR(outside.part_measured_ms, 26.0, 0.1);
        EXPECT_NEAR(outside.part_limit_ms, 10.0, 1e-9);
        EXPECT_NEAR(outside.measured_ms, 38.0, 0.1);
        EXPECT_NEAR(outside.limit_ms, 22.0, 0.1);
    }
}

TEST(PredictionCheck, FindsAgesThatArePredictedToBeGreater) {
    const PredictionCheck check = check_prediction(
        {.delay_ns = 30 * kMs, .uncertainty_ns = 0, .jitter_ns = 0, .rate_hz = 300.0},
        example_report(200));
    ASSERT_EQ(check.outside.size(), 5U);
    EXPECT_FALSE(check.outside.front().above);
    EXPECT_EQ(check.outside.front().part, Part::Tracker);
    EXPECT_NEAR(check.outside.front().part_limit_ms, 30.0, 1e-9);
}

TEST(PredictionCheck, JudgesNoWorstCaseOfWhichAPartIsUnknown) {
    const PredictionCheck check = check_prediction({}, example_report(200));
    EXPECT_FALSE(check.comparable);
    EXPECT_THAT(check.unknown, ElementsAre(Part::Tracker, Part::Delivery, Part::Sampling));
    EXPECT_THAT(check.outside, IsEmpty());
}

// Measured ages leave them out as well.
TEST(PredictionCheck, NeedsNoRowsAndNoSwitchingOfADisplayThatStatesNone) {
    LatencySummary summary({.period_ns = kExamplePeriodNs});
    for (std::uint64_t index = 0; index < 50; ++index) {
        summary.add(example_frame(index));
        summary.add(example_gpu(index));
    }
    EXPECT_TRUE(check_prediction(kTracker, summary.report()).comparable);
}

TEST(PredictionCheck, SaysNothingOfNoFrames) {
    const PredictionCheck check = check_prediction(kTracker, LatencySummary({}).report());
    EXPECT_FALSE(check.comparable);
    EXPECT_THAT(check.outside, IsEmpty());
}

}  // namespace
}  // namespace gazeloop::latency
