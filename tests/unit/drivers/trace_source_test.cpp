#include "drivers/trace/trace_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace gazeloop::drivers {
namespace {

using time::Stamp;
using time::StampKind;

constexpr std::int64_t kStart_ns = 1'000'000;

gaze::GazeSample sample_at(std::int64_t sampled_ns) {
    gaze::GazeSample sample;
    sample.sequence = static_cast<std::uint64_t>(sampled_ns);
    sample.device_ns = 777 + sampled_ns;
    sample.sampled = {sampled_ns, StampKind::Modelled};
    sample.eyes[0].valid = true;
    return sample;
}

gaze::GazeTrace trace_of(const std::vector<gaze::GazeSample>& samples) {
    gaze::GazeTrace trace;
    trace.file = "gaze.csv";
    trace.device = "HTC Vive Pro";
    trace.samples = samples;
    return trace;
}

std::vector<gaze::GazeSample> all_of(TraceSource& source) {
    std::vector<gaze::GazeSample> samples;
    source.poll(kStart_ns + 1'000'000'000, samples);
    return samples;
}

glm::dquat yaw_pitch(double yaw_deg, double pitch_deg) {
    return glm::angleAxis(glm::radians(yaw_deg), glm::dvec3{0.0, 1.0, 0.0}) *
           glm::angleAxis(glm::radians(pitch_deg), glm::dvec3{1.0, 0.0, 0.0});
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(actual - expected), 1e-12)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(TraceSource, HandsSamplesOverWhenTheyHaveArrived) {
    TraceSource source(trace_of({sample_at(0), sample_at(100), sample_at(200)}), kStart_ns, 50);
    std::vector<gaze::GazeSample> samples;
    source.poll(kStart_ns + 49, samples);
    EXPECT_TRUE(samples.empty());
    source.poll(kStart_ns + 50, samples);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].sampled, (Stamp{kStart_ns, StampKind::Modelled}));
    EXPECT_EQ(samples[0].arrived, (Stamp{kStart_ns + 50, StampKind::Modelled}));
    EXPECT_EQ(samples[0].device_ns, 777);
    source.poll(kStart_ns + 50, samples);
    EXPECT_EQ(samples.size(), 1U) << "handed over twice";
    EXPECT_FALSE(source.finished());

    source.poll(kStart_ns + 10'000, samples);  // appends
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_EQ(samples[2].sampled.ns, kStart_ns + 200);
    EXPECT_TRUE(source.finished());
}

TEST(TraceSource, AddsTheRecordedDelayToTheModelledOne) {
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(100), sample_at(200),
                                           sample_at(300)};
    recorded[0].arrived = {0, StampKind::Modelled};
    recorded[1].arrived = {350, StampKind::Modelled};
    // Nobody knows about the third, but it cannot have overtaken the second.
    recorded[3].arrived = {360, StampKind::Modelled};
    TraceSource source(trace_of(recorded), kStart_ns, 50);
    const std::vector<gaze::GazeSample> samples = all_of(source);
    EXPECT_EQ(samples[0].arrived.ns, kStart_ns + 50);
    EXPECT_EQ(samples[1].arrived.ns, kStart_ns + 400);
    EXPECT_EQ(samples[2].arrived, (Stamp{kStart_ns + 400, StampKind::Modelled}));
    EXPECT_EQ(samples[3].arrived.ns, kStart_ns + 410);
}

TEST(TraceSource, LeavesUnknownWhatIsUnknown) {
    gaze::GazeSample unknown = sample_at(0);
    unknown.sampled = {};
    unknown.arrived = {100, StampKind::Measured};
    unknown.head = gaze::Pose{};
    gaze::GazeSample known = sample_at(60);  // before that, as its arrival's time line has it
    known.ready = {80, StampKind::Measured};
    known.arrived = {110, StampKind::Measured};
    known.head = gaze::Pose{};
    TraceSource source(trace_of({unknown, known}), kStart_ns, 0);
    const std::vector<gaze::GazeSample> samples = all_of(source);
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_FALSE(samples[0].sampled.known());
    EXPECT_FALSE(samples[0].ready.known());
    EXPECT_EQ(samples[0].arrived, (Stamp{kStart_ns + 100, StampKind::Modelled}));
    EXPECT_EQ(samples[1].sampled, (Stamp{kStart_ns + 60, StampKind::Modelled}));
    EXPECT_EQ(samples[1].ready, (Stamp{kStart_ns + 80, StampKind::Modelled}));
    EXPECT_EQ(samples[1].arrived, (Stamp{kStart_ns + 110, StampKind::Modelled}));
    ASSERT_NE(source.head_track(), nullptr);
}

TEST(TraceSource, HasNoHeadTrackWithoutPoses) {
    const TraceSource source(trace_of({sample_at(0), sample_at(100)}), kStart_ns, 0);
    EXPECT_EQ(source.head_track(), nullptr);
}

TEST(TraceSource, BringsTheFirstKnownHeadToTheOriginFacingForward) {
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(100), sample_at(200)};
    recorded[1].head = gaze::Pose{yaw_pitch(-130.0, 20.0), {1.0, 1.6, -2.0}};
    recorded[2].head = gaze::Pose{yaw_pitch(-120.0, -5.0), {1.0, 1.7, -2.0}};
    TraceSource source(trace_of(recorded), kStart_ns, 0);
    const std::vector<gaze::GazeSample> samples = all_of(source);

    EXPECT_FALSE(samples[0].head.has_value());
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    expect_near(samples[1].head->position_m, {0.0, 0.0, 0.0});
    // Only the yaw is gone.
    expect_near(samples[1].head->orientation * ahead, yaw_pitch(0.0, 20.0) * ahead);
    expect_near(samples[2].head->position_m, {0.0, 0.1, 0.0});
    expect_near(samples[2].head->orientation * ahead, yaw_pitch(10.0, -5.0) * ahead);
}

TEST(TraceSource, TurnsPositionsWithTheWorld) {
    // Facing along +X there; a step forward there is a step forward here.
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(100)};
    recorded[0].head = gaze::Pose{yaw_pitch(-90.0, 0.0), {5.0, 0.0, 5.0}};
    recorded[1].head = gaze::Pose{yaw_pitch(-90.0, 0.0), {6.0, 0.0, 5.0}};
    TraceSource source(trace_of(recorded), kStart_ns, 0);
    expect_near(all_of(source)[1].head->position_m, {0.0, 0.0, -1.0});
}

TEST(TraceSource, KnowsWhereAHeadFacesThatLooksStraightUp) {
    std::vector<gaze::GazeSample> recorded{sample_at(0)};
    recorded[0].head = gaze::Pose{yaw_pitch(40.0, 90.0), {}};
    TraceSource source(trace_of(recorded), kStart_ns, 0);
    expect_near(all_of(source)[0].head->orientation * glm::dvec3{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
}

TEST(TraceSource, GivesTheHeadTrackInHostTime) {
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(100)};
    recorded[0].head = gaze::Pose{};
    recorded[1].head = gaze::Pose{yaw_pitch(0.0, 0.0), {0.0, 2.0, 0.0}};
    const TraceSource source(trace_of(recorded), kStart_ns, 50);
    ASSERT_NE(source.head_track(), nullptr);
    expect_near(source.head_track()->at(kStart_ns + 25).position_m, {0.0, 0.5, 0.0});
}

TEST(TraceSource, DescribesItself) {
    gaze::GazeTrace trace = trace_of({sample_at(0), sample_at(100)});
    EXPECT_EQ(TraceSource(trace, 0, 0).description(), "trace gaze.csv (HTC Vive Pro, 2 samples)");
    trace.rows_out_of_order = 3;
    trace.rows_missing = 4;
    EXPECT_EQ(TraceSource(trace, 0, 0).description(),
              "trace gaze.csv (HTC Vive Pro, 2 samples, 3 out of order, 4 missing)");
}

}  // namespace
}  // namespace gazeloop::drivers
