#include "runtime/report/runtime_metrics/wivrn_stages.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::kMs;
using ::testing::HasSubstr;
using ::testing::Not;

std::size_t stage(std::string_view key) {
    const auto* const at = std::ranges::find(kWivrnStages, key, &WivrnStage::key);
    EXPECT_NE(at, kWivrnStages.end()) << key;
    return static_cast<std::size_t>(at - kWivrnStages.begin());
}

/// A WiVRn timing file of frames as example_frame() has them.
class Timings {
  public:
    void add(WivrnEvent event, std::uint64_t frame, std::int64_t ns, int stream = 255) {
        text_ += fmt::format("\"{}\",{},{},{}\n", kWivrnEventNames[static_cast<std::size_t>(event)],
                             frame, ns, stream);
    }

    /// Of two streams, the second one 1 ms later in all. Displayed 0.5 ms after what was announced.
    void frame(std::uint64_t index, std::uint64_t number) {
        const std::int64_t end = example_frame(index).stamps.end_frame.ns;
        add(WivrnEvent::WakeUp, number, end - 2 * kMs);
        add(WivrnEvent::Begin, number, end + kMs / 10);
        for (int stream = 0; stream < 2; ++stream) {
            const std::int64_t at = end + stream * kMs;
            add(WivrnEvent::EncodeBegin, number, at + kMs, stream);
            add(WivrnEvent::EncodeEnd, number, at + 2 * kMs, stream);
            add(WivrnEvent::SendBegin, number, at + 3 * kMs / 2, stream);
            add(WivrnEvent::SendEnd, number, at + 5 * kMs / 2, stream);
            add(WivrnEvent::ReceiveBegin, number, at + 3 * kMs, stream);
            add(WivrnEvent::ReceiveEnd, number, at + 4 * kMs, stream);
            add(WivrnEvent::DecodeBegin, number, at + 17 * kMs / 4, stream);
            add(WivrnEvent::DecodeEnd, number, at + 5 * kMs, stream);
            for (const std::int64_t again : {0, 10}) {  // it is shown twice
                add(WivrnEvent::Blit, number, end + 7 * kMs + again * kMs, stream);
                add(WivrnEvent::Display, number,
                    example_frame(index).stamps.display.ns + kMs / 2 + again * kMs, stream);
            }
        }
    }

    [[nodiscard]] WivrnStages stages() const {
        return WivrnStages(value_or_throw(
            WivrnCsvReader::open(std::make_unique<std::istringstream>(text_), "w.csv")));
    }

  private:
    std::string text_;
};

TEST(WivrnStages, AreThoseOfTheFrameWithTheNearestDisplayTime) {
    Timings timings;
    for (std::uint64_t i = 0; i < 40; ++i) {
        timings.frame(i, 500 + i);
    }
    WivrnStages stages = timings.stages();
    for (std::uint64_t i = 0; i < 40; i += 2) {  // each of ours is of two periods
        stages.on_frame(example_frame(i));
    }
    EXPECT_EQ(stages.counts().joined, 20U);
    EXPECT_EQ(stages.counts().frames, 20U);
    EXPECT_EQ(stages.streams(), 2U);
    const auto mean = [&](std::string_view key) { return stages.row(stage(key)).mean_ms; };
    EXPECT_EQ(mean("to_begin"), 0.1);
    EXPECT_EQ(mean("to_encode"), 0.9);
    EXPECT_EQ(mean("encode"), 2.0) << "from the first stream's begin to the second's end";
    EXPECT_EQ(mean("send"), 2.0);
    EXPECT_EQ(mean("network"), 1.5);
    EXPECT_EQ(mean("receive"), 2.0);
    EXPECT_EQ(mean("to_decode"), -0.75) << "the first stream is decoded while the second arrives";
    EXPECT_EQ(mean("decode"), 1.75);
    EXPECT_EQ(mean("to_blit"), 1.0);
    EXPECT_EQ(mean("to_display"), 2.5);
    EXPECT_EQ(mean("whole"), 9.5);
    EXPECT_EQ(stages.display_error().mean_ms, 0.5);
    for (const std::size_t stream : {0U, 1U}) {
        EXPECT_EQ(stages.row(stage("encode"), stream).mean_ms, 1.0);
        EXPECT_EQ(stages.row(stage("network"), stream).mean_ms, 1.5);
        EXPECT_EQ(stages.row(stage("to_decode"), stream).mean_ms, 0.25);
        EXPECT_EQ(stages.row(stage("to_blit"), stream).mean_ms, stream == 0 ? 2.0 : 1.0);
    }
    EXPECT_EQ(stages.row(stage("encode"), 2).count, 0U);
}

TEST(WivrnStages, SayOfWhichKindTheyAre) {
    Timings timings;
    timings.frame(0, 1);
    WivrnStages stages = timings.stages();
    stages.on_frame(example_frame(0));
    const auto kind = [&](std::string_view key) { return stages.row(stage(key)).kind(); };
    EXPECT_EQ(kind("to_begin"), time::StampKind::Measured);
    EXPECT_EQ(kind("encode"), time::StampKind::Measured);
    EXPECT_EQ(kind("network"), time::StampKind::Modelled) << "from one clock to another";
    EXPECT_EQ(kind("decode"), time::StampKind::Measured) << "of one clock";
    EXPECT_EQ(kind("to_display"), time::StampKind::Predicted);
    EXPECT_EQ(kind("whole"), time::StampKind::Predicted);
}

TEST(WivrnStages, LeaveOutWhatCannotBeJoined) {
    Timings timings;
    timings.frame(1, 1);
    timings.frame(3, 3);
    timings.add(WivrnEvent::EncodeBegin, 3, example_frame(3).stamps.submit.ns - 1, 0);
    WivrnStages stages = timings.stages();
    stages.on_frame(example_frame(1));
    stages.on_frame(example_frame(1));  // a second one of the same display time
    stages.on_frame(example_frame(3));
    stages.on_frame(example_frame(7));
    frame::FrameRecord unknown = example_frame(8);
    unknown.stamps.display = {};
    stages.on_frame(unknown);
    frame::FrameRecord no_period = example_frame(9);
    no_period.period_ns = 0;
    stages.on_frame(no_period);
    frame::FrameRecord not_rendered = example_frame(10);
    not_rendered.should_render = false;
    stages.on_frame(not_rendered);
    EXPECT_EQ(stages.counts().frames, 6U);
    EXPECT_EQ(stages.counts().joined, 1U);
    EXPECT_EQ(stages.counts().taken, 1U);
    EXPECT_EQ(stages.counts().too_early, 1U);
    EXPECT_EQ(stages.counts().missing, 1U);
    EXPECT_EQ(stages.counts().not_announced, 2U);
    EXPECT_THAT(stages.text(), HasSubstr("1 of 6 rendered frames joined by display time"));
    EXPECT_THAT(stages.text(), HasSubstr("nothing displayed within half a period: 1"));
}

TEST(WivrnStages, JoinUpToHalfAPeriodAway) {
    for (const std::int64_t off_ns : {-5 * kMs, 5 * kMs, 5 * kMs + 1, -5 * kMs - 1}) {
        Timings timings;
        timings.add(WivrnEvent::Display, 1, example_frame(2).stamps.display.ns + off_ns, 0);
        WivrnStages stages = timings.stages();
        stages.on_frame(example_frame(2));
        EXPECT_EQ(stages.counts().joined, std::abs(off_ns) <= 5 * kMs ? 1U : 0U) << off_ns;
    }
}

TEST(WivrnStages, AreFoundFarIntoALongFileWithAbsurdTimes) {
    Timings timings;
    constexpr std::uint64_t kFrames = 5000;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        timings.frame(i, i);
        if (i % 50 == 0) {
            timings.add(WivrnEvent::WakeUp, i, 4'000'000'000'000'000'000);
        }
    }
    WivrnStages stages = timings.stages();
    for (std::uint64_t i = 0; i < kFrames; i += 2) {
        stages.on_frame(example_frame(i));
    }
    EXPECT_EQ(stages.counts().joined, kFrames / 2);
}

TEST(WivrnStages, SayWhatTheTableMeans) {
    Timings timings;
    timings.frame(0, 1);
    timings.add(WivrnEvent::EncodeBegin, 1, 5, 9);
    WivrnStages stages = timings.stages();
    stages.on_frame(example_frame(0));
    const std::string text = stages.text();
    EXPECT_THAT(text, HasSubstr("The headset's clock is another one."));
    EXPECT_THAT(text, HasSubstr("stream 1"));
    EXPECT_THAT(text, HasSubstr("rows of more video streams than are kept apart: 1"));
    EXPECT_THAT(text, Not(HasSubstr("nan")));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 100U) << line;
    }
    const nlohmann::ordered_json json = stages.json();
    EXPECT_EQ(json["frames"]["joined"], 1);
    EXPECT_EQ(json["stages"]["encode"]["mean_ms"], 2.0);
    EXPECT_EQ(json["stages"]["encode"]["p50_ms"], nullptr) << "of one frame";
    EXPECT_EQ(json["stages"]["encode"]["streams"][1]["mean_ms"], 1.0);
    EXPECT_EQ(json["display_after_announced"]["mean_ms"], 0.5);
    EXPECT_EQ(json["rows"]["other_streams"], 1);
}

TEST(WivrnStages, SayWhenTheFileIsOfAnotherRun) {
    Timings timings;
    timings.frame(50'000, 1);
    WivrnStages stages = timings.stages();
    stages.on_frame(example_frame(100));
    EXPECT_THAT(stages.text(), HasSubstr("The file has 500."));
    EXPECT_THAT(stages.text(), HasSubstr("the session 1.000 to 1.000 s"));
}

}  // namespace
}  // namespace gazeloop::report
