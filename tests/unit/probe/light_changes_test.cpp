#include "runtime/probe/light_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "runtime/probe/trials.h"
#include "sim/random.h"

namespace gazeloop::probe {
namespace {

using testing::HasSubstr;

LightSeries series_of(const std::vector<double>& patch) {
    LightSeries series;
    for (const double brightness : patch) {
        series.add(0.0F, static_cast<float>(brightness));
    }
    return series;
}

/// Frames at 100 fps: least state 4 frames.
Expected<LightChanges> changes(const std::vector<double>& patch) {
    return find_changes(series_of(patch), Light::Patch, 100.0);
}

std::vector<double> frames(std::initializer_list<std::pair<int, double>> parts) {
    std::vector<double> all;
    for (const auto& [count, brightness] : parts) {
        all.insert(all.end(), static_cast<std::size_t>(count), brightness);
    }
    return all;
}

TEST(LightChanges, TellPartsOfAFrame) {
    const auto found = changes(frames({{20, 0.1}, {1, 0.3}, {20, 0.9}, {1, 0.7}, {20, 0.1}}));
    ASSERT_TRUE(found.has_value()) << found.error().message;
    ASSERT_EQ(found->changes.size(), 2U);
    EXPECT_TRUE(found->changes[0].on);
    EXPECT_NEAR(found->changes[0].frame, 20.75, 1e-3);
    EXPECT_FALSE(found->changes[1].on);
    EXPECT_NEAR(found->changes[1].frame, 41.75, 1e-3);
    EXPECT_FALSE(found->pulsed);
    EXPECT_NEAR(found->levels.dark, 0.1, 1e-3);
    EXPECT_NEAR(found->levels.bright, 0.9, 1e-3);
}

TEST(LightChanges, StatesAtTheVideosEndsAreNone) {
    const auto found = changes(frames({{20, 0.9}, {20, 0.1}, {20, 0.9}}));
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(found->changes.size(), 2U);
    EXPECT_FALSE(found->changes[0].on);
    EXPECT_NEAR(found->changes[0].frame, 20.0, 1e-3);
    EXPECT_TRUE(found->changes[1].on);
    EXPECT_NEAR(found->changes[1].frame, 40.0, 1e-3);
}

TEST(LightChanges, FlashesAreCountedAndLeftOut) {
    const auto found = changes(frames({{20, 0.1}, {2, 0.9}, {20, 0.1}, {10, 0.9}, {20, 0.1}}));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->glitches, 1U);
    ASSERT_EQ(found->changes.size(), 2U);
    EXPECT_NEAR(found->changes[0].frame, 42.0, 1e-3);
}

TEST(LightChanges, OnlyFlashesAreRefused) {
    const auto found = changes(frames({{20, 0.1}, {2, 0.9}, {20, 0.1}}));
    ASSERT_FALSE(found.has_value());
    EXPECT_THAT(found.error().message, HasSubstr("never stays changed for 40 ms (1 flashes in 42"));
}

TEST(LightChanges, APulsedLightEndsWhereItsNextPulseWouldBe) {
    std::vector<double> light(20, 0.0);
    for (int pulse = 0; pulse < 10; ++pulse) {
        light.insert(light.end(), {0.8, 0.0, 0.0});
    }
    light.resize(light.size() + 20, 0.0);
    const auto found = changes(light);
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->pulsed);
    EXPECT_NEAR(*found->pulse_period_frames, 3.0, 1e-6);
    ASSERT_EQ(found->changes.size(), 2U);
    EXPECT_NEAR(found->changes[0].frame, 20.5, 1e-6);
    EXPECT_NEAR(found->changes[1].frame, 50.5, 1e-6);
}

TEST(LightChanges, NoLightIsSwitchedInNoiseFlickerOrNothing) {
    sim::Random random(3, sim::Stream::Noise);
    std::vector<double> noise;
    std::vector<double> flicker;
    for (int i = 0; i < 5000; ++i) {
        noise.push_back(0.5 + 0.05 * random.normal());
        flicker.push_back(0.5 + 0.2 * std::sin(2.1 * i));
    }
    for (const auto& light :
         {noise, flicker, std::vector<double>(500, 0.0), std::vector<double>(500, 1.0),
          std::vector<double>{}, std::vector<double>{0.5}}) {
        const auto found = changes(light);
        ASSERT_FALSE(found.has_value());
        EXPECT_EQ(found.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(found.error().message, HasSubstr("--patch: its brightness"));
    }
}

TEST(LightChanges, AbsurdFrameRatesEndWell) {
    const std::vector<double> light = frames({{20, 0.1}, {20, 0.9}, {20, 0.1}});
    for (const double fps : {1e-300, 1.0, 1e6, 1e300, std::numeric_limits<double>::infinity()}) {
        const auto found = find_changes(series_of(light), Light::Patch, fps);
        if (found) {
            for (const LightChange& change : found->changes) {
                EXPECT_TRUE(std::isfinite(change.frame));
            }
        }
    }
}

TEST(LightSeries, ReadsBackMoreThanABlock) {
    LightSeries series;
    for (int i = 0; i < 10'000; ++i) {
        series.add(static_cast<float>(i), static_cast<float>(-i));
        if (i == 5000) {
            EXPECT_EQ(series.at(Light::Lamp, 17), 17.0);  // read amid writing
        }
    }
    EXPECT_EQ(series.size(), 10'000U);
    for (const std::size_t frame : {0U, 4095U, 4096U, 9999U, 1U}) {
        EXPECT_EQ(series.at(Light::Lamp, frame), static_cast<double>(frame));
        EXPECT_EQ(series.at(Light::Patch, frame), -static_cast<double>(frame));
    }
}

TEST(Trials, UnpairedChangesAreCounted) {
    const std::vector<LightChange> lamp{
        {true, 100.0}, {false, 200.0}, {true, 300.0}, {false, 400.0}};
    // A blink before the first flash; the second one is not followed until the lamp is off again.
    const std::vector<LightChange> patch{{true, 20.0},   {false, 40.0}, {true, 110.5},
                                         {false, 230.0}, {true, 405.0}, {false, 420.0}};
    const PairedChanges paired = pair_changes(lamp, patch);
    ASSERT_EQ(paired.trials.size(), 3U);
    EXPECT_DOUBLE_EQ(paired.trials[0].delay_frames(), 10.5);
    EXPECT_TRUE(paired.trials[0].on);
    EXPECT_DOUBLE_EQ(paired.trials[1].delay_frames(), 30.0);
    EXPECT_DOUBLE_EQ(paired.trials[2].delay_frames(), 20.0);
    EXPECT_FALSE(paired.trials[2].on);
    EXPECT_EQ(paired.lamp_alone, 1U);
    EXPECT_EQ(paired.patch_alone, 3U);
}

TEST(Trials, ABlinkAmidAFlashLeavesTheFirstAnswer) {
    const std::vector<LightChange> lamp{{true, 100.0}};
    const std::vector<LightChange> patch{{true, 110.0}, {false, 130.0}, {true, 140.0}};
    const PairedChanges paired = pair_changes(lamp, patch);
    ASSERT_EQ(paired.trials.size(), 1U);
    EXPECT_DOUBLE_EQ(paired.trials[0].delay_frames(), 10.0);
    EXPECT_EQ(paired.patch_alone, 2U);
    EXPECT_EQ(pair_changes({}, patch).patch_alone, 3U);
    EXPECT_EQ(pair_changes(lamp, {}).lamp_alone, 1U);
}

}  // namespace
}  // namespace gazeloop::probe
