#include "runtime/report/runtime_metrics/runtime_metrics_join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "runtime/latency/summary_observer.h"
#include "tests/unit/latency/example_frame.h"
#include "tests/unit/report/runtime_metrics/monado_file.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kExamplePeriodNs;
using latency::kMs;
using latency::Stage;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kSession = 2;
constexpr std::int64_t kFirstSystemFrame = 1000;

/// Keeps what it is told.
class Told final : public frame::FrameObserver {
  public:
    void on_sample(const gaze::GazeSample&, std::uint64_t frame) override {
        calls.push_back("sample " + std::to_string(frame));
    }
    void on_hidden(const gaze::HiddenChange&) override { calls.emplace_back("hidden"); }
    void on_origin(const gaze::OriginChange&) override { calls.emplace_back("origin"); }
    void on_frame(const frame::FrameRecord& record) override {
        frames.push_back(record);
        calls.push_back("frame " + std::to_string(record.index));
    }
    void on_gpu(const frame::FrameGpuRecord& record) override {
        calls.push_back("gpu " + std::to_string(record.index));
    }
    void on_event(time::Stamp, std::string_view kind, std::string_view) override {
        calls.emplace_back(kind);
    }

    std::vector<frame::FrameRecord> frames;
    std::vector<std::string> calls;
};

/// As Monado writes them of example_frame(index): the compositor's frame of the same display time
/// wants its present 4 ms before it.
class ExampleRun {
  public:
    static std::int64_t display_ns(std::uint64_t index) {
        return example_frame(index).stamps.display.ns;
    }
    static std::int64_t system_frame_of(std::uint64_t index) {
        return kFirstSystemFrame + static_cast<std::int64_t>(index);
    }

    void made(std::uint64_t index, std::int64_t session = kSession,
              std::int64_t begin_off_ns = -10'000) {
        file.session_frame({.session = session,
                            .frame = static_cast<std::int64_t>(index) + 1,
                            .display_ns = display_ns(index),
                            .begin_ns = example_frame(index).stamps.begin.ns + begin_off_ns,
                            .gpu_done_ns = example_frame(index).stamps.end_frame.ns + kMs});
    }
    void taken(std::uint64_t index, std::uint64_t by, std::int64_t session = kSession) {
        file.used(session, static_cast<std::int64_t>(index) + 1, system_frame_of(by),
                  display_ns(by) - 6 * kMs);
    }
    void planned(std::uint64_t by) {
        file.system_frame(system_frame_of(by), display_ns(by), display_ns(by) - 4 * kMs);
    }
    void presented(std::uint64_t by, std::int64_t late_ns) {
        file.present_info({.frame = system_frame_of(by),
                           .display_ns = display_ns(by),
                           .desired_ns = display_ns(by) - 4 * kMs,
                           .actual_ns = display_ns(by) - 4 * kMs + late_ns,
                           .when_ns = display_ns(by) + 20 * kMs});
    }

    /// The frames as observers are told of them.
    RuntimeMetricsJoin& play(std::uint64_t from, std::uint64_t to) {
        const std::array<frame::FrameObserver*, 2> observers{&told, &summing_};
        join.emplace(value_or_throw(file.open()), observers);
        for (std::uint64_t index = from; index < to; ++index) {
            join->on_frame(example_frame(index));
            join->on_gpu(example_gpu(index));
        }
        return *join;
    }
    [[nodiscard]] latency::SummaryReport report() const { return summary_.report(); }

    MonadoFile file;
    Told told;
    std::optional<RuntimeMetricsJoin> join;

  private:
    latency::LatencySummary summary_{{.period_ns = kExamplePeriodNs, .switching_ns = 2 * kMs}};
    latency::SummaryObserver summing_{summary_};
};

TEST(RuntimeMetricsJoin, TakesPresentAndDisplayFromWhatTheDriverSaid) {
    ExampleRun run;
    for (std::uint64_t i = 0; i < 20; ++i) {
        run.made(i);
        run.taken(i, i);
        run.presented(i, static_cast<std::int64_t>(i) * 1000);  // i us late
    }
    const RuntimeMetricsJoin& join = run.play(0, 20);
    EXPECT_EQ(join.counts().of(MonadoFate::Presented), 20U);
    ASSERT_EQ(run.told.frames.size(), 20U);
    for (std::uint64_t i = 0; i < 20; ++i) {
        const frame::FrameStamps& stamps = run.told.frames[i].stamps;
        const std::int64_t late_ns = static_cast<std::int64_t>(i) * 1000;
        EXPECT_EQ(stamps.present, (time::Stamp{ExampleRun::display_ns(i) - 4 * kMs + late_ns,
                                               time::StampKind::Measured}));
        EXPECT_EQ(stamps.shown,
                  (time::Stamp{ExampleRun::display_ns(i) + late_ns, time::StampKind::Profile}));
        EXPECT_EQ(stamps.display, example_frame(i).stamps.display) << "still what was announced";
    }
    const latency::SummaryReport report = run.report();
    // 16 ms to the announced display and 2 ms of switching; the last frame is 19 us late.
    EXPECT_EQ(report.gaze_age_at_display.min_ms, 18.0);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 18.019);
    EXPECT_EQ(report.gaze_age_at_display.kind(), time::StampKind::Profile);
    const auto& compositor = report.stages[static_cast<std::size_t>(Stage::Present)];
    EXPECT_EQ(compositor.kind(), time::StampKind::Measured);
    EXPECT_EQ(compositor.min_ms, 2.0);
    EXPECT_EQ(compositor.max_ms, 2.019);
    EXPECT_EQ(report.stages[static_cast<std::size_t>(Stage::Wait)].min_ms, 4.0);
    EXPECT_EQ(report.stages[static_cast<std::size_t>(Stage::Wait)].max_ms, 4.0);
    EXPECT_EQ(report.unaccounted.max_ms, 0.0);
    EXPECT_EQ(report.frames.missed, 0U);
    EXPECT_THAT(join.text(), HasSubstr("20 of 20 rendered frames joined"));
    EXPECT_THAT(join.text(), HasSubstr("In 20 the display's driver said"));
    EXPECT_THAT(join.text(), Not(HasSubstr("model of a display")));
}

TEST(RuntimeMetricsJoin, MarksTheTimesOfACompositorWithoutDisplayTimingAsModelled) {
    ExampleRun run;
    for (std::uint64_t i = 0; i < 20; ++i) {
        run.planned(i);
        run.made(i);
    }
    for (std::uint64_t i = 0; i < 18; ++i) {
        run.taken(i, i == 5 ? 7 : i);  // frame 5 came two periods too late
    }
    run.taken(17, 18);  // and again, since 18 was not there
    run.file.gpu_info(ExampleRun::system_frame_of(9), ExampleRun::display_ns(9),
                      ExampleRun::display_ns(9) + 1);
    const RuntimeMetricsJoin& join = run.play(0, 20);
    EXPECT_EQ(join.counts().of(MonadoFate::Modelled), 18U);
    EXPECT_EQ(join.counts().of(MonadoFate::NotTaken), 2U);
    EXPECT_EQ(join.counts().repeated, 1U);
    EXPECT_EQ(join.counts().compositor_late, 1U);
    const frame::FrameStamps& late = run.told.frames[5].stamps;
    EXPECT_EQ(late.shown, (time::Stamp{ExampleRun::display_ns(7), time::StampKind::Modelled}));
    EXPECT_EQ(late.present.kind, time::StampKind::Modelled);
    EXPECT_FALSE(run.told.frames[19].stamps.shown.known());
    EXPECT_EQ(run.told.frames[19].stamps.display, example_frame(19).stamps.display);
    const latency::SummaryReport report = run.report();
    EXPECT_EQ(report.frames.missed, 1U);
    EXPECT_EQ(report.frames.periods_missed, 2U);
    EXPECT_EQ(report.gaze_age_at_display.max_ms, 38.0);
    EXPECT_EQ(report.unaccounted.max_ms, 0.0);
    const std::string text = join.text();
    EXPECT_THAT(text, HasSubstr("18 of 20 rendered frames joined"));
    EXPECT_THAT(text, HasSubstr("Monado's model of a display"));
    EXPECT_THAT(text, HasSubstr("not joined: 2 that no frame of the compositor took"));
    EXPECT_THAT(text, HasSubstr("shown more than once: 1"));
    EXPECT_THAT(text, HasSubstr("In 1 of these the compositor's own work ended after that"));
}

TEST(RuntimeMetricsJoin, GivesAFrameThatWasNeverShownNoAgeAtDisplay) {
    ExampleRun run;
    for (std::uint64_t i = 0; i < 4; ++i) {
        run.planned(i);
        run.made(i);
    }
    for (const std::uint64_t i : {0, 2, 3}) {
        run.taken(i, i);
    }
    const RuntimeMetricsJoin& join = run.play(0, 4);
    EXPECT_EQ(join.counts().of(MonadoFate::Replaced), 1U);
    EXPECT_FALSE(run.told.frames[1].stamps.display.known());
    EXPECT_EQ(run.report().gaze_age_at_display.count, 3U);
    EXPECT_EQ(run.report().gaze_age_at_latch.count, 4U);
    EXPECT_EQ(run.report().frames.in_time_unknown, 1U);
    EXPECT_THAT(join.text(), HasSubstr("never shown: 1;"));
}

TEST(RuntimeMetricsJoin, SaysWhyAFrameIsNotJoined) {
    ExampleRun run;
    run.file.session_frame({.session = kSession,
                            .frame = 1,
                            .display_ns = ExampleRun::display_ns(0),
                            .discarded = true});
    run.made(1);
    run.taken(1, 1);  // of the compositor's frame nothing is said
    run.made(2);
    run.taken(2, 2);
    run.file.present_info({.frame = ExampleRun::system_frame_of(2),
                           .display_ns = ExampleRun::display_ns(2),
                           .desired_ns = ExampleRun::display_ns(2) - 4 * kMs,
                           .actual_ns = std::numeric_limits<std::int64_t>::max()});
    run.made(3);
    run.taken(3, 3);
    run.presented(3, 0);
    const RuntimeMetricsJoin& join = run.play(0, 5);
    EXPECT_EQ(join.counts().of(MonadoFate::Discarded), 1U);
    EXPECT_EQ(join.counts().of(MonadoFate::Untimed), 2U);
    EXPECT_EQ(join.counts().of(MonadoFate::Presented), 1U);
    EXPECT_EQ(join.counts().of(MonadoFate::Missing), 1U);
    for (const std::size_t i : {0U, 1U, 2U, 4U}) {
        EXPECT_EQ(run.told.frames[i].stamps.display, example_frame(i).stamps.display);
        EXPECT_FALSE(run.told.frames[i].stamps.shown.known());
    }
    const nlohmann::ordered_json json = join.json();
    EXPECT_EQ(json["file"], "m.pb");
    EXPECT_EQ(json["version"], "1.1");
    EXPECT_EQ(json["frames"]["rendered"], 5);
    EXPECT_EQ(json["frames"]["joined"], 1);
    EXPECT_EQ(json["frames"]["presented"], 1);
    EXPECT_EQ(json["frames"]["untimed"], 2);
    EXPECT_EQ(json["frames"]["discarded"], 1);
    EXPECT_EQ(json["frames"]["missing"], 1);
    EXPECT_EQ(json["records"]["cut_at_byte"], nullptr);
}

TEST(RuntimeMetricsJoin, JoinsNothingThatNoRuntimeAnnounced) {
    ExampleRun run;
    run.made(0);
    RuntimeMetricsJoin& join = run.play(0, 0);
    frame::FrameRecord unknown = example_frame(0);
    unknown.stamps.display = {};
    join.on_frame(unknown);
    join.on_frame(example_frame(0, time::StampKind::Modelled));
    frame::FrameRecord not_rendered = example_frame(0);
    not_rendered.should_render = false;
    join.on_frame(not_rendered);
    EXPECT_EQ(join.counts().frames, 2U);
    EXPECT_EQ(join.counts().not_announced, 2U);
    EXPECT_EQ(join.counts().joined(), 0U);
    EXPECT_EQ(run.told.frames.size(), 3U);
}

TEST(RuntimeMetricsJoin, TakesOfSeveralProgramsTheOneThatBeganWhenThisDid) {
    ExampleRun run;
    for (const std::int64_t session : {7, 2, 9}) {
        run.made(4, session, session == 2 ? -10'000 : 3 * kMs);
    }
    run.taken(4, 6, 7);
    run.taken(4, 4, 2);
    run.taken(4, 5, 9);
    for (const std::uint64_t by : {4, 5, 6}) {
        run.presented(by, 0);
    }
    run.play(4, 5);
    EXPECT_EQ(run.told.frames[0].stamps.shown.ns, ExampleRun::display_ns(4));
}

TEST(RuntimeMetricsJoin, PassesEverythingOnInItsOrder) {
    ExampleRun run;
    RuntimeMetricsJoin& join = run.play(0, 1);
    join.on_hidden({});
    join.on_origin({});
    join.on_sample({}, 8);
    join.on_event({}, "odd", "");
    EXPECT_THAT(run.told.calls,
                ElementsAre("frame 0", "gpu 0", "hidden", "origin", "sample 8", "odd"));
}

TEST(RuntimeMetricsJoin, SaysWhenTheFileIsOfAnotherRun) {
    ExampleRun run;
    run.file.session_frame(
        {.session = 1, .frame = 1, .display_ns = 500'000'000'000, .gpu_done_ns = 499'990'000'000});
    run.file.used(1, 1, 1, 499'995'000'000);
    const RuntimeMetricsJoin& join = run.play(100, 110);
    EXPECT_EQ(join.counts().of(MonadoFate::Missing), 10U);
    EXPECT_THAT(join.text(), HasSubstr("0 of 10 rendered frames joined"));
    EXPECT_THAT(join.text(),
                HasSubstr("The file has 499.990 to 499.995 s, the session 1.000 to 1.090 s"));
    EXPECT_THAT(join.text(), HasSubstr("no other Monado writes metrics"));
}

TEST(RuntimeMetricsJoin, FindsItsFramesFarIntoALongFileWithAbsurdTimes) {
    ExampleRun run;
    constexpr std::uint64_t kFrames = 12'000;  // thrice what is kept
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        run.made(i);
        run.taken(i, i);
        run.presented(i, 0);
        if (i % 100 == 0) {  // years ahead, and before the beginning
            run.file.used(kSession, 1, 1, 4'000'000'000'000'000'000);
            run.file.used(kSession, 1, 1, -5);
        }
    }
    const RuntimeMetricsJoin& join = run.play(100, kFrames);
    EXPECT_EQ(join.counts().of(MonadoFate::Presented), kFrames - 100);
}

TEST(RuntimeMetricsJoin, SaysWhatTheFileLacks) {
    ExampleRun run;
    run.made(0);
    run.taken(0, 0);
    run.presented(0, 0);
    run.file.raw("\x1a\x7f");
    run.file.raw("");
    const std::size_t cut = run.file.bytes().size();
    run.file.tail("\x20\x01");
    const RuntimeMetricsJoin& join = run.play(0, 1);
    EXPECT_EQ(join.counts().joined(), 1U);
    EXPECT_THAT(join.text(), HasSubstr("1 damaged records left out, the first at byte"));
    EXPECT_THAT(join.text(), HasSubstr("1 records of a kind that is not known here"));
    EXPECT_THAT(join.text(),
                HasSubstr("its last record, at byte " + std::to_string(cut) + ", was cut short"));
}

}  // namespace
}  // namespace gazeloop::report
