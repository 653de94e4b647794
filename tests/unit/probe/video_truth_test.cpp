// What the camera's part of the probe says of simulated set-ups, against what was simulated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "runtime/probe/video_result.h"
#include "tests/support/simulated_camera.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint32_t kSize = 100;

probe::VideoResult measured(const CameraModel& camera, const LampAndDisplay& set_up,
                            const Truth& truth, std::uint64_t seed) {
    probe::LightSeries series;
    SimulatedCamera simulated(camera, set_up, truth, seed);
    for (std::size_t frame = 0; frame < simulated.frames(); ++frame) {
        const auto [lamp, patch] = simulated.next();
        series.add(static_cast<float>(lamp), static_cast<float>(patch));
    }
    const auto row = [](double share) { return static_cast<std::uint32_t>(share * kSize); };
    const auto result = probe::measure_series(
        {.frames = {},
         .camera_fps = camera.fps,
         .readout_ms = camera.readout_s * 1e3,
         .lamp = {.x = 0, .y = row(camera.lamp_row), .width = 10, .height = 2},
         .patch = {.x = 50, .y = row(camera.patch_row), .width = 10, .height = 2}},
        series, kSize, kSize);
    EXPECT_TRUE(result.has_value()) << result.error().message;
    return result.value_or(probe::VideoResult{});
}

struct Scenario {
    std::string name;
    CameraModel camera;
    LampAndDisplay display;
};

class VideoTruth : public testing::TestWithParam<Scenario> {};

// The mean over 20 flashes lies within half a camera frame of the truth.
TEST_P(VideoTruth, MeansLieWithinHalfACameraFrame) {
    const Scenario& set_up = GetParam();
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        sim::Random random(seed, sim::Stream::Targets);
        const Truth truth = switch_lamp(set_up.display, 20, random);
        const probe::VideoResult result = measured(set_up.camera, set_up.display, truth, seed);
        ASSERT_EQ(result.on.trials, 20U) << seed;
        ASSERT_EQ(result.off.trials, 20U) << seed;
        EXPECT_EQ(result.patch.pulsed, set_up.display.lit_s > 0.0);
        EXPECT_FALSE(result.lamp.pulsed);
        for (const auto& [delays, on] :
             {std::pair{&result.on, true}, std::pair{&result.off, false}}) {
            const double error_ms = *delays->mean_ms - truth.mean_ms(on);
            EXPECT_LT(std::abs(error_ms), 500.0 / set_up.camera.fps) << seed << on;
            worst = std::max(worst, std::abs(error_ms) * set_up.camera.fps / 1e3);
        }
    }
    RecordProperty("worst_frames", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(
    SetUps, VideoTruth,
    testing::Values(
        Scenario{"Pulsed240", {.fps = 240}, {}}, Scenario{"Pulsed480", {.fps = 480}, {}},
        Scenario{"Pulsed1000", {.fps = 1000}, {}},
        Scenario{"Pulsed1000Short", {.fps = 1000, .exposure = 0.9}, {.lit_s = 0.0005}},
        Scenario{"Steady240", {.fps = 240}, {.lit_s = 0.0}},
        Scenario{"Steady240ShortExposure", {.fps = 240, .exposure = 0.25}, {.lit_s = 0.0}},
        Scenario{"Steady480Ramp", {.fps = 480}, {.lit_s = 0.0, .ramp_s = 0.008}},
        Scenario{"Steady1000Ramp", {.fps = 1000}, {.lit_s = 0.0, .ramp_s = 0.012}},
        Scenario{"Noise240", {.fps = 240, .noise = 0.03}, {}},
        Scenario{"NoiseSteady1000", {.fps = 1000, .noise = 0.02}, {.lit_s = 0.0, .ramp_s = 0.004}},
        Scenario{"Flicker240", {.fps = 240, .flicker = 0.04}, {}},
        Scenario{"FlickerSteady480", {.fps = 480, .flicker = 0.04}, {.lit_s = 0.0}},
        Scenario{"FlickerSteady1000", {.fps = 1000, .flicker = 0.04}, {.lit_s = 0.0}},
        Scenario{
            "Rolling240", {.fps = 240, .readout_s = 0.004, .lamp_row = 0.1, .patch_row = 0.8}, {}},
        Scenario{"Saturated240", {.fps = 240, .dark = 0.1, .bright = 1.0}, {.lit_s = 0.0}},
        Scenario{"Faint480", {.fps = 480, .noise = 0.001, .dark = 0.01, .bright = 0.03}, {}},
        Scenario{"Display60Steady", {.fps = 240}, {.period_s = 1.0 / 60.0, .lit_s = 0.0}},
        Scenario{"Display120", {.fps = 240}, {.period_s = 1.0 / 119.88, .lit_s = 0.001}}),
    [](const testing::TestParamInfo<Scenario>& one) { return one.param.name; });

/// In how many of `runs` measurements the mean delay of the set-up, over all moments at which a
/// lamp may be switched, lies within the stated uncertainty.
double covered(const Scenario& scenario, int flashes, int runs) {
    int within = 0;
    const LampAndDisplay& display = scenario.display;
    const double truth_ms =
        1e3 * (display.tracker_s + 0.5 * display.period_s + 0.5 * display.ramp_s);
    for (int run = 1; run <= runs; ++run) {
        const auto seed = static_cast<std::uint64_t>(run);
        sim::Random random(seed, sim::Stream::Targets);
        const Truth truth = switch_lamp(scenario.display, flashes, random);
        const probe::VideoResult result = measured(scenario.camera, scenario.display, truth, seed);
        within += std::abs(*result.on.mean_ms - truth_ms) <= *result.on.uncertain_ms() ? 1 : 0;
    }
    return static_cast<double>(within) / runs;
}

// Binomial: at 95 % of 400 runs, three standard errors are 3.3 %.
TEST(VideoUncertainty, CoversTheTruthInTheStatedShare) {
    const double share = covered({"", {.fps = 240, .noise = 0.01}, {}}, 20, 400);
    RecordProperty("share_240", std::to_string(share));
    EXPECT_GE(share, 0.917);
    EXPECT_LE(share, 0.983);
    const double fast =
        covered({"", {.fps = 1000, .noise = 0.01}, {.lit_s = 0.0, .ramp_s = 0.004}}, 10, 400);
    RecordProperty("share_1000", std::to_string(fast));
    EXPECT_GE(fast, 0.917);
    EXPECT_LE(fast, 0.983);
}

// Where all trials scatter less than a frame, a frame over sqrt(trials) is stated.
TEST(VideoUncertainty, IsNeverBelowAFrameOverRootN) {
    const std::vector<double> same(16, 42.0);
    const auto delays = probe::delay_statistics(same, {.frame_ms = 4.0});
    EXPECT_DOUBLE_EQ(*delays.uncertain_ms(), 1.0);
    EXPECT_DOUBLE_EQ(*delays.sd_ms, 0.0);
}

TEST(VideoUncertainty, HoldsTheStatedErrorOfTheCamerasRate) {
    const std::vector<double> delays_ms{40.0, 44.0};
    const auto delays =
        probe::delay_statistics(delays_ms, {.frame_ms = 1.0, .rate_percent = 0.5, .fixed_ms = 0.3});
    const double scatter = 12.706205 * std::sqrt(8.0) / std::numbers::sqrt2;
    EXPECT_NEAR(*delays.uncertain_ms(), scatter + 0.21 + 0.3, 1e-9);
}

TEST(DelayStatistics, WithholdsWhatIsUnknown) {
    const auto none = probe::delay_statistics({}, {.frame_ms = 1.0});
    EXPECT_EQ(none.trials, 0U);
    EXPECT_FALSE(none.mean_ms || none.min_ms || none.uncertain_ms());
    const std::vector<double> one{40.0};
    const auto single = probe::delay_statistics(one, {.frame_ms = 1.0});
    EXPECT_EQ(single.mean_ms, 40.0);
    EXPECT_FALSE(single.sd_ms || single.p50_ms || single.uncertain_ms());
    std::vector<double> many(19, 1.0);
    EXPECT_EQ(probe::delay_statistics(many, {}).p50_ms, 1.0);
    EXPECT_FALSE(probe::delay_statistics(many, {}).p95_ms);
    many.push_back(9.0);
    EXPECT_EQ(probe::delay_statistics(many, {}).p95_ms, 1.0);
    EXPECT_EQ(probe::delay_statistics(many, {}).max_ms, 9.0);
}

TEST(DelayStatistics, StudentsTIsThatOfTheTables) {
    // Abramowitz and Stegun, table 26.10.
    EXPECT_NEAR(probe::student_t_975(1), 12.706, 1e-3);
    EXPECT_NEAR(probe::student_t_975(2), 4.303, 1e-3);
    EXPECT_NEAR(probe::student_t_975(3), 3.182, 1e-2);
    EXPECT_NEAR(probe::student_t_975(5), 2.571, 1e-3);
    EXPECT_NEAR(probe::student_t_975(19), 2.093, 1e-3);
    EXPECT_NEAR(probe::student_t_975(1'000'000'000'000), 1.960, 1e-3);
}

}  // namespace
}  // namespace gazeloop::tests
