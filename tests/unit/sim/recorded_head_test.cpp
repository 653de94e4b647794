// The simulated person beside people who were recorded in a headset: printed, and held to the same
// order of magnitude (three people say no more).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/trace/read_trace.h"
#include "sim/gaze_generator.h"
#include "tests/support/recorded_data.h"
#include "tests/unit/sim/statistics.h"

namespace gazeloop::sim {
namespace {

using namespace tests;

struct Speeds {
    std::vector<double> head_yaw;       ///< deg/s
    std::vector<double> gaze_in_world;  ///< deg/s
    double blink_percent = 0.0;         ///< samples without a valid eye
};

Speeds speeds_of(const gaze::GazeTrace& trace) {
    Speeds speeds;
    double invalid = 0.0;
    for (std::size_t i = 1; i < trace.samples.size(); ++i) {
        const gaze::GazeSample& a = trace.samples[i - 1];
        const gaze::GazeSample& b = trace.samples[i];
        const double seconds = static_cast<double>(b.sampled.ns - a.sampled.ns) * 1e-9;
        invalid += b.eyes[0].valid || b.eyes[1].valid ? 0.0 : 1.0;
        if (!a.head || !b.head || seconds <= 0.0 || seconds > 0.05) {
            continue;
        }
        const auto yaw_deg = [](const gaze::Pose& head) {
            const glm::dvec3 ahead = head.orientation * glm::dvec3{0.0, 0.0, -1.0};
            return glm::degrees(std::atan2(ahead.x, -ahead.z));
        };
        speeds.head_yaw.push_back(
            std::abs(std::remainder(yaw_deg(*b.head) - yaw_deg(*a.head), 360.0)) / seconds);
        if (a.eyes[0].valid && b.eyes[0].valid) {
            speeds.gaze_in_world.push_back(angle_deg(a.head->orientation * a.eyes[0].direction,
                                                     b.head->orientation * b.eyes[0].direction) /
                                           seconds);
        }
    }
    speeds.blink_percent = 100.0 * invalid / static_cast<double>(trace.samples.size());
    return speeds;
}

void print(const std::string& name, const Speeds& speeds) {
    std::printf(
        "%-34s head yaw p50 %6.1f p95 %6.1f max %6.1f   gaze in world p50 %6.1f p95 %6.1f deg/s"
        "   not valid %5.1f %%\n",
        name.c_str(), median(speeds.head_yaw), quantile(speeds.head_yaw, 0.95),
        quantile(speeds.head_yaw, 1.0), median(speeds.gaze_in_world),
        quantile(speeds.gaze_in_world, 0.95), speeds.blink_percent);
}

TEST(RecordedHeads, MoveAsTheSimulatedOneDoes) {
    const std::string name = "traces/htc_vive_pro";
    if (const std::string missing = gazeloop::tests::no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const std::filesystem::path folder = gazeloop::tests::recorded_data(name);
    const Speeds simulated =
        speeds_of(generate_gaze({.tracker = {.rate_hz = 125.0, .noise_deg = 0.135}}, 300.0));
    print("simulated, 125 Hz", simulated);
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".csv") {
            continue;
        }
        const auto trace = drivers::read_trace(entry.path().string());
        ASSERT_TRUE(trace.has_value()) << trace.error().message;
        const Speeds recorded = speeds_of(*trace);
        print(entry.path().filename().string(), recorded);
        const double ratio = quantile(simulated.head_yaw, 0.95) / quantile(recorded.head_yaw, 0.95);
        EXPECT_GT(ratio, 1.0 / 3.0) << entry.path();
        EXPECT_LT(ratio, 3.0) << entry.path();
        ++compared;
    }
    EXPECT_GT(compared, 0U) << folder << " is there and holds nothing";
}

}  // namespace
}  // namespace gazeloop::sim
