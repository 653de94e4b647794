#include "runtime/report/perfetto/perfetto_observer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/unit/report/perfetto/drawn_session.h"

namespace gazeloop::report::perfetto {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kMs;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using tests::PerfettoTrace;

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();

auto slice_ms(const std::string& name, std::int64_t begin_ms, std::int64_t end_ms) {
    return AllOf(Field("name", &PerfettoTrace::Slice::name, name),
                 Field("begin_ns", &PerfettoTrace::Slice::begin_ns, begin_ms * kMs),
                 Field("end_ns", &PerfettoTrace::Slice::end_ns, end_ms * kMs));
}

time::Stamp measured_ms(std::int64_t ms) { return {ms * kMs, time::StampKind::Measured}; }

std::vector<std::string> tracks_of(const std::vector<PerfettoTrace::Slice>& slices) {
    std::vector<std::string> tracks;
    for (const PerfettoTrace::Slice& slice : slices) {
        if (std::ranges::find(tracks, slice.track) == tracks.end()) {
            tracks.push_back(slice.track);
        }
    }
    return tracks;
}

// Frame 1 of the examples is woken up at 10 ms.
TEST(PerfettoObserver, DrawsAFrameAtTheSessionsTimes) {
    DrawnSession session;
    frame::FrameRecord frame = example_frame(1);
    frame.stamps.filtered = {frame.stamps.latch.ns + kMs / 2, time::StampKind::Measured};
    frame.stamps.present = measured_ms(20);
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.ready = measured_ms(9);
    }
    session.add(frame);
    session.add(example_gpu(1));
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(trace.on("tracker"),
                ElementsAre(slice_ms("tracker", 7, 9), slice_ms("delivery", 9, 10)));
    EXPECT_THAT(trace.on("gaze"), ElementsAre(slice_ms("queue", 10, 12)));
    const auto loop = trace.on("loop");
    ASSERT_THAT(loop, SizeIs(6));
    EXPECT_THAT(loop[0], slice_ms("frame", 10, 14));
    EXPECT_THAT(loop[1], slice_ms("begin", 10, 11));
    EXPECT_THAT(loop[2], slice_ms("latch", 11, 12));
    EXPECT_EQ(loop[3].name, "filter");
    EXPECT_EQ(loop[3].begin_ns, 12 * kMs);
    EXPECT_EQ(loop[3].end_ns, 12 * kMs + kMs / 2);
    EXPECT_EQ(loop[4].name, "submit");
    EXPECT_EQ(loop[4].end_ns, 13 * kMs);
    EXPECT_THAT(loop[5], slice_ms("end_frame", 13, 14));
    EXPECT_EQ(loop[0].depth, 0U);
    EXPECT_EQ(loop[5].depth, 1U);
    EXPECT_THAT(trace.on("gpu"), ElementsAre(slice_ms("gpu", 13, 17)));
    EXPECT_THAT(trace.on("runtime"),
                ElementsAre(slice_ms("present", 14, 20), slice_ms("display", 20, 23)));
    EXPECT_THAT(trace.on("display: photon"), ElementsAre(slice_ms("photon", 23, 23)));
    EXPECT_THAT(session.observer().unshown().texts(), IsEmpty());
}

TEST(PerfettoObserver, SaysHowEachTimeWasObtained) {
    DrawnSession session;
    session.add_examples(1, 1);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.on("loop")[0].annotations,
                UnorderedElementsAre(Pair("kind", "measured"), Pair("frame", "1")));
    EXPECT_THAT(trace.on("tracker")[0].annotations,
                UnorderedElementsAre(Pair("begin_kind", "profile"), Pair("end_kind", "measured"),
                                     Pair("sequence", "2")));
    EXPECT_EQ(trace.on("display: photon")[0].annotations.at("kind"), "predicted");
    EXPECT_EQ(trace.on("display: photon")[0].annotations.at("gaze_age_ms"), "16");
}

TEST(PerfettoObserver, JoinsTheSampleToItsPhoton) {
    DrawnSession session;
    session.add_examples(1, 3);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    for (std::uint64_t index = 1; index < 4; ++index) {
        const auto at = static_cast<std::int64_t>(index) * 10;
        EXPECT_THAT(trace.flow(index + 1),
                    ElementsAre(slice_ms("tracker", at - 3, at), slice_ms("queue", at, at + 2),
                                slice_ms("submit", at + 2, at + 3), slice_ms("gpu", at + 3, at + 7),
                                slice_ms("photon", at + 13, at + 13)));
    }
}

TEST(PerfettoObserver, DrawsASampleOnceAndSaysWhereItIsReused) {
    DrawnSession session;
    frame::FrameRecord next = example_frame(2);
    next.fovea.eyes = example_frame(1).fovea.eyes;
    session.add(example_frame(1));
    session.add(next);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.on("tracker"), SizeIs(1));
    const auto queues = trace.named("queue");
    ASSERT_THAT(queues, ElementsAre(slice_ms("queue", 10, 12), slice_ms("queue", 10, 22)));
    EXPECT_FALSE(queues[0].annotations.contains("reused"));
    EXPECT_EQ(queues[1].annotations.at("reused"), "1");
    EXPECT_EQ(trace.flow(3).front().name, "queue");
}

TEST(PerfettoObserver, GivesFramesThatOverlapTracksOfTheirOwn) {
    DrawnSession session;
    session.add_examples(1, 20, 25);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    const auto frames = trace.named("gpu");
    ASSERT_THAT(frames, SizeIs(20));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto submit_ms = static_cast<std::int64_t>(i + 1) * 10 + 3;
        EXPECT_THAT(frames[i], slice_ms("gpu", submit_ms, submit_ms + 25));
        EXPECT_EQ(frames[i].depth, 0U);
    }
    EXPECT_THAT(tracks_of(frames), UnorderedElementsAre("gpu", "gpu (2)", "gpu (3)"));
    EXPECT_THAT(tracks_of(trace.named("frame")), ElementsAre("loop"));
}

TEST(PerfettoObserver, CountsWhatOverlapsWithMoreThanThereAreTracksFor) {
    DrawnSession session;
    session.add_examples(1, 40, 200);  // at most 21 at once
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    const std::uint64_t lacking = session.unshown(Subject::Gpu, WhyUnshown::TooMany);
    EXPECT_GT(lacking, 0U);
    EXPECT_EQ(trace.named("gpu").size() + lacking, 40U);
}

frame::FrameGpuRecord gpu_with_starts(std::int64_t pass_i_ms, std::int64_t resolve_ms) {
    frame::FrameGpuRecord gpu = example_gpu(1);  // 13 to 17 ms; pass_i 3 ms, resolve 1 ms
    gpu.pass_starts.set(0, pass_i_ms * kMs);
    gpu.pass_starts.set(2, resolve_ms * kMs);
    return gpu;
}

TEST(PerfettoObserver, DrawsPassesInTheGpusFrame) {
    DrawnSession session;
    session.add(example_frame(1));
    frame::FrameGpuRecord gpu = gpu_with_starts(0, 3);
    gpu.clock_deviation_ns = 40;
    session.add(gpu);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    const auto drawn = trace.on("gpu");
    EXPECT_THAT(drawn, ElementsAre(slice_ms("gpu", 13, 17), slice_ms("pass_i", 13, 16),
                                   slice_ms("resolve", 16, 17)));
    EXPECT_EQ(drawn[2].depth, 1U);
    EXPECT_EQ(drawn[0].annotations.at("clock_deviation_ns"), "40");
}

TEST(PerfettoObserver, DrawsPassesThatOverlapOrStickOutOnTracksOfTheirOwn) {
    DrawnSession session;
    session.add(example_frame(1));
    session.add(gpu_with_starts(2, 3));  // pass_i 15 to 18, resolve 16 to 17
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(trace.on("gpu"), ElementsAre(slice_ms("gpu", 13, 17), slice_ms("resolve", 16, 17)));
    EXPECT_THAT(trace.on("gpu (2)"), ElementsAre(slice_ms("pass_i", 15, 18)));
}

TEST(PerfettoObserver, LeadsTheArrowToTheFirstPassAfterTheGazeWasRead) {
    DrawnSession session;
    frame::FrameRecord frame = example_frame(1);
    frame.stamps.latch = measured_ms(15);
    frame.stamps.submit = measured_ms(16);
    frame.stamps.end_frame = measured_ms(17);
    session.add(frame);
    session.add(gpu_with_starts(0, 3));  // pass_i 13 to 16, resolve 16 to 17
    EXPECT_THAT(session.read().flow(2),
                ElementsAre(slice_ms("tracker", 7, 10), slice_ms("queue", 10, 15),
                            slice_ms("submit", 15, 16), slice_ms("resolve", 16, 17),
                            slice_ms("photon", 23, 23)));
}

TEST(PerfettoObserver, DrawsNoSliceOfUnknownTimesAndCountsThem) {
    DrawnSession session;
    frame::FrameRecord frame = example_frame(1);
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.sampled = {};
        eye.arrived = {};
    }
    session.add(frame);  // its GPU part never came
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(trace.on("tracker"), IsEmpty());
    EXPECT_THAT(trace.on("gpu"), IsEmpty());
    EXPECT_THAT(trace.counted("gaze age at display"), IsEmpty());
    EXPECT_THAT(trace.flow(2), ElementsAre(slice_ms("submit", 12, 13), slice_ms("photon", 23, 23)));
    EXPECT_THAT(session.observer().unshown().texts(),
                ElementsAre("what is of unknown time: 1 of tracker, 1 of gaze, 1 of gpu, "
                            "1 of runtime"));
}

TEST(PerfettoObserver, DrawsStatesOfEachEyeForAsLongAsTheyLast) {
    DrawnSession session;
    session.add_examples(1, 2);
    for (std::uint64_t index = 3; index < 6; ++index) {
        frame::FrameRecord frame = example_frame(index);
        frame.fovea.eyes[0].state = gaze::FoveaState::Held;
        frame.fovea.eyes[0].reason = gaze::LossReason::Invalid;
        session.add(frame);
    }
    session.add_examples(6, 2);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    const auto left = trace.on("left eye");
    ASSERT_THAT(left, ElementsAre(slice_ms("tracking", 12, 32), slice_ms("held", 32, 62),
                                  slice_ms("tracking", 62, 72)));
    EXPECT_EQ(left[1].annotations.at("reason"), "invalid");
    EXPECT_THAT(trace.on("right eye"), ElementsAre(slice_ms("tracking", 12, 72)));
    // No fresh sample: no wait of one, and arrows from the latch.
    EXPECT_THAT(trace.named("queue"), SizeIs(4));
    EXPECT_EQ(trace.flow(4).front().name, "submit");
}

TEST(PerfettoObserver, SaysThatFramesAreLackingAndEndsTheStatesBeforeThem) {
    DrawnSession session;
    session.add_examples(1, 2);
    session.add_examples(7, 2);
    const PerfettoTrace trace = session.read();
    const auto lacking = trace.on("events");
    ASSERT_THAT(lacking, ElementsAre(slice_ms("frames lacking", 70, 70)));
    EXPECT_EQ(lacking[0].annotations.at("count"), "4");
    EXPECT_THAT(trace.on("left eye"),
                ElementsAre(slice_ms("tracking", 12, 22), slice_ms("tracking", 72, 82)));
    EXPECT_THAT(trace.counted("frame interval"), SizeIs(2));
}

TEST(PerfettoObserver, DrawsOfAFrameThatWasNotRenderedTheLoopAlone) {
    DrawnSession session;
    frame::FrameRecord frame = example_frame(1);
    frame.should_render = false;
    frame.stamps.latch = {};
    frame.stamps.submit = {};
    session.add(frame);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.slices,
                ElementsAre(slice_ms("frame, not rendered", 10, 14), slice_ms("begin", 10, 11)));
    EXPECT_THAT(session.observer().unshown().texts(), IsEmpty());
}

PerfettoConfig rolling_display() {
    PerfettoConfig config;
    config.session.period_ns = latency::kExamplePeriodNs;
    config.session.rolling_ns = 8 * kMs;
    config.session.persistence_ns = 2 * kMs;
    config.session.switching_ns = kMs;
    return config;
}

frame::FrameRecord frame_looking_at(double share_of_height) {
    frame::FrameRecord frame = example_frame(1);
    for (std::size_t eye = 0; eye < 2; ++eye) {
        frame.views[eye].height_px = 100;
        frame.fovea.eyes[eye].position.y_px = 100.0 * share_of_height;
    }
    return frame;
}

TEST(PerfettoObserver, DrawsWhatTheProfileKnowsOfTheDisplay) {
    DrawnSession session(rolling_display());
    session.add(frame_looking_at(0.0));  // shown at 23 ms, its first row 4 ms before
    session.add(example_gpu(1));
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(trace.on("display: scan-out"), ElementsAre(slice_ms("scan-out", 19, 27)));
    EXPECT_THAT(trace.on("display: light"), ElementsAre(slice_ms("light", 18, 20)));
    EXPECT_THAT(trace.on("display: switching"), ElementsAre(slice_ms("switching", 19, 20)));
    EXPECT_THAT(trace.on("display: photon"), ElementsAre(slice_ms("photon", 20, 20)));
    const auto age = trace.counted("gaze age at display");
    ASSERT_THAT(age, SizeIs(1));
    EXPECT_EQ(age[0].ns, 20 * kMs);
    EXPECT_EQ(age[0].value, 13.0);
}

TEST(PerfettoObserver, TakesNothingFromTheProfileOfAnotherDisplay) {
    DrawnSession session(rolling_display());
    frame::FrameRecord frame = frame_looking_at(0.0);
    frame.period_ns = 7 * kMs;
    session.add(frame);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.on("display: scan-out"), IsEmpty());
    EXPECT_THAT(trace.on("display: photon"), ElementsAre(slice_ms("photon", 23, 23)));
}

TEST(PerfettoObserver, CountsGazeAgeIntervalAndSamples) {
    DrawnSession session;
    session.add_examples(1, 2);
    const PerfettoTrace trace = session.read();
    const auto values = [&trace](std::string_view track) {
        std::vector<std::pair<std::int64_t, double>> all;
        for (const PerfettoTrace::Count& count : trace.counted(track)) {
            all.emplace_back(count.ns / kMs, count.value);
        }
        return all;
    };
    EXPECT_THAT(values("gaze age at display"), ElementsAre(Pair(23, 16.0), Pair(33, 16.0)));
    EXPECT_THAT(values("frame interval"), ElementsAre(Pair(20, 10.0)));
    EXPECT_THAT(values("samples shaded"), ElementsAre(Pair(10, 1000.0), Pair(20, 1000.0)));
}

TEST(PerfettoObserver, PutsEventsOnTracksByWhatTheyAreAbout) {
    DrawnSession session;
    session.add_event(measured_ms(1), "gaze", "left held");
    session.add_event(measured_ms(2), "budget-broken", "total");
    session.add_event(measured_ms(3), "session", std::string(240, 'x'));
    session.add_event({}, "gaze-source", "sim");
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(trace.on("gaze events"), ElementsAre(slice_ms("gaze", 1, 1)));
    EXPECT_THAT(trace.on("budget"), ElementsAre(slice_ms("budget-broken", 2, 2)));
    ASSERT_THAT(trace.on("events"), ElementsAre(slice_ms("session", 3, 3)));
    EXPECT_EQ(trace.on("events")[0].annotations.at("text"), std::string(240, 'x'));
    EXPECT_EQ(session.unshown(Subject::Events, WhyUnshown::Unknown), 1U);
}

gaze::GazeSample sample(std::uint64_t sequence, bool valid = true) {
    gaze::GazeSample one;
    one.sequence = sequence;
    one.sampled = measured_ms(static_cast<std::int64_t>(sequence) + 1);
    one.arrived = measured_ms(static_cast<std::int64_t>(sequence) + 2);
    one.eyes[0].valid = valid;
    return one;
}

void add_samples(DrawnSession& session) {
    for (const std::uint64_t sequence : {1U, 2U, 5U, 4U}) {
        session.add(sample(sequence, sequence != 2));
    }
}

TEST(PerfettoObserver, DrawsEachSampleIfAsked) {
    DrawnSession session({.samples = SampleDetail::All});
    add_samples(session);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_THAT(
        trace.on("samples"),
        UnorderedElementsAre(slice_ms("sample", 3, 3), slice_ms("sample, no eye valid", 4, 4),
                             slice_ms("lost", 7, 7), slice_ms("sample", 7, 7),
                             slice_ms("out of order", 6, 6), slice_ms("sample", 6, 6)));
    EXPECT_EQ(session.observer().samples_left_out(), 0U);
}

TEST(PerfettoObserver, ElseDrawsThoseThatFramesRestedOnAndCountsTheRest) {
    DrawnSession session;
    add_samples(session);
    session.add_examples(1, 1);  // rests on sample 2
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.on("samples"),
                ElementsAre(slice_ms("out of order", 6, 6), slice_ms("lost", 7, 7)));
    EXPECT_EQ(session.observer().samples_left_out(), 3U);
}

TEST(PerfettoObserver, ReadsWhatBecameOfSamplesWhereItIsNotToldOfEach) {
    DrawnSession session;
    session.add_examples(1, 1);  // latches at 12 ms
    session.add(frame::FrameGaze{.index = 1, .counts = {.received = 3, .lost = 2}, .error = {}});
    session.add_examples(2, 1);  // 10 ms later
    session.add(frame::FrameGaze{
        .index = 2, .counts = {.received = 4, .lost = 2, .out_of_order = 1}, .error = {}});
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    const auto samples = trace.on("samples");
    ASSERT_THAT(samples, ElementsAre(slice_ms("lost", 12, 12), slice_ms("out of order", 22, 22)));
    EXPECT_EQ(samples[0].annotations.at("count"), "2");
    EXPECT_EQ(samples[1].annotations.at("count"), "1");
    EXPECT_EQ(session.observer().samples_left_out(), 2U);
}

TEST(PerfettoObserver, StatesTheClockOfWallTime) {
    DrawnSession session;
    session.add_examples(1, 1);
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_EQ(trace.clock, 3U);  // CLOCK_MONOTONIC
    EXPECT_EQ(trace.clock_reading_ns, 12 * kMs);
}

TEST(PerfettoObserver, StatesNoClockForVirtualTimeAndTakesTheModelledGpu) {
    DrawnSession session({.session = {.clock = latency::LoopClock::Virtual}});
    frame::FrameRecord frame = example_frame(1, time::StampKind::Modelled);
    frame.stamps.gpu_begin = {13 * kMs, time::StampKind::Modelled};
    frame.stamps.gpu_end = {15 * kMs, time::StampKind::Modelled};
    session.add(frame);
    session.add(gpu_with_starts(0, 3));
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_EQ(trace.clock, std::nullopt);
    EXPECT_THAT(trace.on("gpu"), ElementsAre(slice_ms("gpu", 13, 15)));
    EXPECT_EQ(trace.on("gpu")[0].annotations.at("kind"), "modelled");
}

TEST(PerfettoObserver, OfNothingIsATrace) {
    for (const latency::LoopClock clock : {latency::LoopClock::Wall, latency::LoopClock::Virtual}) {
        DrawnSession session({.session = {.clock = clock}});
        const PerfettoTrace trace = session.read();
        EXPECT_THAT(trace.faults, IsEmpty());
        EXPECT_THAT(trace.slices, IsEmpty());
        EXPECT_GT(trace.packets, 0U);
    }
}

TEST(PerfettoObserver, BearsTimesAtTheEndsOfTheirRange) {
    DrawnSession session;
    for (const std::int64_t ns : {kLeast, std::int64_t{-1}, std::int64_t{0}, kGreatest}) {
        frame::FrameRecord frame = example_frame(1);
        const time::Stamp extreme{ns, time::StampKind::Measured};
        frame.index = static_cast<std::uint64_t>(ns);
        frame.stamps.wake_up = extreme;
        frame.stamps.display = extreme;
        frame.fovea.eyes[0].sampled = extreme;
        session.add(frame);
    }
    const PerfettoTrace trace = session.read();
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_GT(session.unshown(Subject::Photon, WhyUnshown::OutOfRange), 0U);
    EXPECT_GT(session.unshown(Subject::Loop, WhyUnshown::Backwards), 0U);
}

TEST(PerfettoObserver, KeepsItsMemoryHoweverLongTheSession) {
    std::uint64_t bytes = 0;
    PerfettoObserver observer({.session = {.passes = latency::kExamplePasses}},
                              [&bytes](std::string_view piece) { bytes += piece.size(); });
    std::uint64_t index = 1;
    const auto add_frames = [&](std::uint64_t count) {
        for (const std::uint64_t end = index + count; index < end; ++index) {
            observer.on_frame(example_frame(index));
            observer.on_gpu(example_gpu(index));
        }
    };
    add_frames(100);
    const std::size_t before = tests::allocations_of_this_thread();
    add_frames(5000);
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_GT(bytes, 0U);
    observer.finish();
    EXPECT_LT(static_cast<double>(observer.bytes()) / 5100.0, 1000.0);
}

}  // namespace
}  // namespace gazeloop::report::perfetto
