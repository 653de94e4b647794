// What a session's gaze columns say is what its samples say, in every form of a report.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "runtime/report/frame_csv.h"
#include "runtime/report/page/report_page.h"
#include "runtime/report/session_json.h"
#include "runtime/report/session_summary.h"
#include "runtime/report/session_text.h"
#include "runtime/session/session_recorder.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::kMs;

/// A session as any tracker and loop may make it, and what is true of its samples.
class AnySession {
  public:
    AnySession(std::uint64_t seed, std::uint64_t frames) : random_(seed), frames_(frames) {}

    void record(const std::filesystem::path& file) {
        session::SessionHeader header;
        header.passes = latency::kExamplePasses;
        header.grids = latency::kExampleGrids;
        header.meta.display.refresh_hz = 100.0;
        const auto recorder =
            value_or_throw(session::SessionRecorder::create(file, header, session::WhenFull::Wait));
        for (std::uint64_t index = first_; index < first_ + frames_; ++index) {
            if (one_in(40)) {
                continue;  // lost on the way to the disk
            }
            if (one_in(25)) {
                recorder->add(gaze::OriginChange{
                    .frame = index,
                    .new_in_old = {glm::angleAxis(0.5, glm::dvec3{0.0, 1.0, 0.0}), {}}});
            }
            for (std::uint64_t count = random_() % 12; count > 0; --count) {
                recorder->add(sample(index), index);
            }
            const frame::FrameRecord one = frame(index);
            recorder->add(one);
            ++recorded_frames;
            if (!one_in(10)) {
                recorder->add(latency::example_gpu(index, one_in(6) ? 14 : 4));
            }
        }
        ASSERT_TRUE(recorder->close().complete());
    }

    frame::GazeCounts truth;
    std::uint64_t recorded_frames = 0;

  private:
    bool one_in(std::uint64_t count) { return random_() % count == 0; }

    gaze::GazeSample sample(std::uint64_t index) {
        gaze::GazeSample sample;
        if (!held_back_.empty() && one_in(3)) {
            sample.sequence = *held_back_.begin();  // overtaken by another
            held_back_.erase(held_back_.begin());
            ++truth.out_of_order;
            --truth.lost;
        } else if (one_in(15) && sequence_ > 0) {
            sample.sequence = sequence_;  // repeated
            ++truth.out_of_order;
        } else {
            while (sequence_ > 0 && one_in(8)) {
                ++sequence_;
                ++truth.lost;
                if (one_in(2)) {
                    held_back_.insert(sequence_);
                }
            }
            sample.sequence = ++sequence_;
        }
        sampled_ns_ = std::max(sampled_ns_, (static_cast<std::int64_t>(index) - 2) * 10 * kMs) +
                      static_cast<std::int64_t>(random_() % 3) * kMs;
        sample.sampled = {sampled_ns_, time::StampKind::Measured};
        const double turn = 0.01 * static_cast<double>(random_() % 100);
        for (gaze::EyeRay& eye : sample.eyes) {
            eye.direction = {std::sin(turn), 0.1, -std::cos(turn)};
            eye.valid = !one_in(6);
        }
        if (!one_in(20)) {
            sample.head = gaze::Pose{};
        }
        ++truth.received;
        truth.invalid += sample.eyes[0].valid || sample.eyes[1].valid ? 0 : 1;
        last_ = sample;
        return sample;
    }

    frame::FrameRecord frame(std::uint64_t index) {
        frame::FrameRecord frame = latency::example_frame(index);
        frame.should_render = !one_in(12);
        const bool fresh = last_.sequence > 0 && !one_in(5);
        for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
            eye.state = fresh ? gaze::FoveaState::Tracking : gaze::FoveaState::Held;
            eye.sample_sequence = last_.sequence;
            eye.sampled = last_.sampled;
            eye.direction = {0.0, 0.0, -1.0};
        }
        if (one_in(9)) {
            frame.stamps.display = {};
        }
        return frame;
    }

    static constexpr std::uint64_t first_ = 100;

    std::mt19937_64 random_;
    std::uint64_t frames_;
    std::uint64_t sequence_ = 0;
    std::set<std::uint64_t> held_back_;
    std::int64_t sampled_ns_ = 0;
    gaze::GazeSample last_;
};

std::string csv_of(const SessionSummary& summary) {
    std::string text;
    value_or_throw(write_frame_csv(*summary.frames, [&text](std::string_view piece) {
        text += piece;
        return Expected<void>{};
    }));
    return text;
}

/// The number beside a label of the page's table of counts.
std::string counted_on(const std::string& page, const std::string& label) {
    const std::string before = "<th scope=\"row\">" + label + "</th><td>";
    const std::size_t at = page.find(before);
    if (at == std::string::npos) {
        return "none";
    }
    const std::size_t from = at + before.size();
    return page.substr(from, page.find("</td>", from) - from);
}

void expect_recorded(std::uint64_t seed) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "any.gaze";
    AnySession any(seed, 20 + seed % 100);
    any.record(file);
    const auto session = value_or_throw(session::OpenSession::open(file));
    ASSERT_TRUE(value_or_throw(session::has_gaze_counts(session)) ||
                any.recorded_frames < 20 + seed % 100);
    const SessionSummary summary = value_or_throw(summarize(session));
    const frame::GazeCounts& truth = any.truth;
    ASSERT_EQ(summary.report.gaze, truth);
    ASSERT_EQ(summary.report.frames.total, any.recorded_frames);

    const Percentiles percentiles;
    const nlohmann::ordered_json json = session_json(summary, session.info(), percentiles);
    ASSERT_EQ(json["gaze"]["received"], truth.received);
    ASSERT_EQ(json["gaze"]["invalid"], truth.invalid);
    ASSERT_EQ(json["gaze"]["lost"], truth.lost);
    ASSERT_EQ(json["gaze"]["out_of_order"], truth.out_of_order);

    const std::string text = session_text(summary, percentiles, {});
    ASSERT_TRUE(
        text.find(fmt::format("received {}, invalid {}, lost {}, out of order {}\n", truth.received,
                              truth.invalid, truth.lost, truth.out_of_order)) != std::string::npos);

    if (seed % 8 == 0) {  // a page takes its time
        const page::EventLine events;
        const std::string page = page::report_page({.session = summary,
                                                    .info = session.info(),
                                                    .events = events,
                                                    .percentiles = percentiles,
                                                    .file = "any.gaze"});
        ASSERT_EQ(counted_on(page, "gaze samples received"), fmt::format("{}", truth.received));
        ASSERT_EQ(counted_on(page, "invalid"), fmt::format("{}", truth.invalid));
        ASSERT_EQ(counted_on(page, "lost"), fmt::format("{}", truth.lost));
        ASSERT_EQ(counted_on(page, "out of order"), fmt::format("{}", truth.out_of_order));
    }

    // Each frame says the same, whether its columns are read or its samples.
    const SessionSummary by_samples = value_or_throw(
        summarize(session, {}, {.observers = {}, .gaze = session::PlayedGaze::Samples}));
    const std::string csv = csv_of(summary);
    ASSERT_EQ(csv, csv_of(by_samples));
    ASSERT_EQ(static_cast<std::uint64_t>(std::ranges::count(csv, '\n')), any.recorded_frames + 1);
    ASSERT_EQ(summary.frames->gaze_error_gaps(), by_samples.frames->gaze_error_gaps());
    ASSERT_EQ(by_samples.report.gaze, truth);
}

TEST(GazeCounts, AreWhatWasRecordedInEveryForm) {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {  // sessions are files: they take their time
        SCOPED_TRACE(seed);
        ASSERT_NO_FATAL_FAILURE(expect_recorded(seed));
    }
}

}  // namespace
}  // namespace gazeloop::report
