#include "drivers/simulated/simulated_source.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "sim/gaze_generator.h"
#include "tests/support/allocation_counter.h"

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kStart_ns = 5'000'000'000;

sim::GazeSimulation bad_tracker(std::uint64_t seed) {
    return {.seed = seed,
            .tracker = {.delay_ms = 15.0,
                        .jitter_ms = 3.0,
                        .bias_deg = 0.4,
                        .noise_deg = 0.2,
                        .dropout_percent = 5.0,
                        .eye_loss_percent = 5.0,
                        .dropout_ms = 30.0}};
}

TEST(SimulatedSource, GivesTheTracesSamples) {
    const sim::GazeSimulation simulation = bad_tracker(7);
    const gaze::GazeTrace trace = sim::generate_gaze(simulation, 5.0);
    SimulatedSource source(simulation, kStart_ns);
    std::vector<gaze::GazeSample> samples;
    source.poll(kStart_ns + 6'000'000'000, samples);
    ASSERT_GT(samples.size(), trace.samples.size());
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        EXPECT_EQ(samples[i].sequence, trace.samples[i].sequence);
        EXPECT_EQ(samples[i].sampled.ns, kStart_ns + trace.samples[i].sampled.ns);
        EXPECT_EQ(samples[i].arrived.ns, kStart_ns + trace.samples[i].arrived.ns);
        EXPECT_EQ(samples[i].eyes[0].direction, trace.samples[i].eyes[0].direction);
    }
}

TEST(SimulatedSource, HandsOverWhatHasArrivedAndNothingElse) {
    SimulatedSource source({.tracker = {.rate_hz = 100.0, .delay_ms = 25.0}}, kStart_ns);
    std::vector<gaze::GazeSample> samples;
    source.poll(kStart_ns + 24'999'999, samples);
    EXPECT_TRUE(samples.empty());
    source.poll(kStart_ns + 25'000'000, samples);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].sampled.ns, kStart_ns);
    source.poll(kStart_ns, samples);
    EXPECT_EQ(samples.size(), 1U) << "time may go back";
    source.poll(kStart_ns + 45'000'000, samples);
    EXPECT_EQ(samples.size(), 3U);
    EXPECT_FALSE(source.finished());
}

TEST(SimulatedSource, KnowsTheHeadAtAnyTime) {
    SimulatedSource source({.seed = 3}, kStart_ns);
    ASSERT_NE(source.head_track(), nullptr);
    // Also ahead of what was polled: a frame is planned for a later time than its gaze's.
    const gaze::Pose later = source.head_track()->at(kStart_ns + 2'000'000'000);
    std::vector<gaze::GazeSample> samples;
    source.poll(kStart_ns + 3'000'000'000, samples);
    for (const gaze::GazeSample& sample : samples) {
        ASSERT_TRUE(sample.head.has_value());
        const gaze::Pose head = source.head_track()->at(sample.sampled.ns);
        EXPECT_LT(glm::length(head.position_m - sample.head->position_m), 1e-9);
        EXPECT_NEAR(std::abs(glm::dot(head.orientation, sample.head->orientation)), 1.0, 1e-12);
    }
    EXPECT_EQ(source.head_track()->at(kStart_ns + 2'000'000'000).orientation, later.orientation);
    EXPECT_EQ(source.head_track()->at(kStart_ns - 1).orientation,
              source.head_track()->at(kStart_ns).orientation);
    SimulatedSource still({.head = {.sway_deg = 0.0, .turn_percent = 0.0}}, kStart_ns);
    EXPECT_EQ(still.head_track(), nullptr);
}

TEST(SimulatedSource, TellsTheTruth) {
    SimulatedSource source(bad_tracker(9), kStart_ns);
    sim::Person person({}, {}, 9);
    const sim::TrueGaze truth = source.truth_at(kStart_ns + 1'500'000'000);
    EXPECT_EQ(truth.eyes[0].direction, person.at(1.5).eyes[0].direction);
}

// What a frame loop asks of it, at 90 Hz for nine minutes, with everything on.
TEST(SimulatedSource, AsksForNoMemoryWhileALoopRuns) {
    sim::GazeSimulation simulation = bad_tracker(3);
    simulation.eye.pursuit_percent = 20.0;
    simulation.eye.distance_spread = 0.3;
    SimulatedSource source(simulation, kStart_ns);
    std::vector<gaze::GazeSample> samples;
    samples.reserve(100);
    constexpr std::int64_t kFrame_ns = 11'111'111;
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::int64_t frame = 1; frame < 540LL * 90; ++frame) {
        samples.clear();
        source.poll(kStart_ns + frame * kFrame_ns, samples);
        (void)source.head_track()->at(kStart_ns + (frame + 3) * kFrame_ns);
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
}

TEST(SimulatedSource, TakesTimesAtTheEndsOfTheirRange) {
    constexpr auto kEnd = std::numeric_limits<std::int64_t>::max();
    constexpr auto kBegin = std::numeric_limits<std::int64_t>::min();
    SimulatedSource last(bad_tracker(1), kEnd - 1'000'000'000);
    std::vector<gaze::GazeSample> samples;
    last.poll(kEnd, samples);
    EXPECT_TRUE(last.finished());
    EXPECT_GT(samples.size(), 100U);
    (void)last.head_track()->at(kEnd);

    SimulatedSource first(bad_tracker(1), kBegin);
    std::vector<gaze::GazeSample> early;
    first.poll(kBegin + 1'000'000'000, early);
    ASSERT_GT(early.size(), 100U);
    EXPECT_EQ(early[0].sampled.ns, kBegin + 0);
    EXPECT_EQ(early[0].eyes[0].direction, samples[0].eyes[0].direction);
}

}  // namespace
}  // namespace gazeloop::drivers
