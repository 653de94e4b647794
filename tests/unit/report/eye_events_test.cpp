#include "runtime/report/eye_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "runtime/report/eye_event_rows.h"
#include "runtime/report/row_names.h"
#include "sim/gaze_generator.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using gaze::EyeEvent;
using latency::kMs;

frame::FrameRecord frame_of(std::uint64_t index, std::optional<EyeEvent> event) {
    frame::FrameRecord frame = latency::example_frame(index);
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.event = event;
    }
    return frame;
}

TEST(EyeEvents, OfNothingAreUnknown) {
    const EyeEvents events;
    EXPECT_EQ(events.source(), EyeEventSource::None);
    EXPECT_EQ(events.at(0), std::nullopt);
}

TEST(EyeEvents, AreThoseThatTheRunTold) {
    EyeEvents events;
    events.on_frame(frame_of(0, EyeEvent::Fixation));
    events.on_frame(frame_of(1, EyeEvent::Saccade));
    frame::FrameRecord lost = frame_of(2, EyeEvent::Lost);
    lost.fovea.eyes[0].state = gaze::FoveaState::Held;  // of a sample long ago
    lost.fovea.eyes[0].sampled.ns = -1000 * kMs;
    events.on_frame(lost);
    events.on_frame(frame_of(3, std::nullopt));
    EXPECT_EQ(events.source(), EyeEventSource::Recorded);
    const auto at_ms = [&](std::int64_t ms) { return events.at(ms * kMs); };
    // Each sample is 3 ms older than its frame's wake-up; the lost one is of the time of the latch.
    EXPECT_EQ(at_ms(-4), std::nullopt);
    EXPECT_EQ(at_ms(-3), EyeEvent::Fixation);
    EXPECT_EQ(at_ms(6), EyeEvent::Fixation);
    EXPECT_EQ(at_ms(7), EyeEvent::Saccade);
    EXPECT_EQ(at_ms(22), EyeEvent::Lost);
    EXPECT_EQ(at_ms(47), EyeEvent::Lost) << "no longer than 25 ms after the last one";
    EXPECT_EQ(at_ms(48), std::nullopt);
}

TEST(EyeEvents, DoNotGoOnWhereNobodyLooked) {
    EyeEvents events;
    events.on_frame(frame_of(0, EyeEvent::Fixation));
    events.on_frame(frame_of(10, EyeEvent::Fixation));
    EXPECT_EQ(events.at(20 * kMs), EyeEvent::Fixation);
    EXPECT_EQ(events.at(50 * kMs), EyeEvent::Lost);
    EXPECT_EQ(events.at(98 * kMs), EyeEvent::Fixation);
}

TEST(EyeEvents, AreFoundInTheSamplesOfARunThatToldNone) {
    sim::GazeSimulation simulation{.seed = 5};
    simulation.tracker.rate_hz = 200.0;
    simulation.tracker.noise_deg = 0.14;  // without any, drift looks like pursuit
    const gaze::GazeTrace trace = sim::generate_gaze(simulation, 30.0);
    EyeEvents events;
    for (const gaze::GazeSample& sample : trace.samples) {
        events.on_sample(sample, 0);
    }
    EXPECT_EQ(events.source(), EyeEventSource::Found);
    std::array<int, gaze::kEyeEventNames.size()> times{};
    for (const gaze::GazeSample& sample : trace.samples) {
        const auto event = events.at(sample.sampled.ns);
        ASSERT_TRUE(event.has_value());
        ++times[static_cast<std::size_t>(*event) - 1];
    }
    const auto share = [&](EyeEvent event) {
        return times[static_cast<std::size_t>(event) - 1] /
               static_cast<double>(trace.samples.size());
    };
    // The person makes a saccade every third of a second or so, of 20 to 60 ms.
    EXPECT_GT(share(EyeEvent::Fixation), 0.5);
    EXPECT_GT(share(EyeEvent::Saccade), 0.03);
    EXPECT_LT(share(EyeEvent::Saccade), 0.2);
}

TEST(EyeEvents, GoAlongWithTheOrigin) {
    const auto events_of = [](bool turned) {
        sim::GazeSimulation simulation{.seed = 6};
        simulation.tracker.rate_hz = 200.0;
        std::vector<gaze::GazeSample> samples = sim::generate_gaze(simulation, 10.0).samples;
        const glm::dquat new_in_old = glm::angleAxis(1.0, glm::dvec3{0.0, 1.0, 0.0});
        EyeEvents events;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (turned && i == samples.size() / 2) {
                events.on_origin({.frame = 0, .new_in_old = {new_in_old, {}}});
            }
            if (turned && i >= samples.size() / 2) {
                gaze::Pose& head = samples[i].head.value();
                head.orientation = glm::conjugate(new_in_old) * head.orientation;
            }
            events.on_sample(samples[i], 0);
        }
        std::vector<EyeEvent> all;
        for (const gaze::GazeSample& sample : samples) {
            all.push_back(events.at(sample.sampled.ns).value());
        }
        return all;
    };
    EXPECT_EQ(events_of(true), events_of(false));
}

TEST(EyeEvents, BearAnyTimes) {
    EyeEvents events;
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t ns : {std::int64_t{0}, kLeast, kMost, std::int64_t{5}, kLeast}) {
        gaze::GazeSample sample;
        sample.sampled = {ns, time::StampKind::Measured};
        sample.eyes[0].direction = {0.0, 0.0, -1.0};
        sample.eyes[0].valid = true;
        events.on_sample(sample, 0);
        frame::FrameRecord frame = frame_of(0, EyeEvent::Pursuit);
        frame.fovea.eyes[0].sampled.ns = ns;
        events.on_frame(frame);
    }
    EXPECT_EQ(events.at(kLeast), std::nullopt);
    EXPECT_EQ(events.at(kMost), EyeEvent::Pursuit);
    EXPECT_EQ(events.at(1), EyeEvent::Pursuit);
}

std::unique_ptr<const FrameLog> log_of(std::uint64_t frames, const auto& event_of) {
    auto log =
        std::make_unique<FrameLog>(latency::SummaryConfig{.period_ns = latency::kExamplePeriodNs,
                                                          .passes = latency::kExamplePasses,
                                                          .grids = latency::kExampleGrids});
    EyeEvents events;
    for (std::uint64_t index = 0; index < frames; ++index) {
        frame::FrameRecord frame = frame_of(index, event_of(index));
        frame.fovea.eyes[0].sampled.ns -= static_cast<std::int64_t>(index % 7) * kMs / 10;
        if (index % 10 == 9) {
            for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
                eye.state = gaze::FoveaState::Held;
            }
        }
        log->on_frame(frame);
        log->on_gpu(latency::example_gpu(index));
        events.on_frame(frame);
    }
    log->finish();
    log->set_eye_events(events);
    return log;
}

TEST(EyeEventRows, ShareOutTheFramesWithFreshGaze) {
    constexpr std::uint64_t kFrames = 200;
    const auto made = log_of(kFrames, [](std::uint64_t index) {
        return std::optional(index % 20 < 15 ? EyeEvent::Fixation : EyeEvent::Saccade);
    });
    const FrameLog& log = *made;
    const std::array percents{50.0, 95.0, 99.9};
    const EyeEventRows rows = rows_by_eye_event(log, percents);
    EXPECT_EQ(rows.source, EyeEventSource::Recorded);
    EXPECT_EQ(rows.with_gaze, kFrames * 9 / 10);
    ASSERT_EQ(rows.ages.size(), 2U);
    EXPECT_EQ(rows.ages[0].name.key, "fixation");
    EXPECT_EQ(rows.ages[1].name.key, "saccade");
    EXPECT_EQ(rows.ages[0].known + rows.ages[1].known + rows.unknown, rows.with_gaze);
    EXPECT_GT(rows.ages[1].known, 30U);
    EXPECT_EQ(rows.ages[0].percentiles[2], std::nullopt) << "too few frames";
    const DurationColumn& ages = log.at(kGazeAgeAtDisplay.key);
    std::vector<std::int64_t> in_saccades;
    for (std::size_t row = 0; row < log.rows(); ++row) {
        if (log.eye_event(row) == EyeEvent::Saccade && ages.at(row)) {
            in_saccades.push_back(*ages.at(row));
        }
    }
    ASSERT_EQ(in_saccades.size(), rows.ages[1].known);
    EXPECT_EQ(rows.ages[1].least,
              shown(static_cast<double>(std::ranges::min(in_saccades)), Unit::Nanoseconds));
    EXPECT_EQ(rows.ages[1].greatest,
              shown(static_cast<double>(std::ranges::max(in_saccades)), Unit::Nanoseconds));
}

TEST(EyeEventRows, AreNoneWhereNobodyKnows) {
    const auto made = log_of(50, [](std::uint64_t) { return std::optional<EyeEvent>{}; });
    const FrameLog& log = *made;
    const EyeEventRows rows = rows_by_eye_event(log, std::array{50.0});
    EXPECT_FALSE(rows.any());
    EXPECT_EQ(rows.unknown, rows.with_gaze);
    EXPECT_EQ(log.eye_event(0), std::nullopt);
    EXPECT_EQ(source_text(rows), "what the eyes did is unknown");
}

}  // namespace
}  // namespace gazeloop::report
