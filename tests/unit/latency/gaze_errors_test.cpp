#include "runtime/latency/gaze_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "runtime/gaze/direction.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

constexpr double kTolerance = 1e-9;

glm::dquat turned(double degrees) {
    return glm::angleAxis(glm::radians(degrees), glm::dvec3{0.0, 1.0, 0.0});
}

/// A head that turns at 100 deg/s while the eyes look at one place in world: 20 deg from ahead.
double head_degrees(std::int64_t ns) { return static_cast<double>(ns) * 1e-7; }

gaze::GazeSample sample_at(std::int64_t ms, double world_degrees = 20.0) {
    gaze::GazeSample sample;
    sample.sequence = static_cast<std::uint64_t>(ms + 1000);
    sample.sampled = {ms * kMs, time::StampKind::Measured};
    sample.head = gaze::Pose{turned(head_degrees(ms * kMs)), {}};
    for (gaze::EyeRay& eye : sample.eyes) {
        eye.valid = true;
        eye.direction = turned(world_degrees - head_degrees(ms * kMs)) * gaze::kStraightAhead;
    }
    return sample;
}

/// Rendered for where the head is at its display time, its fovea where that sample looked in world.
frame::FrameRecord frame_of(std::uint64_t index, const gaze::GazeSample& sample,
                            double world_degrees = 20.0) {
    frame::FrameRecord frame = example_frame(index);
    frame.head = {turned(head_degrees(frame.stamps.display.ns)), {}};
    for (const gaze::Eye eye : gaze::kEyes) {
        frame.views[gaze::index(eye)].pose = frame.head;
        gaze::FoveaPoint& fovea = frame.fovea.eyes[gaze::index(eye)];
        fovea.sample_sequence = sample.sequence;
        fovea.sampled = sample.sampled;
        fovea.direction =
            turned(world_degrees - head_degrees(frame.stamps.display.ns)) * gaze::kStraightAhead;
    }
    return frame;
}

std::vector<std::optional<frame::GazeError>> taken(GazeErrors& errors) {
    std::vector<std::optional<frame::GazeError>> all;
    errors.take_decided([&all](std::uint64_t, const std::optional<frame::GazeError>& error) {
        all.push_back(error);
    });
    return all;
}

/// Of one frame, shown at 13 ms, with these samples before and after it.
frame::GazeError error_of(const std::vector<gaze::GazeSample>& before,
                          const frame::FrameRecord& frame,
                          const std::vector<gaze::GazeSample>& after) {
    GazeErrors errors;
    for (const gaze::GazeSample& sample : before) {
        errors.add(sample);
    }
    errors.add(frame);
    errors.set_shown(frame.index, frame.stamps.display);
    for (const gaze::GazeSample& sample : after) {
        errors.add(sample);
    }
    errors.finish();
    const auto all = taken(errors);
    EXPECT_EQ(all.size(), 1U);
    return all.at(0).value();
}

TEST(GazeErrors, PosesLeaveNoErrorWhereTheEyesHoldAPlaceInWorld) {
    const frame::GazeError error =
        error_of({sample_at(-3)}, frame_of(0, sample_at(-3)), {sample_at(10), sample_at(14)});
    EXPECT_NEAR(error.radians.value(), 0.0, kTolerance);
    // The head turns for 16 ms at 100 deg/s from the sample to the display.
    EXPECT_NEAR(glm::degrees(error.without_poses_radians.value()), 1.6, kTolerance);
    EXPECT_EQ(error.gap, frame::GazeErrorGap::None);
    EXPECT_EQ(error.kind, time::StampKind::Predicted);
}

TEST(GazeErrors, AnEyeThatMovedIsSeenBetweenTheTwoSamplesAroundTheDisplay) {
    const frame::GazeError error = error_of({sample_at(-3)}, frame_of(0, sample_at(-3)),
                                            {sample_at(11, 24.0), sample_at(15, 28.0)});
    EXPECT_NEAR(glm::degrees(error.radians.value()), 6.0, kTolerance);
}

TEST(GazeErrors, IsOfTheWorseEye) {
    gaze::GazeSample after = sample_at(13, 23.0);
    after.eyes[0].direction = sample_at(13, 21.0).eyes[0].direction;
    const frame::GazeError error =
        error_of({sample_at(-3)}, frame_of(0, sample_at(-3)), {sample_at(12), after});
    EXPECT_NEAR(glm::degrees(error.radians.value()), 3.0, kTolerance);
}

TEST(GazeErrors, IsUnknownForAReason) {
    const gaze::GazeSample used = sample_at(-3);
    gaze::GazeSample blink = sample_at(14);
    blink.eyes[0].valid = blink.eyes[1].valid = false;
    gaze::GazeSample unsure = sample_at(14);
    unsure.eyes[0].confidence = unsure.eyes[1].confidence = 0.1;
    gaze::GazeSample broken = sample_at(14);
    broken.eyes[0].direction = broken.eyes[1].direction = glm::dvec3{std::nan("")};
    using Gap = frame::GazeErrorGap;
    const frame::FrameRecord frame = frame_of(0, used);
    EXPECT_EQ(error_of({used}, frame, {}).gap, Gap::NoSampleNear);
    EXPECT_EQ(error_of({used}, frame, {sample_at(12), sample_at(39)}).gap, Gap::NoSampleNear);
    EXPECT_EQ(error_of({used}, frame, {sample_at(12), sample_at(38)}).gap, Gap::None);
    EXPECT_EQ(error_of({sample_at(-13)}, frame, {sample_at(14)}).gap, Gap::NoSampleNear);
    EXPECT_EQ(error_of({}, frame, {sample_at(14)}).gap, Gap::NoSampleNear);
    for (const gaze::GazeSample& lost : {blink, unsure, broken}) {
        const frame::GazeError error = error_of({used}, frame, {sample_at(12), lost});
        EXPECT_EQ(error.gap, Gap::EyeLost);
        EXPECT_EQ(error.radians, std::nullopt);
        EXPECT_EQ(error.without_poses_radians, std::nullopt);
        EXPECT_EQ(error.kind, time::StampKind::Unknown);
    }
    frame::FrameRecord undisplayed = frame;
    undisplayed.stamps.display = {};
    EXPECT_EQ(error_of({used}, undisplayed, {sample_at(14)}).gap, Gap::NoDisplayTime);
}

TEST(GazeErrors, WithoutHeadPosesOnlyTheErrorInTheHeadIsKnown) {
    const auto headless = [](gaze::GazeSample sample) {
        sample.head.reset();
        return sample;
    };
    const frame::GazeError error = error_of({headless(sample_at(-3))}, frame_of(0, sample_at(-3)),
                                            {headless(sample_at(12)), headless(sample_at(14))});
    EXPECT_EQ(error.radians, std::nullopt);
    EXPECT_NEAR(error.without_poses_radians.value(), 0.0, kTolerance);
    EXPECT_EQ(error.gap, frame::GazeErrorGap::NoHead);
}

TEST(GazeErrors, HasNoneWithoutFreshGaze) {
    GazeErrors errors;
    frame::FrameRecord frame = frame_of(0, sample_at(-3));
    frame.fovea.eyes[1].state = gaze::FoveaState::Held;
    errors.add(frame);
    EXPECT_EQ(taken(errors), (std::vector<std::optional<frame::GazeError>>{std::nullopt}));
}

// The GPU's end, which may move the display time, comes frames after the samples.
TEST(GazeErrors, IsTheSameWhicheverIsKnownFirst) {
    const gaze::GazeSample used = sample_at(-3);
    const frame::FrameRecord frame = frame_of(0, used);
    for (const std::int64_t shown_ms : {-20, -4, -3, 5, 13, 60}) {
        std::vector<frame::GazeError> both;
        for (const bool late : {false, true}) {
            GazeErrors errors;
            for (std::int64_t ms = -30; ms <= -3; ++ms) {
                errors.add(sample_at(ms, 18.0 + static_cast<double>(ms) * 0.1));
            }
            errors.add(frame);
            const time::Stamp shown{shown_ms * kMs, time::StampKind::Modelled};
            if (!late) {
                errors.set_shown(0, shown);
            }
            for (std::int64_t ms = -2; ms < 100; ++ms) {
                errors.add(sample_at(ms, 18.0 + static_cast<double>(ms) * 0.1));
            }
            if (late) {
                errors.set_shown(0, shown);
            }
            errors.finish();
            both.push_back(taken(errors).at(0).value());
        }
        EXPECT_EQ(both[0], both[1]) << shown_ms;
        EXPECT_EQ(both[0].gap, frame::GazeErrorGap::None) << shown_ms;
    }
}

TEST(GazeErrors, GoesAlongWithTheOrigin) {
    const gaze::Pose new_in_old{turned(90.0), {1.0, 2.0, 3.0}};
    GazeErrors errors;
    errors.add(sample_at(-3));
    const frame::FrameRecord frame = frame_of(0, sample_at(-3));
    errors.add(frame);
    errors.set_shown(0, frame.stamps.display);
    errors.add(sample_at(12));
    errors.move_origin(new_in_old);
    gaze::GazeSample after = sample_at(14);
    after.head->orientation = glm::conjugate(new_in_old.orientation) * after.head->orientation;
    errors.add(after);
    const auto all = taken(errors);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0]->radians.value(), 0.0, 1e-7);
}

TEST(GazeErrors, GivesUpOnFramesThatNoSampleFollows) {
    GazeErrors errors;
    errors.add(sample_at(-3));
    std::size_t decided = 0;
    for (std::uint64_t index = 0; index < 1000; ++index) {
        errors.add(frame_of(index, sample_at(-3)));
        errors.set_shown(index, example_frame(index).stamps.display);
        decided += taken(errors).size();
    }
    EXPECT_GE(decided, 1000U - 64U);
    errors.finish();
    EXPECT_EQ(decided + taken(errors).size(), 1000U);
}

// A step back is left out once; what follows it is held against what follows it.
TEST(GazeErrors, SurvivesAClockThatIsSetBack) {
    GazeErrors errors;
    errors.add(sample_at(1000));
    for (std::int64_t ms = -6; ms <= -3; ++ms) {
        errors.add(sample_at(ms));
    }
    errors.add(frame_of(0, sample_at(-3)));
    errors.set_shown(0, example_frame(0).stamps.display);
    errors.add(sample_at(12));
    errors.add(sample_at(14));
    const auto all = taken(errors);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0]->gap, frame::GazeErrorGap::None);
}

}  // namespace
}  // namespace gazeloop::latency
