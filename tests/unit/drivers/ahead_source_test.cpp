// What is computed ahead is what the source itself gives, at each poll.
#include "drivers/simulated/ahead_source.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "drivers/simulated/simulated_source.h"

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kStart_ns = 7'000'000'000;

sim::GazeSimulation simulation(double rate_hz) {
    sim::GazeSimulation simulation;
    simulation.tracker.rate_hz = rate_hz;
    simulation.tracker.delay_ms = 3.0;
    simulation.tracker.jitter_ms = 2.0;
    simulation.tracker.noise_deg = 0.2;
    simulation.tracker.dropout_percent = 2.0;
    return simulation;
}

class AheadSourceAt : public testing::TestWithParam<double> {};

/// Steps of a frame, of nothing and of pauses longer than what is ready, with time in between for
/// the thread to come first, and without.
TEST_P(AheadSourceAt, GivesTheSameSamplesAtTheSamePolls) {
    SimulatedSource plain(simulation(GetParam()), kStart_ns);
    AheadSource ahead(std::make_unique<SimulatedSource>(simulation(GetParam()), kStart_ns));
    EXPECT_EQ(ahead.description(), plain.description());
    std::int64_t now_ns = kStart_ns;
    std::size_t samples = 0;
    for (int poll = 0; poll < 300; ++poll) {
        now_ns += poll % 50 == 49 ? 1'300'000'000 : poll % 7 == 3 ? 0 : 8'000'000;
        if (poll % 20 == 10) {
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
        std::vector<gaze::GazeSample> of_plain;
        std::vector<gaze::GazeSample> of_ahead;
        plain.poll(now_ns, of_plain);
        ahead.poll(now_ns, of_ahead);
        ASSERT_EQ(of_ahead.size(), of_plain.size()) << "poll " << poll;
        for (std::size_t i = 0; i < of_plain.size(); ++i) {
            ASSERT_EQ(of_ahead[i].sequence, of_plain[i].sequence);
            ASSERT_EQ(of_ahead[i].arrived.ns, of_plain[i].arrived.ns);
            ASSERT_EQ(of_ahead[i].eyes[0].direction, of_plain[i].eyes[0].direction);
        }
        samples += of_plain.size();
        ASSERT_FALSE(ahead.finished());
    }
    EXPECT_GT(samples, 100U);
}

INSTANTIATE_TEST_SUITE_P(Rates, AheadSourceAt, testing::Values(30.0, 200.0, 10'000.0));

}  // namespace
}  // namespace gazeloop::drivers
