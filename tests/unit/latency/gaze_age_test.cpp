#include "runtime/latency/gaze_age.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace gazeloop::latency {
namespace {

constexpr std::int64_t kPeriodNs = 10'000'000;

Stamp measured(std::int64_t ns) { return {ns, StampKind::Measured}; }

const Span& stage(const GazeAge& age, Stage stage) {
    return age.stages[static_cast<std::size_t>(stage)];
}

TEST(Weaker, PicksTheLessCertainKind) {
    const std::array order{StampKind::Measured, StampKind::Profile, StampKind::Modelled,
                           StampKind::Predicted, StampKind::Unknown};
    for (std::size_t better = 0; better < order.size(); ++better) {
        for (std::size_t worse = better; worse < order.size(); ++worse) {
            EXPECT_EQ(weaker(order[better], order[worse]), order[worse]);
            EXPECT_EQ(weaker(order[worse], order[better]), order[worse]);
        }
    }
}

TEST(Between, DoesNotWrapAround) {
    const Stamp least = measured(std::numeric_limits<std::int64_t>::min());
    const Stamp greatest = measured(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(between(least, greatest).ns, greatest.ns);
    EXPECT_EQ(between(greatest, least).ns, least.ns);
    EXPECT_EQ(between(measured(3), measured(1)), (Span{-2, StampKind::Measured}));
    EXPECT_FALSE(between(measured(3), Stamp{}).known());
}

TEST(ShownFrame, IsShownWhenAnnouncedIfTheGpuWasInTime) {
    FrameStamps stamps;
    stamps.display = {100, StampKind::Predicted};
    stamps.gpu_end = measured(100);
    const ShownFrame shown = shown_frame(stamps, kPeriodNs);
    EXPECT_EQ(shown.at, stamps.display);
    EXPECT_EQ(shown.periods_missed, 0U);
    EXPECT_TRUE(shown.in_time_known);
}

TEST(ShownFrame, IsShownAtTheNextPeriodAfterALateEnd) {
    FrameStamps stamps;
    stamps.display = {100, StampKind::Predicted};
    struct Case {
        std::int64_t late_ns;
        std::uint64_t periods;
    };
    for (const auto& [late_ns, periods] :
         {Case{1, 1}, Case{kPeriodNs, 1}, Case{kPeriodNs + 1, 2}, Case{5 * kPeriodNs, 5}}) {
        stamps.gpu_end = measured(stamps.display.ns + late_ns);
        const ShownFrame shown = shown_frame(stamps, kPeriodNs);
        EXPECT_EQ(shown.periods_missed, periods);
        EXPECT_EQ(shown.at, (Stamp{100 + static_cast<std::int64_t>(periods) * kPeriodNs,
                                   StampKind::Modelled}));
    }
}

TEST(ShownFrame, AnUnknownEndLeavesTheAnnouncedTime) {
    FrameStamps stamps;
    stamps.display = {100, StampKind::Predicted};
    const ShownFrame shown = shown_frame(stamps, kPeriodNs);
    EXPECT_EQ(shown.at, stamps.display);
    EXPECT_FALSE(shown.in_time_known);
}

TEST(ShownFrame, ALateEndWithoutAPeriodIsShownNobodyKnowsWhen) {
    FrameStamps stamps;
    stamps.display = measured(100);
    stamps.gpu_end = measured(101);
    const ShownFrame shown = shown_frame(stamps, 0);
    EXPECT_FALSE(shown.at.known());
    EXPECT_EQ(shown.periods_missed, 1U);
}

TEST(ShownFrame, DoesNotWrapAround) {
    FrameStamps stamps;
    stamps.display = measured(std::numeric_limits<std::int64_t>::min());
    stamps.gpu_end = measured(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(shown_frame(stamps, 2).at.ns, std::numeric_limits<std::int64_t>::max());
}

class GazeAgeOfAFrame : public ::testing::Test {
  protected:
    GazeAgeOfAFrame() {
        fovea.sampled = {1'000, StampKind::Profile};
        fovea.arrived = measured(6'000);
        stamps.latch = measured(8'000);
        stamps.submit = measured(9'500);
        stamps.gpu_end = measured(15'000);
        stamps.display = {20'000, StampKind::Predicted};
    }

    gaze::FoveaPoint fovea;
    FrameStamps stamps;
};

TEST_F(GazeAgeOfAFrame, HasStagesThatAddUp) {
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(age.at_latch, (Span{7'000, StampKind::Profile}));
    EXPECT_EQ(age.at_display, (Span{21'000, StampKind::Predicted}));
    EXPECT_EQ(stage(age, Stage::Tracker), (Span{5'000, StampKind::Profile}));
    EXPECT_EQ(stage(age, Stage::Queue), (Span{2'000, StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Submit), (Span{1'500, StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Gpu), (Span{5'500, StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Wait), (Span{5'000, StampKind::Predicted}));
    EXPECT_EQ(stage(age, Stage::Switching), (Span{2'000, StampKind::Profile}));
    EXPECT_EQ(age.unaccounted, (Span{0, StampKind::Predicted}));
}

TEST_F(GazeAgeOfAFrame, SplitsTheTrackersTimeWhereAClockWasFitted) {
    fovea.ready = measured(5'200);
    fovea.uncertainty_ns = 700;
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Tracker), (Span{4'200, StampKind::Profile}));
    EXPECT_EQ(stage(age, Stage::Delivery), (Span{800, StampKind::Measured}));
    EXPECT_EQ(age.unaccounted, (Span{0, StampKind::Predicted}));
    EXPECT_EQ(age.uncertainty, (Span{700, StampKind::Profile}));
    fovea.sampled = {};
    EXPECT_FALSE(gaze_age(fovea, stamps, stamps.display, 2'000).uncertainty.known());
}

TEST_F(GazeAgeOfAFrame, LeavesTheTimeAroundAnUnknownStampUnaccounted) {
    stamps.gpu_end = {};
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_FALSE(stage(age, Stage::Gpu).known());
    EXPECT_FALSE(stage(age, Stage::Wait).known());
    EXPECT_EQ(age.at_display.ns, 21'000);
    EXPECT_EQ(age.unaccounted.ns, 10'500);
}

TEST_F(GazeAgeOfAFrame, IsUnknownWithoutASampleTime) {
    fovea.sampled = {};
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_FALSE(age.at_latch.known());
    EXPECT_FALSE(age.at_display.known());
    EXPECT_FALSE(age.unaccounted.known());
    EXPECT_FALSE(stage(age, Stage::Tracker).known());
    EXPECT_TRUE(stage(age, Stage::Queue).known());
}

TEST_F(GazeAgeOfAFrame, EndsAtTheEmissionWhereTheSwitchingTimeIsUnknown) {
    const GazeAge age = gaze_age(fovea, stamps, measured(20'000), std::nullopt);
    EXPECT_FALSE(stage(age, Stage::Switching).known());
    EXPECT_EQ(age.at_display, (Span{19'000, StampKind::Profile}));
    EXPECT_EQ(age.unaccounted.ns, 0);
}

TEST_F(GazeAgeOfAFrame, CountsTheRowThatIsLookedAt) {
    for (const std::int64_t row_ns : {-3'000, 0, 3'000}) {
        const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000, row_ns);
        EXPECT_EQ(stage(age, Stage::Row), (Span{row_ns, StampKind::Profile}));
        EXPECT_EQ(age.at_display, (Span{21'000 + row_ns, StampKind::Predicted}));
        EXPECT_EQ(age.unaccounted, (Span{0, StampKind::Predicted}));
    }
    EXPECT_FALSE(stage(gaze_age(fovea, stamps, stamps.display, 2'000), Stage::Row).known());
}

TEST(RowDelay, LiesAboutTheMiddleOfTheEmission) {
    constexpr std::int64_t kRolling_ns = 8'000'000;
    EXPECT_EQ(row_delay_ns(kRolling_ns, 0.0, 1000), -4'000'000);
    EXPECT_EQ(row_delay_ns(kRolling_ns, 250.0, 1000), -2'000'000);
    EXPECT_EQ(row_delay_ns(kRolling_ns, 500.0, 1000), 0);
    EXPECT_EQ(row_delay_ns(kRolling_ns, 1000.0, 1000), 4'000'000);
    EXPECT_EQ(row_delay_ns(0, 0.0, 1000), 0) << "all rows at once";
    EXPECT_EQ(row_delay_ns(kRolling_ns, -1e300, 1000), -4'000'000) << "off screen";
    EXPECT_EQ(row_delay_ns(kRolling_ns, std::numeric_limits<double>::infinity(), 1000), 4'000'000);
    EXPECT_EQ(row_delay_ns(kRolling_ns, std::nan(""), 1000), std::nullopt);
    EXPECT_EQ(row_delay_ns(kRolling_ns, 1.0, 0), std::nullopt);
    EXPECT_EQ(row_delay_ns(std::nullopt, 1.0, 1000), std::nullopt);
}

TEST(OlderGaze, IsTheEyeWithTheEarlierOrTheUnknownSample) {
    gaze::FrameFovea fovea;
    auto& [left, right] = fovea.eyes;
    left.sampled = measured(5);
    right.sampled = measured(4);
    EXPECT_EQ(&fovea.eyes[gaze::index(older_eye(fovea))], &right);
    left.sampled = measured(3);
    EXPECT_EQ(&fovea.eyes[gaze::index(older_eye(fovea))], &left);
    right.sampled = {};
    EXPECT_EQ(&fovea.eyes[gaze::index(older_eye(fovea))], &right);
    right.sampled = measured(9);
    left.sampled = {};
    EXPECT_EQ(&fovea.eyes[gaze::index(older_eye(fovea))], &left);
}

}  // namespace
}  // namespace gazeloop::latency
