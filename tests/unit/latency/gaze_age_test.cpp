#include "runtime/latency/gaze_age.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace gazeloop::latency {
namespace {

constexpr std::int64_t kPeriodNs = 10'000'000;

time::Stamp measured(std::int64_t ns) { return {ns, time::StampKind::Measured}; }

const time::Span& stage(const GazeAge& age, Stage stage) {
    return age.stages[static_cast<std::size_t>(stage)];
}

TEST(Weaker, PicksTheLessCertainKind) {
    const std::array order{time::StampKind::Measured, time::StampKind::Profile,
                           time::StampKind::Modelled, time::StampKind::Predicted,
                           time::StampKind::Unknown};
    for (std::size_t better = 0; better < order.size(); ++better) {
        for (std::size_t worse = better; worse < order.size(); ++worse) {
            EXPECT_EQ(time::weaker(order[better], order[worse]), order[worse]);
            EXPECT_EQ(time::weaker(order[worse], order[better]), order[worse]);
        }
    }
}

TEST(Between, DoesNotWrapAround) {
    const time::Stamp least = measured(std::numeric_limits<std::int64_t>::min());
    const time::Stamp greatest = measured(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(time::between(least, greatest).ns, greatest.ns);
    EXPECT_EQ(time::between(greatest, least).ns, least.ns);
    EXPECT_EQ(time::between(measured(3), measured(1)), (time::Span{-2, time::StampKind::Measured}));
    EXPECT_FALSE(time::between(measured(3), time::Stamp{}).known());
}

TEST(ShownFrame, IsShownWhenAnnouncedIfTheGpuWasInTime) {
    frame::FrameStamps stamps;
    stamps.display = {100, time::StampKind::Predicted};
    stamps.gpu_end = measured(100);
    const ShownFrame shown = shown_frame(stamps, kPeriodNs);
    EXPECT_EQ(shown.at, stamps.display);
    EXPECT_EQ(shown.periods_missed, 0U);
    EXPECT_TRUE(shown.in_time_known);
}

TEST(ShownFrame, IsShownAtTheNextPeriodAfterALateEnd) {
    frame::FrameStamps stamps;
    stamps.display = {100, time::StampKind::Predicted};
    struct Case {
        std::int64_t late_ns;
        std::uint64_t periods;
    };
    for (const auto& [late_ns, periods] :
         {Case{1, 1}, Case{kPeriodNs, 1}, Case{kPeriodNs + 1, 2}, Case{5 * kPeriodNs, 5}}) {
        stamps.gpu_end = measured(stamps.display.ns + late_ns);
        const ShownFrame shown = shown_frame(stamps, kPeriodNs);
        EXPECT_EQ(shown.periods_missed, periods);
        EXPECT_EQ(shown.at, (time::Stamp{100 + static_cast<std::int64_t>(periods) * kPeriodNs,
                                         time::StampKind::Modelled}));
    }
}

TEST(ShownFrame, AnUnknownEndLeavesTheAnnouncedTime) {
    frame::FrameStamps stamps;
    stamps.display = {100, time::StampKind::Predicted};
    const ShownFrame shown = shown_frame(stamps, kPeriodNs);
    EXPECT_EQ(shown.at, stamps.display);
    EXPECT_FALSE(shown.in_time_known);
}

TEST(ShownFrame, ALateEndWithoutAPeriodIsShownNobodyKnowsWhen) {
    frame::FrameStamps stamps;
    stamps.display = measured(100);
    stamps.gpu_end = measured(101);
    const ShownFrame shown = shown_frame(stamps, 0);
    EXPECT_FALSE(shown.at.known());
    EXPECT_EQ(shown.periods_missed, 1U);
}

TEST(ShownFrame, DoesNotWrapAround) {
    frame::FrameStamps stamps;
    stamps.display = measured(std::numeric_limits<std::int64_t>::min());
    stamps.gpu_end = measured(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(shown_frame(stamps, 2).at.ns, std::numeric_limits<std::int64_t>::max());
}

TEST(ShownFrame, IsShownWhenTheRuntimeSaysSo) {
    frame::FrameStamps stamps;
    stamps.display = {100'000, time::StampKind::Predicted};
    stamps.gpu_end = measured(150'000);  // late by our model, which then does not count
    struct Case {
        std::int64_t late_ns;
        std::uint64_t periods;
    };
    for (const auto& [late_ns, periods] :
         {Case{-3 * kPeriodNs, 0}, Case{0, 0}, Case{kPeriodNs / 2 - 1, 0}, Case{kPeriodNs / 2, 1},
          Case{kPeriodNs, 1}, Case{5 * kPeriodNs + 1, 5}}) {
        stamps.shown = {100'000 + late_ns, time::StampKind::Profile};
        const ShownFrame shown = shown_frame(stamps, kPeriodNs);
        EXPECT_EQ(shown.at, stamps.shown);
        EXPECT_EQ(shown.periods_missed, periods) << late_ns;
        EXPECT_TRUE(shown.in_time_known);
    }
    EXPECT_FALSE(shown_frame(stamps, 0).in_time_known) << "of no period, it is not known";
    stamps.display = {};
    EXPECT_EQ(shown_frame(stamps, kPeriodNs).at, stamps.shown);
    EXPECT_FALSE(shown_frame(stamps, kPeriodNs).in_time_known);
    stamps.display = {std::numeric_limits<std::int64_t>::min(), time::StampKind::Predicted};
    stamps.shown = measured(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(shown_frame(stamps, 1).periods_missed, std::numeric_limits<std::uint64_t>::max());
}

class GazeAgeOfAFrame : public ::testing::Test {
  protected:
    GazeAgeOfAFrame() {
        fovea.sampled = {1'000, time::StampKind::Profile};
        fovea.arrived = measured(6'000);
        stamps.latch = measured(8'000);
        stamps.submit = measured(9'500);
        stamps.gpu_begin = measured(9'500);
        stamps.gpu_end = measured(15'000);
        stamps.display = {20'000, time::StampKind::Predicted};
    }

    gaze::FoveaPoint fovea;
    frame::FrameStamps stamps;
};

TEST_F(GazeAgeOfAFrame, HasStagesThatAddUp) {
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(age.at_latch, (time::Span{7'000, time::StampKind::Profile}));
    EXPECT_EQ(age.at_display, (time::Span{21'000, time::StampKind::Predicted}));
    EXPECT_EQ(stage(age, Stage::Tracker), (time::Span{5'000, time::StampKind::Profile}));
    EXPECT_EQ(stage(age, Stage::Queue), (time::Span{2'000, time::StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Submit), (time::Span{1'500, time::StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Gpu), (time::Span{5'500, time::StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Wait), (time::Span{5'000, time::StampKind::Predicted}));
    EXPECT_EQ(stage(age, Stage::Switching), (time::Span{2'000, time::StampKind::Profile}));
    EXPECT_EQ(age.unaccounted, (time::Span{0, time::StampKind::Predicted}));
}

TEST_F(GazeAgeOfAFrame, HasTheFiltersDelay) {
    fovea.filter_delay_ns = 3'000;
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Filter), (time::Span{3'000, time::StampKind::Modelled}));
    EXPECT_EQ(age.at_display, (time::Span{24'000, time::StampKind::Predicted}));
    EXPECT_EQ(age.unaccounted.ns, 0);
    stamps.filtered = measured(8'400);
    const GazeAge stamped = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(stamped, Stage::Filter), (time::Span{3'400, time::StampKind::Modelled}));
    EXPECT_EQ(stage(stamped, Stage::Submit).ns, 1'100);
    EXPECT_EQ(stamped.at_display, age.at_display);
    EXPECT_EQ(stamped.unaccounted.ns, 0);
    const GazeAge never_shown = gaze_age(fovea, stamps, {}, 2'000);
    EXPECT_FALSE(never_shown.at_display.known());
    fovea.filter_delay_ns = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(gaze_age(fovea, stamps, stamps.display, 2'000).at_display.ns,
              std::numeric_limits<std::int64_t>::max());
}

TEST_F(GazeAgeOfAFrame, SplitsTheTrackersTimeWhereAClockWasFitted) {
    fovea.ready = measured(5'200);
    fovea.uncertainty_ns = 700;
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Tracker), (time::Span{4'200, time::StampKind::Profile}));
    EXPECT_EQ(stage(age, Stage::Delivery), (time::Span{800, time::StampKind::Measured}));
    EXPECT_EQ(age.unaccounted, (time::Span{0, time::StampKind::Predicted}));
    EXPECT_EQ(age.uncertainty, (time::Span{700, time::StampKind::Profile}));
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

TEST_F(GazeAgeOfAFrame, SplitsTheSubmitWhereTheFilterIsStamped) {
    EXPECT_FALSE(stage(gaze_age(fovea, stamps, stamps.display, 2'000), Stage::Filter).known());
    stamps.filtered = measured(8'100);
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Filter), (time::Span{100, time::StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Submit), (time::Span{1'400, time::StampKind::Measured}));
    EXPECT_EQ(age.unaccounted, (time::Span{0, time::StampKind::Predicted}));
}

TEST_F(GazeAgeOfAFrame, SplitsTheWaitWhereThePresentIsKnown) {
    EXPECT_FALSE(stage(gaze_age(fovea, stamps, stamps.display, 2'000), Stage::Present).known());
    stamps.present = measured(18'000);
    stamps.shown = {22'000, time::StampKind::Profile};
    const GazeAge age = gaze_age(fovea, stamps, shown_frame(stamps, 0).at, 2'000);
    EXPECT_EQ(stage(age, Stage::Present), (time::Span{3'000, time::StampKind::Measured}));
    EXPECT_EQ(stage(age, Stage::Wait), (time::Span{4'000, time::StampKind::Profile}));
    EXPECT_EQ(age.at_display, (time::Span{23'000, time::StampKind::Profile}));
    EXPECT_EQ(age.unaccounted, (time::Span{0, time::StampKind::Profile}));
    stamps.gpu_end = {};
    EXPECT_EQ(gaze_age(fovea, stamps, stamps.shown, 2'000).unaccounted.ns, 8'500)
        << "from the submit to the present";
}

TEST_F(GazeAgeOfAFrame, ShowsTheTimeBeforeTheFirstPassAsUnaccounted) {
    stamps.gpu_begin = measured(10'200);
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Gpu), (time::Span{4'800, time::StampKind::Measured}));
    EXPECT_EQ(age.unaccounted, (time::Span{700, time::StampKind::Predicted}));
}

TEST_F(GazeAgeOfAFrame, CountsOfTheGpuWhatLiesAfterTheSubmit) {
    stamps.gpu_begin = measured(3'000);  // drawn before the gaze was read
    const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000);
    EXPECT_EQ(stage(age, Stage::Gpu), (time::Span{5'500, time::StampKind::Measured}));
    EXPECT_EQ(age.unaccounted.ns, 0);
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
    EXPECT_EQ(age.at_display, (time::Span{19'000, time::StampKind::Profile}));
    EXPECT_EQ(age.unaccounted.ns, 0);
}

TEST_F(GazeAgeOfAFrame, CountsTheRowThatIsLookedAt) {
    for (const std::int64_t row_ns : {-3'000, 0, 3'000}) {
        const GazeAge age = gaze_age(fovea, stamps, stamps.display, 2'000, row_ns);
        EXPECT_EQ(stage(age, Stage::Row), (time::Span{row_ns, time::StampKind::Profile}));
        EXPECT_EQ(age.at_display, (time::Span{21'000 + row_ns, time::StampKind::Predicted}));
        EXPECT_EQ(age.unaccounted, (time::Span{0, time::StampKind::Predicted}));
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
