#include "runtime/gaze/events/recorded_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <span>
#include <vector>

#include "runtime/gaze/events/event_statistics.h"
#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kInterval_ns = 2'000'000;

/// A recording that is made piece by piece, 500 Hz.
class Made {
  public:
    void look(double right_deg, bool seen = true) {
        GazeSample& sample = samples.emplace_back();
        sample.sampled = {static_cast<std::int64_t>(samples.size()) * kInterval_ns,
                          time::StampKind::Modelled};
        for (EyeRay& ray : sample.eyes) {
            ray.valid = seen;
            ray.direction = {std::sin(glm::radians(right_deg)), 0.0,
                             -std::cos(glm::radians(right_deg))};
        }
    }
    void rest(double right_deg, int count, bool seen = true) {
        for (int i = 0; i < count; ++i) {
            look(right_deg, seen);
        }
    }
    /// On the main sequence.
    void jump(double from_deg, double amplitude_deg) {
        const SaccadeCourse course(std::abs(amplitude_deg), 1.0);
        for (double t = 2e-3; t < course.duration_s(); t += 2e-3) {
            look(from_deg + amplitude_deg * course.progress(t));
        }
    }

    std::vector<GazeSample> samples;
};

void expect_whole(std::span<const RecordedEvent> events, const Made& made) {
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().begin_ns, made.samples.front().sampled.ns);
    EXPECT_EQ(events.back().end_ns, made.samples.back().sampled.ns);
    std::uint64_t samples = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
        samples += events[i].samples;
        EXPECT_LE(events[i].begin_ns, events[i].end_ns);
        if (i > 0) {
            EXPECT_EQ(events[i].begin_ns, events[i - 1].end_ns) << "no time between events";
            EXPECT_NE(events[i].event, events[i - 1].event);
        }
    }
    EXPECT_EQ(samples, made.samples.size()) << "every sample is in one event";
}

TEST(RecordedEvents, ListsSaccadesWithTheirSize) {
    Made made;
    double at_deg = 0.0;
    const std::vector<double> amplitudes{10.0, -6.0, 14.0, -3.0};
    for (const double amplitude : amplitudes) {
        made.rest(at_deg, 200);
        made.jump(at_deg, amplitude);
        at_deg += amplitude;
    }
    made.rest(at_deg, 200);
    const memory::LongVector<RecordedEvent> events = recorded_events(made.samples);
    expect_whole(events, made);
    std::vector<RecordedEvent> saccades;
    for (const RecordedEvent& event : events) {
        if (event.event == EyeEvent::Saccade) {
            saccades.push_back(event);
        } else if (event.event == EyeEvent::Fixation) {
            EXPECT_LT(event.deviation_deg, 0.4);
        }
    }
    ASSERT_EQ(saccades.size(), amplitudes.size());
    for (std::size_t i = 0; i < saccades.size(); ++i) {
        const MainSequence published = main_sequence(std::abs(amplitudes[i]));
        EXPECT_NEAR(saccades[i].amplitude_deg, std::abs(amplitudes[i]),
                    0.05 * std::abs(amplitudes[i]) + 0.2);
        EXPECT_NEAR(saccades[i].peak_deg_per_s, published.peak_deg_per_s,
                    0.05 * published.peak_deg_per_s);
        EXPECT_NEAR(saccades[i].duration_ms(), published.duration_s * 1e3, 12.0);
    }
}

TEST(RecordedEvents, TellsHowLongTheEyeWasUnseen) {
    Made made;
    made.rest(0.0, 200);
    made.rest(0.0, 99, false);  // from one seen sample to the next: 200 ms
    made.rest(0.0, 200);
    made.rest(0.0, 499, false);  // 1 s
    made.rest(0.0, 200);
    const memory::LongVector<RecordedEvent> events = recorded_events(made.samples);
    expect_whole(events, made);
    std::vector<std::int64_t> unseen_ms;
    for (const RecordedEvent& event : events) {
        if (event.event == EyeEvent::Lost && event.unseen_ns > 0) {
            unseen_ms.push_back(event.unseen_ns / 1'000'000);
            EXPECT_EQ(event.amplitude_deg, 0.0);
            EXPECT_EQ(event.middle, glm::dvec3{0.0});
        }
    }
    EXPECT_EQ(unseen_ms, (std::vector<std::int64_t>{200, 1000}));
    const EventStatistics statistics = event_statistics(events);
    EXPECT_EQ(statistics.blinks.count, 1U);
    EXPECT_EQ(statistics.losses.count, 1U);
    EXPECT_NEAR(statistics.fixations.percent + statistics.blinks.percent +
                    statistics.losses.percent + statistics.pursuits.percent,
                100.0, 1e-9);
}

TEST(RecordedEvents, TakeRowsThatAreMissingForALoss) {
    Made made;
    made.rest(0.0, 300);
    for (std::size_t i = 150; i < made.samples.size(); ++i) {
        made.samples[i].sampled.ns += 298'000'000;
    }
    bool lost = false;
    for (const RecordedEvent& event : recorded_events(made.samples)) {
        if (event.event == EyeEvent::Lost) {
            lost = true;
            EXPECT_EQ(event.unseen_ns, 300'000'000);
        }
    }
    EXPECT_TRUE(lost);
}

/// A made trace steps from one sample to the next: 0 ms and 0 deg are no sizes.
TEST(RecordedEvents, SayNothingOfTheSizeOfAnInstantSaccade) {
    constexpr std::int64_t kStep_ns = 400'000'000;
    std::vector<RecordedEvent> events;
    for (std::int64_t i = 0; i < 4; ++i) {
        events.push_back({.event = EyeEvent::Fixation,
                          .begin_ns = i * kStep_ns,
                          .end_ns = (i + 1) * kStep_ns,
                          .samples = 48});
        events.push_back({.event = EyeEvent::Saccade,
                          .begin_ns = (i + 1) * kStep_ns,
                          .end_ns = (i + 1) * kStep_ns,
                          .samples = 1,
                          .peak_deg_per_s = 1'228.0});
    }
    events.push_back(
        {.event = EyeEvent::Fixation, .begin_ns = 4 * kStep_ns, .end_ns = 5 * kStep_ns});
    const EventStatistics statistics = event_statistics(events);
    EXPECT_EQ(statistics.saccades.count, 4U);
    EXPECT_EQ(statistics.instant_saccades, 4U);
    EXPECT_FALSE(statistics.saccades.duration_ms.has_value());
    EXPECT_FALSE(statistics.saccade_amplitude_deg.has_value());
}

TEST(RecordedEvents, DoWithoutSamplesAndTimes) {
    EXPECT_TRUE(recorded_events({}).empty());
    Made made;
    made.rest(0.0, 10);
    for (GazeSample& sample : made.samples) {
        sample.sampled = {};
    }
    EXPECT_TRUE(recorded_events(made.samples).empty());
    EXPECT_EQ(event_statistics({}).duration_s, 0.0);
    Made one;
    one.look(1.0);
    const memory::LongVector<RecordedEvent> events = recorded_events(one.samples);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].duration_ms(), 0.0);
    EXPECT_EQ(event_statistics(events).fixations.per_minute, 0.0) << "no time, no rate";
    Made never;
    never.rest(0.0, 50, false);
    const memory::LongVector<RecordedEvent> unseen = recorded_events(never.samples);
    ASSERT_EQ(unseen.size(), 1U);
    EXPECT_EQ(unseen[0].event, EyeEvent::Lost);
    EXPECT_EQ(unseen[0].unseen_ns, 0) << "nobody knows how long";
}

/// The head turns, the eyes hold a point of the world: no saccade.
TEST(RecordedEvents, LookAtGazeInTheWorldWhereTheHeadIsKnown) {
    Made made;
    for (int i = 0; i < 500; ++i) {
        const double turned_deg = 60.0 * i * 2e-3;  // to the left
        made.look(turned_deg);
        const double half_rad = 0.5 * glm::radians(turned_deg);
        made.samples.back().head =
            Pose{glm::dquat{std::cos(half_rad), 0.0, std::sin(half_rad), 0.0}, glm::dvec3{0.0}};
    }
    for (const RecordedEvent& event : recorded_events(made.samples)) {
        EXPECT_TRUE(event.event == EyeEvent::Fixation || event.event == EyeEvent::Lost);
        EXPECT_LT(event.deviation_deg, 1e-6);
    }
}

}  // namespace
}  // namespace gazeloop::gaze
