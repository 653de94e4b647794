#include "drivers/anatomy/anatomy_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "drivers/trace/trace_source.h"
#include "tests/unit/gaze/pair_of_eyes.h"

namespace gazeloop::drivers {
namespace {

using gaze::EyeRay;
using ::testing::HasSubstr;

/// What is told while the samples pass one by one, and after how many each.
std::vector<std::pair<std::size_t, SourceEvent>> told(std::vector<gaze::GazeSample> samples) {
    const std::size_t count = samples.size();
    AnatomySource source(
        std::make_unique<TraceSource>(gaze::GazeTrace{.samples = std::move(samples)}, 0, 0));
    std::vector<gaze::GazeSample> passed;
    std::vector<std::pair<std::size_t, SourceEvent>> events;
    for (std::size_t i = 0; i < count; ++i) {
        source.poll(static_cast<std::int64_t>(i) * 8'333'333, passed);
        for (SourceEvent& event : source.take_events()) {
            events.emplace_back(passed.size(), std::move(event));
        }
    }
    EXPECT_EQ(passed.size(), count) << "all pass";
    return events;
}

TEST(AnatomySource, TellsOnceOfDirectionsInDoubt) {
    const auto events = told(gaze::pair_of_eyes(-2.4, 1000));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].first, AnatomySource::kDecide);
    EXPECT_EQ(events[0].second.kind.name, "axes");
    EXPECT_THAT(events[0].second.text, HasSubstr("rays diverge (median -2.4 deg)"));
    EXPECT_THAT(events[0].second.text, HasSubstr("calibrate"));
}

TEST(AnatomySource, TellsOnceThatDirectionsAgree) {
    const auto events = told(gaze::pair_of_eyes(2.4, 1000));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].second.kind.name, "tracker");
    EXPECT_THAT(events[0].second.text, HasSubstr("directions: agree with anatomy"));
}

TEST(AnatomySource, WaitsLongerForASecondEye) {
    const auto events = told(gaze::changed(gaze::pair_of_eyes(2.4, 1000),
                                           [](EyeRay&, EyeRay& right) { right.valid = false; }));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].first, 3 * AnatomySource::kDecide);
    EXPECT_THAT(events[0].second.text, HasSubstr("one eye"));
}

TEST(AnatomySource, LooksAtNoBlinks) {
    const auto events =
        told(gaze::changed(gaze::pair_of_eyes(2.4, 2000),
                           [](EyeRay& left, EyeRay& right) { left.valid = right.valid = false; }));
    EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace gazeloop::drivers
