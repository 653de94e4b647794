#include "drivers/trace/trace_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "runtime/gaze/gaze_to_fovea.h"

namespace gazeloop::drivers {
namespace {

using time::Stamp;
using time::StampKind;

constexpr std::int64_t kStart_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

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
    source.poll(kStart_ns + kSecond_ns, samples);
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
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(kSecond_ns / 2),
                                           sample_at(kSecond_ns)};
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
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(kSecond_ns)};
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

// ---- A recorded origin that moves ---------------------------------------------------------------

constexpr std::int64_t kRow_ns = 8'333'333;

/// Both eyes look 11 deg to the right in a head that turns at 20 deg/s; `recorded_by` is the world
/// that each row's head is given in, `valid` whether it has gaze.
template <typename Origin, typename Valid>
std::vector<gaze::GazeSample> rows_of(std::size_t count, const Origin& origin, const Valid& valid) {
    std::vector<gaze::GazeSample> rows;
    for (std::size_t i = 0; i < count; ++i) {
        gaze::GazeSample& row =
            rows.emplace_back(sample_at(static_cast<std::int64_t>(i) * kRow_ns));
        for (gaze::EyeRay& ray : row.eyes) {
            ray.direction = yaw_pitch(-11.0, 0.0) * glm::dvec3{0.0, 0.0, -1.0};
            ray.valid = valid(i);
        }
        const gaze::Pose head{yaw_pitch(static_cast<double>(i) / 6.0, 0.0), {0.1, 1.6, 0.0}};
        row.head = gaze::compose(gaze::inverse(origin(i)), head);
    }
    return rows;
}

/// The left fovea, degrees to the right, of frames of 90 Hz whose gaze is 12 ms old at the latch
/// and another frame at the display.
std::vector<double> foveae_of(const std::vector<gaze::GazeSample>& rows) {
    constexpr std::int64_t kPeriod_ns = 11'111'111;
    TraceSource source(trace_of(rows), 0, 12'000'000);
    gaze::GazeToFovea gaze({.loss = {.hold_ns = 150'000'000}});
    std::vector<double> foveae;
    for (std::int64_t latch_ns = 5 * kPeriod_ns; !source.finished(); latch_ns += kPeriod_ns) {
        std::vector<gaze::GazeSample> samples;
        source.poll(latch_ns, samples);
        for (const gaze::GazeSample& sample : samples) {
            gaze.add(sample);
        }
        const gaze::Pose head = source.head_track()->at(latch_ns + kPeriod_ns);
        gaze::EyeView view{
            .pose = head,
            .fov = {.left_rad = -0.8, .right_rad = 0.8, .up_rad = 0.8, .down_rad = -0.8},
            .width_px = 1000,
            .height_px = 1000};
        const glm::dvec3 seen =
            gaze.latch({latch_ns, StampKind::Modelled}, head, {view, view}).eyes[0].direction;
        foveae.push_back(glm::degrees(std::atan2(seen.x, -seen.z)));
    }
    return foveae;
}

const auto kNeverMoved = [](std::size_t) { return gaze::Pose{}; };
const auto kAlwaysValid = [](std::size_t) { return true; };

/// The head is taken to stand still for one row at each jump: 1/6 deg.
void expect_foveae_as_without_jumps(const std::vector<double>& foveae,
                                    const std::vector<double>& without, int jumps = 1) {
    ASSERT_EQ(foveae.size(), without.size());
    for (std::size_t i = 0; i < foveae.size(); ++i) {
        EXPECT_NEAR(foveae[i], without[i], jumps / 6.0 + 1e-6) << "frame " << i;
    }
}

TEST(TraceSource, TurnsNeitherHeadNorFoveaWhereTheRecordedOriginMoves) {
    const auto recentred = [](std::size_t i) {
        return i < 60 ? gaze::Pose{} : gaze::Pose{yaw_pitch(-90.0, 0.0), {0.5, -0.2, 1.0}};
    };
    TraceSource source(trace_of(rows_of(120, recentred, kAlwaysValid)), 0, 0);
    std::vector<gaze::GazeSample> samples;
    source.poll(kSecond_ns, samples);
    // Where it was at the jump, and from there on as it turned.
    expect_near(samples[60].head->position_m, samples[59].head->position_m);
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    expect_near(samples[60].head->orientation * ahead, samples[59].head->orientation * ahead);
    expect_near(samples[90].head->orientation * ahead, yaw_pitch(89.0 / 6.0, 0.0) * ahead);
    // In between as well.
    expect_near(source.head_track()->at(60 * kRow_ns - kRow_ns / 2).orientation * ahead,
                samples[59].head->orientation * ahead);

    expect_foveae_as_without_jumps(foveae_of(rows_of(120, recentred, kAlwaysValid)),
                                   foveae_of(rows_of(120, kNeverMoved, kAlwaysValid)));
}

TEST(TraceSource, KeepsTheFoveaWhereTheOriginOnlyMovesAside) {
    const auto moved = [](std::size_t i) {
        return gaze::Pose{{1.0, 0.0, 0.0, 0.0}, {i < 60 ? 0.0 : 0.6, 0.0, 0.0}};
    };
    expect_foveae_as_without_jumps(foveae_of(rows_of(120, moved, kAlwaysValid)),
                                   foveae_of(rows_of(120, kNeverMoved, kAlwaysValid)));
}

TEST(TraceSource, KeepsTheFoveaOverJumpsInARow) {
    const auto twice = [](std::size_t i) {
        return gaze::Pose{yaw_pitch(i < 60 ? 0.0 : i == 60 ? 120.0 : -45.0, 0.0), {}};
    };
    expect_foveae_as_without_jumps(foveae_of(rows_of(120, twice, kAlwaysValid)),
                                   foveae_of(rows_of(120, kNeverMoved, kAlwaysValid)), 2);
}

TEST(TraceSource, KeepsHeldAndReturningFoveaeWhereTheOriginMoves) {
    // A blink from row 40 on: held until 150 ms later (row 57), back 150 ms later (row 75).
    const auto blink = [](std::size_t i) { return i < 40 || i >= 85; };
    for (const std::size_t at : {45U, 65U, 80U}) {
        const auto recentred = [at](std::size_t i) {
            return i < at ? gaze::Pose{} : gaze::Pose{yaw_pitch(90.0, 0.0), {}};
        };
        SCOPED_TRACE(at);
        expect_foveae_as_without_jumps(foveae_of(rows_of(120, recentred, blink)),
                                       foveae_of(rows_of(120, kNeverMoved, blink)));
    }
}

TEST(TraceSource, KeepsTheFoveaWhereTheHeadIsUnknownWhileTheOriginMoves) {
    const auto recentred = [](std::size_t i) {
        return i < 60 ? gaze::Pose{} : gaze::Pose{yaw_pitch(90.0, 0.0), {}};
    };
    const auto with_gap = [](std::vector<gaze::GazeSample> rows) {
        rows[59].head.reset();
        rows[60].head.reset();
        return rows;
    };
    expect_foveae_as_without_jumps(foveae_of(with_gap(rows_of(120, recentred, kAlwaysValid))),
                                   foveae_of(with_gap(rows_of(120, kNeverMoved, kAlwaysValid))), 3);
}

TEST(TraceSource, JudgesHeadsAsRecordedHoweverFastItPlays) {
    TraceSource source(trace_of(rows_of(120, kNeverMoved, kAlwaysValid)), 0, 0, 200.0);
    std::vector<gaze::GazeSample> samples;
    source.poll(kSecond_ns, samples);
    ASSERT_EQ(samples.size(), 120U);
    EXPECT_EQ(samples[60].sampled.ns, std::llround(60.0 * static_cast<double>(kRow_ns) / 200.0));
    // 4000 deg/s as it is played, 20 as it was recorded.
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    expect_near(samples[90].head->orientation * ahead, yaw_pitch(15.0, 0.0) * ahead);
}

TEST(TraceSource, GivesTheHeadTrackInHostTime) {
    std::vector<gaze::GazeSample> recorded{sample_at(0), sample_at(kSecond_ns)};
    recorded[0].head = gaze::Pose{};
    recorded[1].head = gaze::Pose{yaw_pitch(0.0, 0.0), {0.0, 2.0, 0.0}};
    const TraceSource source(trace_of(recorded), kStart_ns, 50);
    ASSERT_NE(source.head_track(), nullptr);
    expect_near(source.head_track()->at(kStart_ns + kSecond_ns / 4).position_m, {0.0, 0.5, 0.0});
}

TEST(TraceSource, DescribesItself) {
    gaze::GazeTrace trace = trace_of({sample_at(0), sample_at(100)});
    EXPECT_EQ(TraceSource(trace, 0, 0).description(), "trace gaze.csv (HTC Vive Pro, 2 samples)");
    trace.report.lost_by_tracker = 4;
    trace.report.add({.kind = gaze::TraceFindingKind::OutOfOrder,
                      .line = 2,
                      .rows = 3,
                      .dropped = 0,
                      .span_ns = 0,
                      .text = {}});
    trace.report.add({.kind = gaze::TraceFindingKind::Repeat,
                      .line = 5,
                      .rows = 2,
                      .dropped = 2,
                      .span_ns = 0,
                      .text = {}});
    EXPECT_EQ(TraceSource(trace, 0, 0).description(),
              "trace gaze.csv (HTC Vive Pro, 2 samples, 4 lost by the tracker, 2 dropped, 3 out of "
              "order)");
}

}  // namespace
}  // namespace gazeloop::drivers
