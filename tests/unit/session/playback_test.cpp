#include "runtime/session/playback.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/latency/gaze_errors.h"
#include "runtime/latency/sample_counter.h"
#include "runtime/session/session_recorder.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::session {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Writes down what it is told.
class Told final : public frame::FrameObserver {
  public:
    void on_hidden(const gaze::HiddenChange& change) override {
        calls.push_back(fmt::format("hidden {}", change.frame));
    }
    void on_origin(const gaze::OriginChange& change) override {
        calls.push_back(fmt::format("origin {}", change.frame));
    }
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override {
        calls.push_back(fmt::format("sample {} of {}", sample.sequence, frame));
    }
    void on_frame(const frame::FrameRecord& record) override {
        calls.push_back(fmt::format("frame {}", record.index));
    }
    void on_gpu(const frame::FrameGpuRecord& record) override {
        calls.push_back(fmt::format("gpu {}", record.index));
    }
    void on_event(time::Stamp, std::string_view kind, std::string_view text) override {
        calls.push_back(fmt::format("{}: {}", kind, text));
    }

    std::vector<std::string> calls;
};

class Playback : public ::testing::Test {
  protected:
    void start() { recorder_ = value_or_throw(SessionRecorder::create(file, {})); }
    void add_sample(std::uint64_t sequence, std::uint64_t frame) {
        gaze::GazeSample sample;
        sample.sequence = sequence;
        recorder_->add(sample, frame);
    }
    void add_frame(std::uint64_t index) {
        recorder_->add(latency::example_frame(index));
        recorder_->add(latency::example_gpu(index));
    }
    void add_event(std::int64_t time_ms, std::string_view kind, std::string_view text) {
        recorder_->event({time_ms * latency::kMs, time::StampKind::Measured}, kind, text);
    }
    std::vector<std::string> played() {
        recorder_->close();
        Told told;
        const std::array<frame::FrameObserver*, 1> observers{&told};
        end = value_or_throw(play(file, observers));
        return told.calls;
    }

    tests::TemporaryFolder folder;
    std::filesystem::path file = folder / "run.session";
    std::unique_ptr<SessionRecorder> recorder_;
    PlaybackEnd end;
};

TEST_F(Playback, TellsEachFrameAfterWhatItConsumed) {
    start();
    recorder_->add(gaze::HiddenChange{0, nullptr});
    add_sample(1, 0);
    add_frame(0);
    recorder_->add(gaze::OriginChange{.frame = 1});
    add_sample(2, 1);
    add_sample(3, 1);
    recorder_->add(latency::example_frame(1));
    recorder_->add(gaze::HiddenChange{2, nullptr});
    add_frame(2);
    EXPECT_THAT(played(), ElementsAre("hidden 0", "sample 1 of 0", "frame 0", "gpu 0", "origin 1",
                                      "sample 2 of 1", "sample 3 of 1", "frame 1", "hidden 2",
                                      "frame 2", "gpu 2"));
    EXPECT_EQ(end.last_frame, 2U);
    EXPECT_EQ(end.last_error, std::nullopt);
}

TEST_F(Playback, TellsWhatBelongsToFramesThatAreLacking) {
    start();
    recorder_->add(gaze::HiddenChange{3, nullptr});
    add_sample(1, 4);
    add_frame(5);
    add_sample(2, 6);
    recorder_->add(gaze::HiddenChange{7, nullptr});
    add_event(1000, "loop", "late");
    EXPECT_THAT(played(), ElementsAre("hidden 3", "sample 1 of 4", "frame 5", "gpu 5", "hidden 7",
                                      "sample 2 of 6", "loop: late"));
    EXPECT_EQ(end.last_frame, 5U);
}

// Frame k of the examples ends at 10 k + 4 ms.
TEST_F(Playback, TellsEventsInTheirOrderAndBeforeTheFrameThatEndsAfterThem) {
    start();
    recorder_->event({}, "gaze-source", "sim");
    add_sample(1, 0);
    add_frame(0);
    add_event(4, "gaze", "at the end of frame 0");
    add_event(12, "gaze", "in frame 1");
    add_frame(1);
    add_event(30, "error", "in frame 3");
    add_event(11, "loop", "told after that");
    add_frame(2);
    add_frame(3);
    add_event(99, "error", "the last");
    EXPECT_THAT(played(),
                ElementsAre("sample 1 of 0", "gaze-source: sim", "gaze: at the end of frame 0",
                            "frame 0", "gpu 0", "gaze: in frame 1", "frame 1", "gpu 1", "frame 2",
                            "gpu 2", "error: in frame 3", "loop: told after that", "frame 3",
                            "gpu 3", "error: the last"));
    EXPECT_EQ(end.last_error, "the last");
}

/// What both ways of playing tell of the gaze.
class GazeTold final : public frame::FrameObserver {
  public:
    void on_sample(const gaze::GazeSample& sample, std::uint64_t) override {
        ++samples;
        counter.add(sample);
        errors.add(sample);
    }
    void on_frame(const frame::FrameRecord& record) override {
        errors.add(record);
        errors.set_shown(record.index, record.stamps.display);
        errors.take_decided([this](std::uint64_t index, const auto& error) {
            from_samples.push_back({index, {}, error});
        });
    }
    void on_gaze(const frame::FrameGaze& one) override { told.push_back(one); }

    std::uint64_t samples = 0;
    latency::SampleCounter counter;
    latency::GazeErrors errors;
    std::vector<frame::FrameGaze> from_samples;
    std::vector<frame::FrameGaze> told;
};

class PlaybackOfCounts : public Playback {
  protected:
    void record(std::uint64_t frames) {
        start();
        for (std::uint64_t index = 0; index < frames; ++index) {
            for (std::int64_t ms = 0; ms < 10; ++ms) {
                gaze::GazeSample sample;
                sample.sequence = index * 11 + static_cast<std::uint64_t>(ms);  // loses some
                sample.sampled = {(static_cast<std::int64_t>(index) * 10 + ms - 12) * latency::kMs,
                                  time::StampKind::Measured};
                sample.eyes[0].valid = index % 5 != 2;
                sample.eyes[0].direction =
                    glm::dvec3{std::sin(static_cast<double>(index)), 0.0, -1.0};
                sample.head = gaze::Pose{};
                recorder_->add(sample, index);
            }
            frame::FrameRecord frame = latency::example_frame(index);
            frame.fovea.eyes[0].state =
                index % 7 == 3 ? gaze::FoveaState::Held : gaze::FoveaState::Tracking;
            recorder_->add(frame);
            if (index >= 3) {
                recorder_->add(latency::example_gpu(index - 3));
            }
        }
    }
    void play_gaze(PlayedGaze gaze, GazeTold& told) {
        const std::array<frame::FrameObserver*, 1> observers{&told};
        const OpenSession session = value_or_throw(OpenSession::open(file));
        value_or_throw(play(session, observers, gaze));
    }
    bool counted() {
        return value_or_throw(has_gaze_counts(value_or_throw(OpenSession::open(file))));
    }
};

TEST_F(PlaybackOfCounts, TellsWithoutSamplesWhatTheseWouldTell) {
    record(300);
    recorder_->close();
    ASSERT_TRUE(counted());
    GazeTold samples;
    GazeTold counts;
    play_gaze(PlayedGaze::Samples, samples);
    play_gaze(PlayedGaze::Counts, counts);
    EXPECT_EQ(samples.samples, 3000U);
    EXPECT_TRUE(samples.told.empty());
    EXPECT_EQ(counts.samples, 0U);
    ASSERT_EQ(counts.told.size(), 300U);
    EXPECT_EQ(counts.told.back().counts, samples.counter.counts());
    EXPECT_GT(samples.counter.counts().lost, 0U);
    samples.errors.finish();
    samples.errors.take_decided([&samples](std::uint64_t index, const auto& error) {
        samples.from_samples.push_back({index, {}, error});
    });
    ASSERT_EQ(samples.from_samples.size(), 300U);
    std::size_t known = 0;
    for (std::size_t row = 0; row < counts.told.size(); ++row) {
        EXPECT_EQ(counts.told[row].index, samples.from_samples[row].index);
        EXPECT_EQ(counts.told[row].error, samples.from_samples[row].error) << row;
        known += counts.told[row].error && counts.told[row].error->radians ? 1 : 0;
    }
    EXPECT_GT(known, 100U);
}

TEST_F(PlaybackOfCounts, AreNotThereForSamplesBehindTheLastFrame) {
    record(5);
    add_sample(99, 5);
    recorder_->close();
    EXPECT_FALSE(counted());
}

TEST_F(PlaybackOfCounts, AreThereForNothing) {
    start();
    recorder_->close();
    EXPECT_TRUE(counted());
    GazeTold counts;
    play_gaze(PlayedGaze::Counts, counts);
    EXPECT_TRUE(counts.told.empty());
}

TEST_F(Playback, OfNothingEndsWithNothing) {
    start();
    EXPECT_THAT(played(), ElementsAre());
    EXPECT_EQ(end.last_frame, std::nullopt);
    EXPECT_EQ(end.last_error, std::nullopt);
}

TEST_F(Playback, TellsEveryObserver) {
    start();
    add_frame(0);
    recorder_->close();
    Told first;
    Told second;
    const std::array<frame::FrameObserver*, 2> observers{&first, &second};
    value_or_throw(play(file, observers));
    EXPECT_THAT(first.calls, ElementsAre("frame 0", "gpu 0"));
    EXPECT_EQ(second.calls, first.calls);
}

TEST_F(Playback, PassesOnWhatAnObserverThrows) {
    class Thrower final : public frame::FrameObserver {
        void on_frame(const frame::FrameRecord&) override { throw std::logic_error("enough"); }
    };
    start();
    add_frame(0);
    recorder_->close();
    Thrower thrower;
    const std::array<frame::FrameObserver*, 1> observers{&thrower};
    EXPECT_THROW(value_or_throw(play(file, observers)), std::logic_error);
}

TEST_F(Playback, NamesAFileThatIsNone) {
    const auto end_of_none = play(file, {});
    ASSERT_FALSE(end_of_none);
    EXPECT_EQ(end_of_none.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(end_of_none.error().message, HasSubstr(file.string()));
}

// What a longer session would take more of shows in a count: nothing is asked for frame by frame.
TEST_F(Playback, TakesNoMoreMemoryForALongerSession) {
    const auto allocations_over = [this](std::uint64_t frames) {
        std::filesystem::remove(file);
        start();
        for (std::uint64_t index = 0; index < frames; ++index) {
            for (std::uint64_t sample = 0; sample < 11; ++sample) {
                add_sample(11 * index + sample, index);
            }
            add_frame(index);
        }
        EXPECT_TRUE(recorder_->close().complete());
        const std::size_t before = tests::allocations_of_this_thread();
        EXPECT_EQ(value_or_throw(play(file, {})).last_frame, frames - 1);
        return tests::allocations_of_this_thread() - before;
    };
    constexpr std::uint64_t kFrames = 100;  // 20 times as many fill the recorder's queue by .8
    constexpr std::size_t kBound = 500;
    const std::size_t few = allocations_over(kFrames);
    const std::size_t many = allocations_over(20 * kFrames);
    EXPECT_LT(many, few + kBound) << "of " << few;
}

}  // namespace
}  // namespace gazeloop::session
