#include "runtime/report/lag_reasons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace gazeloop::report {
namespace {

using latency::DurationRow;
using latency::Stage;
using latency::SummaryReport;
using latency::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint64_t kFrames = 200;

DurationRow row(double mean_ms, std::uint64_t frames = kFrames) {
    DurationRow made;
    made.count = frames;
    made.frames_by_kind[static_cast<std::size_t>(time::StampKind::Measured)] = frames;
    if (frames > 0) {
        made.min_ms = 0.5 * mean_ms;
        made.mean_ms = made.p50_ms = mean_ms;
        made.p95_ms = 1.2 * mean_ms;
        made.p99_ms = 1.3 * mean_ms;
        made.max_ms = 1.5 * mean_ms;
    }
    return made;
}

const std::vector<NamedValue> kSoftware{{"vulkan device", "llvmpipe"}, {"processor", "some CPU"}};

/// A run that keeps up, with everything known and 36 ms in 8 stages; the tracker costs most.
struct Made {
    SummaryReport report;
    std::vector<NamedValue> settings{{"render.scale", "0.5"},
                                     {"render.method", "kfr"},
                                     {"kfr.sigma", "1.8"},
                                     {"acuity.mar", "0.022"},
                                     {"sim.delay_ms", "15"},
                                     {"profile.tracker", "generic"},
                                     {"gaze.stale_ms", "100"},
                                     {"gaze.minimum_confidence", "0.6"},
                                     {"render.frames_in_flight", "2"},
                                     {"render.wait_before_latch", "false"}};
    latency::LatencyBudget budget{
        .name = "albert2017", .description = "", .source = "", .total_ns = 70'000'000};
    LagFacts facts;

    Made() {
        report.config.period_ns = 10'000'000;
        report.config.switching_ns = 1'000'000;
        report.config.rolling_ns = 0;
        report.verdict = Verdict::RealTime;
        report.frames.total = report.frames.rendered = kFrames;
        report.frames.by_state[static_cast<std::size_t>(gaze::FoveaState::Tracking)] = kFrames;
        report.gaze.received = 2 * kFrames;
        report.gaze_age_at_latch = row(14.0);
        for (DurationRow& stage : report.stages) {
            stage = row(1.0);
        }
        report.stages[static_cast<std::size_t>(Stage::Present)] = {};
        report.unaccounted = row(1.0);
        report.frame_interval = row(10.0);
        set(Stage::Tracker, 12.0);
        facts.report = &report;
        facts.settings = settings;
        facts.origin = GazeOrigin::Tracker;
        facts.smoothing.rate_hz = 120.0;
        facts.use.rendered = facts.use.with_gaze = kFrames;
        facts.use.comparable = kFrames - 1;
    }
    Made(const Made&) = delete;
    Made& operator=(const Made&) = delete;
    ~Made() = default;

    void set(Stage stage, double mean_ms) {
        report.stages[static_cast<std::size_t>(stage)] = row(mean_ms);
        sum_up();
    }
    void sum_up() {
        double sum_ms = report.unaccounted.mean_ms.value_or(0.0);
        for (const DurationRow& stage : report.stages) {
            sum_ms += stage.mean_ms.value_or(0.0);
        }
        report.gaze_age_at_display = row(sum_ms);
    }
    void forget_gaze(std::uint64_t received) {
        report.frames.by_state = {};
        report.frames.by_state[static_cast<std::size_t>(gaze::FoveaState::Ahead)] = kFrames;
        report.gaze = {.received = received, .invalid = received};
        for (DurationRow& stage : report.stages) {
            stage = {};
        }
        report.unaccounted = report.gaze_age_at_display = report.gaze_age_at_latch = {};
        facts.use = {.rendered = kFrames, .lost = kFrames, .before_first = kFrames};
    }
    /// So many of the frames, for a cause that is known, or for None.
    void lose(std::uint64_t frames, gaze::LossCause cause) {
        facts.use.lost = frames;
        facts.use.with_gaze -= frames;
        facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Invalid)] = frames;
        facts.use.lost_by_cause[static_cast<std::size_t>(cause)] = frames;
    }
    void forget_frames(std::uint64_t total) {
        forget_gaze(0);
        report.frames = {};
        report.frames.total = total;
        facts.use = {};
    }
    [[nodiscard]] LagReasons reasons() const { return lag_reasons(facts); }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const LagSentence& sentence : reasons().paragraph) {
            text += sentence.text + "\n";
        }
        return text;
    }
    [[nodiscard]] std::vector<std::string_view> rules() const {
        std::vector<std::string_view> names;
        for (const LagSentence& sentence : reasons().paragraph) {
            names.push_back(sentence.rule);
        }
        return names;
    }
};

struct RuleCase {
    std::string_view rule;
    std::function<void(Made&)> make;
    std::string says;  ///< in the rule's sentence
};

const std::vector<RuleCase>& cases() {
    static const std::vector<RuleCase> all{
        {"no-frames", [](Made& m) { m.forget_frames(0); }, "There is no frame"},
        {"no-frames", [](Made& m) { m.forget_frames(9); }, "None of the 9 frames was rendered"},
        {"no-gaze", [](Made& m) { m.forget_gaze(0); }, "no fresh gaze to follow in any of the 200"},
        {"age-unknown", [](Made& m) { m.report.gaze_age_at_display = {}; },
         "unknown in all of the 200 frames with gaze"},
        {"age-not-positive", [](Made& m) { m.report.gaze_age_at_display = row(-3.0); },
         "-3.0 ms old when its picture is seen, which cannot be"},
        {"virtual-time", [](Made& m) { m.report.verdict = Verdict::VirtualTime; },
         "Nothing was timed"},
        {"not-real-time",
         [](Made& m) {
             m.report.verdict = Verdict::NotRealTime;
             m.report.frame_interval = row(50.0);
         },
         "a frame comes every 50.0 ms, the display shows one every 10.0 ms"},
        {"timed", [](Made&) {},
         "On average the gaze is 21.0 ms old when its picture is seen (25.2 ms or less in 95 %"},
        {"timed", [](Made& m) { m.report.gaze_age_at_display.p95_ms.reset(); }, "at most 31.5 ms"},
        {"not-in-time",
         [](Made& m) {
             m.report.verdict = Verdict::NotRealTime;
             m.report.frames.missed = 50;
         },
         "25.0 % of the frames miss their display time"},
        {"cost-tracker", [](Made&) {}, "Most of it, 12.0 ms (57 %), passes in the tracker."},
        {"cost-tracker",
         [](Made& m) {
             auto& kinds = m.report.stages[0].frames_by_kind;
             kinds = {};
             kinds[static_cast<std::size_t>(time::StampKind::Profile)] = kFrames;
         },
         "a constant of its profile, not measured"},
        {"cost-delivery", [](Made& m) { m.set(Stage::Delivery, 14.0); },
         "The largest part of it, 14.0 ms (41 %), passes on the way"},
        {"cost-queue", [](Made& m) { m.set(Stage::Queue, 14.0); }, "waits for the loop to read"},
        {"cost-filter", [](Made& m) { m.set(Stage::Filter, 14.0); }, "foveae are computed"},
        {"cost-submit", [](Made& m) { m.set(Stage::Submit, 14.0); }, "on the CPU"},
        {"cost-gpu", [](Made& m) { m.set(Stage::Gpu, 14.0); }, "passes on the GPU."},
        {"cost-gpu",
         [](Made& m) {
             m.set(Stage::Gpu, 14.0);
             m.report.config.passes = {"pass_i", "resolve"};
             m.report.passes[0] = row(3.0);
             m.report.passes[1] = row(9.0);
         },
         "on the GPU; its dearest pass is resolve with 9.0 ms"},
        {"cost-wait", [](Made& m) { m.set(Stage::Wait, 14.0); }, "waits for the display"},
        {"cost-row", [](Made& m) { m.set(Stage::Row, 14.0); }, "lights the row"},
        {"cost-switching", [](Made& m) { m.set(Stage::Switching, 14.0); }, "pixels have switched"},
        {"cost-unaccounted",
         [](Made& m) {
             m.report.unaccounted = row(14.0);
             m.sum_up();
         },
         "where nobody stamps anything"},
        {"budget-not-judged",
         [](Made& m) {
             m.facts.budget = &m.budget;
             m.report.verdict = Verdict::NotRealTime;
         },
         "albert2017 (70.0 ms) it is not judged"},
        {"budget-broken",
         [](Made& m) {
             m.facts.budget = &m.budget;
             m.budget.total_ns = 20'000'000;
             m.budget.stages_ns[0] = 10'000'000;
         },
         "allows 20.0 ms, which 5 % of the frames exceed by 5.2 ms or more. It allows that stage "
         "10.0 ms, which takes 14.4 ms."},
        {"budget-broken",
         [](Made& m) {
             m.facts.budget = &m.budget;
             m.budget.total_ns = 20'000'000;
             m.report.gaze_age_at_display.p95_ms.reset();
         },
         "which the latest frame exceeds by 11.5 ms."},
        {"budget-kept", [](Made& m) { m.facts.budget = &m.budget; },
         "allows 70.0 ms, which 95 % of the frames keep with 44.8 ms to spare."},
        {"try-being-worn", [](Made& m) { m.forget_frames(9); }, "put the headset on"},
        {"try-more-frames", [](Made& m) { m.forget_frames(0); }, "Run longer"},
        {"try-devices", [](Made& m) { m.forget_gaze(0); }, "gazeloop devices"},
        {"try-younger-samples",
         [](Made& m) {
             m.forget_gaze(400);
             m.facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Stale)] = 200;
         },
         "gaze.stale_ms (now 100)"},
        {"try-calibrating", [](Made& m) { m.forget_gaze(400); },
         "neither eye in 400 of its 400 samples"},
        {"try-nothing", [](Made& m) { m.report.gaze_age_at_display = {}; }, "once that is mended"},
        {"often-lost", [](Made& m) { m.lose(60, gaze::LossCause::NotSeen); },
         "In 30.0 % of the frames the fovea has no fresh gaze at all, most often because the "
         "tracker vouched for neither eye."},
        {"often-lost", [](Made& m) { m.lose(60, gaze::LossCause::None); },
         "most often because neither eye was valid."},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::NotSeen); },
         "seat the headset"},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::Blink); },
         "a lower gaze.closed_below"},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::LowConfidence); },
         "gaze.minimum_confidence (now 0.6)"},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::OutsideField); },
         "a wider gaze.field_deg"},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::Unplugged); },
         "cable and port"},
        {"try-finding-the-eye", [](Made& m) { m.lose(60, gaze::LossCause::Stopped); },
         "gazeloop devices --watch"},
        {"try-finding-the-eye",
         [](Made& m) {
             m.lose(60, gaze::LossCause::NotSeen);
             m.facts.origin = GazeOrigin::Simulated;
         },
         "simulated: sim.dropout_percent"},
        {"try-finding-the-eye",
         [](Made& m) {
             m.lose(60, gaze::LossCause::NotSeen);
             m.facts.origin = GazeOrigin::Trace;
         },
         "The trace lacks the gaze there"},
        {"try-a-gpu",
         [](Made& m) {
             m.report.verdict = Verdict::NotRealTime;
             m.facts.device = kSoftware;
         },
         "the processor (llvmpipe): use a machine with a GPU"},
        {"try-keeping-up", [](Made& m) { m.report.verdict = Verdict::NotRealTime; },
         "a higher kfr.sigma (now 1.8), or a lower render.scale (now 0.5)"},
        {"try-wall-clock", [](Made& m) { m.report.verdict = Verdict::VirtualTime; },
         "--clock wall"},
        {"try-sim-delay", [](Made& m) { m.facts.origin = GazeOrigin::Simulated; },
         "sim.delay_ms (now 15)"},
        {"try-tracker-profile", [](Made& m) { m.facts.origin = GazeOrigin::Trace; },
         "tracker profile (now generic)"},
        {"try-another-tracker", [](Made&) {}, "Nothing in software helps"},
        {"try-usb-port", [](Made& m) { m.set(Stage::Delivery, 14.0); }, "USB port"},
        {"try-steady-samples", [](Made& m) { m.set(Stage::Queue, 14.0); },
         "A newer sample should come every 8.3 ms"},
        {"try-higher-rate",
         [](Made& m) {
             m.set(Stage::Queue, 14.0);
             m.facts.smoothing.rate_hz = 50.0;
         },
         "a higher rate of the tracker (now 50 Hz), or render.wait_before_latch=true"},
        {"try-higher-rate",
         [](Made& m) {
             m.set(Stage::Queue, 14.0);
             m.facts.smoothing.rate_hz = 50.0;
             m.settings.back().value = "true";
         },
         "a higher rate of the tracker (now 50 Hz)."},
        {"try-more-cpu", [](Made& m) { m.set(Stage::Submit, 14.0); }, "more of the CPU"},
        {"try-more-cpu", [](Made& m) { m.set(Stage::Filter, 14.0); }, "more of the CPU"},
        {"try-no-filter",
         [](Made& m) {
             m.set(Stage::Filter, 14.0);
             m.settings.push_back({"gaze.filter", "one-euro"});
         },
         "gaze.filter=none (now one-euro)"},
        {"try-less-gpu-work", [](Made& m) { m.set(Stage::Gpu, 14.0); }, "a higher kfr.sigma"},
        {"try-less-gpu-work",
         [](Made& m) {
             m.set(Stage::Gpu, 14.0);
             m.settings[1].value = "full";
         },
         "--method kfr"},
        {"try-less-gpu-work",
         [](Made& m) {
             m.set(Stage::Gpu, 14.0);
             m.settings[1].value = "acuity";
         },
         "a higher acuity.mar (now 0.022)"},
        {"try-less-gpu-work",
         [](Made& m) {
             m.set(Stage::Gpu, 14.0);
             m.facts.settings = {};
         },
         "Try a lower render.scale."},
        {"try-missing-less",
         [](Made& m) {
             m.set(Stage::Wait, 14.0);
             m.report.frames.missed = 8;
         },
         "4.0 % of the frames miss their time and wait for the next period of 10.0 ms"},
        {"try-shorter-period", [](Made& m) { m.set(Stage::Wait, 14.0); }, "(now 10.0 ms)"},
        {"try-another-display", [](Made& m) { m.set(Stage::Row, 14.0); }, "mode of the display"},
        {"try-another-display", [](Made& m) { m.set(Stage::Switching, 14.0); }, "display"},
        {"try-timing-the-gpu",
         [](Made& m) {
             m.report.stages[static_cast<std::size_t>(Stage::Gpu)] = {};
             m.report.unaccounted = row(14.0);
             m.sum_up();
         },
         "GPU's times are unknown"},
        {"try-a-free-gpu",
         [](Made& m) {
             m.report.unaccounted = row(14.0);
             m.sum_up();
         },
         "render.frames_in_flight=1 (now 2)"},
        {"unknown-sample-time",
         [](Made& m) { m.report.gaze_age_at_latch = row(14.0, kFrames - 3); },
         "When the eye was seen is unknown in 3 of 200 frames"},
        {"unknown-sample-time",
         [](Made& m) {
             m.report.gaze_age_at_latch = {};
             m.facts.origin = GazeOrigin::Runtime;
         },
         "unknown in all 200 frames, because the source gives no time with those samples that "
         "means anything: a runtime that fills in XrEyeGazeSampleTimeEXT tells it."},
        {"unknown-display-time", [](Made& m) { m.report.frames.display_unknown = 4; },
         "When the picture was shown is unknown in 4 of 200 frames"},
        {"unknown-gpu-time",
         [](Made& m) { m.report.stages[static_cast<std::size_t>(Stage::Gpu)] = {}; },
         "VK_EXT_calibrated_timestamps"},
        {"unknown-display", [](Made& m) { m.report.config.switching_ns.reset(); },
         "a display profile that states it"}};
    return all;
}

TEST(LagRules, SpeakWhereTheyHold) {
    for (const RuleCase& one : cases()) {
        Made made;
        one.make(made);
        made.facts.settings = made.facts.settings.empty()
                                  ? made.facts.settings
                                  : std::span<const NamedValue>(made.settings);
        const LagReasons reasons = made.reasons();
        const auto said = std::ranges::find(reasons.paragraph, one.rule, &LagSentence::rule);
        ASSERT_NE(said, reasons.paragraph.end()) << one.rule << ": " << made.text();
        EXPECT_THAT(said->text, HasSubstr(one.says));
    }
}

TEST(LagRules, EachHasACase) {
    std::set<std::string_view> covered;
    for (const RuleCase& one : cases()) {
        covered.insert(one.rule);
    }
    for (std::uint8_t subject = 0; subject < kLagSubjectCount; ++subject) {
        for (const LagRule& rule : lag_rules(LagSubject{subject})) {
            EXPECT_TRUE(covered.contains(rule.name)) << rule.name;
        }
    }
}

TEST(LagRules, WriteWholeShortSentences) {
    for (const RuleCase& one : cases()) {
        Made made;
        one.make(made);
        for (const LagSentence& sentence : made.reasons().paragraph) {
            EXPECT_TRUE(sentence.text.ends_with('.')) << sentence.text;
            EXPECT_THAT(sentence.text, Not(HasSubstr("nan"))) << sentence.text;
            EXPECT_THAT(sentence.text, Not(HasSubstr("inf"))) << sentence.text;
        }
    }
}

TEST(LagReasons, SpeakOncePerSubjectInOrder) {
    Made made;
    made.facts.budget = &made.budget;
    EXPECT_THAT(made.rules(),
                ElementsAre("timed", "cost-tracker", "budget-kept", "try-another-tracker"));
    Made virtual_time;
    virtual_time.report.verdict = Verdict::VirtualTime;
    EXPECT_THAT(virtual_time.rules(),
                ElementsAre("virtual-time", "cost-tracker", "try-wall-clock"));
    Made nothing;
    nothing.forget_frames(0);
    EXPECT_THAT(nothing.rules(), ElementsAre("no-frames", "try-more-frames"));
}

TEST(LagReasons, SpeakOfLossFirstWhereItIsNoBlinks) {
    Made blinks;
    blinks.lose(20, gaze::LossCause::Blink);  // 10 %
    EXPECT_THAT(blinks.rules(), ElementsAre("timed", "cost-tracker", "try-another-tracker"));
    Made lost;
    lost.lose(21, gaze::LossCause::NotSeen);
    lost.report.verdict = Verdict::NotRealTime;
    lost.facts.device = kSoftware;
    EXPECT_THAT(lost.rules(),
                ElementsAre("not-in-time", "cost-tracker", "often-lost", "try-finding-the-eye"));
}

TEST(LagReasons, AreSilentOnABudgetWithoutATotal) {
    Made made;
    made.budget.total_ns.reset();
    made.facts.budget = &made.budget;
    EXPECT_THAT(made.text(), Not(HasSubstr("budget")));
}

TEST(LagReasons, SayNothingFalseOfAnEmptyReport) {
    const SummaryReport empty;
    const LagReasons reasons = lag_reasons({.report = &empty});
    EXPECT_EQ(reasons.paragraph.front().rule, "no-frames");
    for (const LagAnswer& answer : reasons.answers) {
        EXPECT_EQ(answer.kind, LagAnswerKind::CannotBeKnown) << answer.why;
        EXPECT_FALSE(answer.why.empty());
    }
}

const LagAnswer& answer_of(const LagReasons& reasons, std::string_view key) {
    return *std::ranges::find(reasons.answers, key, &LagAnswer::key);
}

void expect_answer(const Made& made, std::string_view key, LagAnswerKind kind,
                   const std::string& why) {
    const LagReasons reasons = made.reasons();
    const LagAnswer& answer = answer_of(reasons, key);
    EXPECT_EQ(answer.kind, kind) << answer.why;
    EXPECT_THAT(answer.why, HasSubstr(why));
}

TEST(LagAnswers, SayWhetherTheGazeIsSmoothed) {
    using gaze::SmoothingVerdict;
    Made made;
    made.facts.smoothing = {.verdict = SmoothingVerdict::Smoothed,
                            .saccades = 150,
                            .rate_hz = 120.0,
                            .speed = 0.61,
                            .speed_low = 0.58,
                            .speed_high = 0.64,
                            .time_constant_ms = 21.0,
                            .in_world = true};
    expect_answer(made, "smoothed", LagAnswerKind::Yes,
                  "150 saccades peak at 0.61 times the main sequence (median; 95 % confidence 0.58 "
                  "to 0.64)");
    expect_answer(made, "smoothed", LagAnswerKind::Yes, "a time constant of about 21 ms, a lag");
    made.facts.smoothing.time_constant_ms = 40.0;
    expect_answer(made, "smoothed", LagAnswerKind::Yes, "about 40 ms or more");
    made.facts.smoothing.time_constant_ms.reset();
    made.facts.smoothing.in_world = false;
    made.facts.smoothing.stopped = true;
    made.facts.smoothing.looked_at_s = 612.0;
    made.facts.smoothing.verdict = SmoothingVerdict::NotSmoothed;
    expect_answer(made, "smoothed", LagAnswerKind::No, "only the first 612 s were looked at");
    expect_answer(made, "smoothed", LagAnswerKind::No, "no head poses are known");
    made.facts.smoothing.verdict = SmoothingVerdict::Unclear;
    expect_answer(made, "smoothed", LagAnswerKind::CannotBeKnown, "more saccades");
    made.facts.smoothing.saccades = 7;
    for (const auto& [verdict, why] :
         {std::pair<SmoothingVerdict, std::string>{SmoothingVerdict::TooFewSaccades,
                                                   "too few saccades: 7 of"},
          {SmoothingVerdict::TooSlow, "samples come at 120 Hz"},
          {SmoothingVerdict::Repeated, "repeat the one before"},
          {SmoothingVerdict::NoTimes, "no sample says when"},
          {SmoothingVerdict::NoSamples, "no sample came"}}) {
        made.facts.smoothing.verdict = verdict;
        expect_answer(made, "smoothed", LagAnswerKind::CannotBeKnown, why);
    }
}

TEST(LagAnswers, SayWhetherItIsLate) {
    Made made;
    expect_answer(made, "late", LagAnswerKind::CannotBeKnown, "no budget was named");
    made.facts.budget = &made.budget;
    expect_answer(made, "late", LagAnswerKind::No,
                  "the p95 of its age is 25.2 ms, the budget albert2017 allows 70.0 ms");
    made.budget.total_ns = 25'000'000;
    expect_answer(made, "late", LagAnswerKind::Yes, "allows 25.0 ms");
    made.report.verdict = Verdict::NotRealTime;
    expect_answer(made, "late", LagAnswerKind::CannotBeKnown, "does not keep up");
    made.report.verdict = Verdict::VirtualTime;
    expect_answer(made, "late", LagAnswerKind::CannotBeKnown, "nothing was timed");
    made.report.gaze_age_at_display = {};
    expect_answer(made, "late", LagAnswerKind::CannotBeKnown, "unknown in all frames");
}

TEST(LagAnswers, HoldTheAgeAgainstThePrediction) {
    Made made;
    made.facts.budget = &made.budget;
    made.facts.prediction = latency::check_prediction(
        {.delay_ns = 12'000'000, .uncertainty_ns = 0, .jitter_ns = 0, .rate_hz = 120.0},
        made.report);
    expect_answer(made, "late", LagAnswerKind::No, "; its parts allow");
    made.facts.prediction.outside = {{.what = "min"},
                                     {.what = "p99",
                                      .measured_ms = 44.0,
                                      .limit_ms = 40.0,
                                      .part = latency::Part::Display,
                                      .part_measured_ms = 18.0,
                                      .part_limit_ms = 10.0}};
    expect_answer(made, "late", LagAnswerKind::No,
                  "its p99 (44.0 ms) lies above that, mostly by wait for display (18.0 ms, "
                  "predicted at most 10.0)");
}

TEST(LagAnswers, SayWhetherSamplesAreReused) {
    Made made;
    expect_answer(made, "reused", LagAnswerKind::No, "another sample");
    made.facts.use.reused = 50;
    made.facts.use.longest_reuse = {.frames = 3, .first = 17, .lasted = {}};
    expect_answer(made, "reused", LagAnswerKind::Yes,
                  "25.1 % of the frames (50) have the sample of the frame before, up to 3 in a row "
                  "from frame 17 on; with 120 samples and 100 frames a second none would have to");
    made.facts.smoothing.rate_hz = 75.0;
    expect_answer(made, "reused", LagAnswerKind::Yes, "25 % must, which is normal");
    made.facts.smoothing.rate_hz = 90.0;
    expect_answer(made, "reused", LagAnswerKind::Yes, "10 % must, the rest is of samples");
    made.facts.smoothing.rate_hz = 0.0;
    expect_answer(made, "reused", LagAnswerKind::Yes, "because a rate is unknown");
    made.facts.use.comparable = 0;
    expect_answer(made, "reused", LagAnswerKind::CannotBeKnown, "no two frames");
}

TEST(LagAnswers, SayWhetherGazeIsLost) {
    Made made;
    expect_answer(made, "lost", LagAnswerKind::No, "all 200 frames rest on a fresh sample");
    made.report.gaze.invalid = 3;
    expect_answer(made, "lost", LagAnswerKind::No, "of 400 samples 3 had no valid eye");
    made.facts.use.lost = 30;
    made.facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Invalid)] = 20;
    made.facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Stale)] = 10;
    made.facts.use.longest_loss = {
        .frames = 12, .first = 40, .lasted = {133'000'000, time::StampKind::Measured}};
    expect_answer(made, "lost", LagAnswerKind::Yes,
                  "15.0 % of the frames (30) have no fresh gaze: 20 because neither eye was valid, "
                  "10 because the newest sample was too old; the longest loss takes 12 frames from "
                  "frame 40 on (133 ms, no longer than a blink)");
    made.facts.use.lost_by_cause[static_cast<std::size_t>(gaze::LossCause::Blink)] = 20;
    made.facts.use.lost_by_cause[static_cast<std::size_t>(gaze::LossCause::Stopped)] = 10;
    expect_answer(made, "lost", LagAnswerKind::Yes,
                  "20 because the lids were closed, 10 because samples stopped coming; the");
    made.facts.use.longest_loss.lasted.ns = 500'000'000;
    expect_answer(made, "lost", LagAnswerKind::Yes, "(500 ms, longer than a blink)");
}

TEST(LagText, IsAtMostAHundredColumnsWide) {
    for (const RuleCase& one : cases()) {
        Made made;
        one.make(made);
        std::istringstream lines(lag_text(made.reasons()));
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100U) << line;
        }
    }
}

TEST(LagText, HasTheParagraphThenTheAnswers) {
    Made made;
    const std::string paragraph = lag_paragraph(made.reasons());
    const std::string text = lag_text(made.reasons());
    EXPECT_TRUE(paragraph.starts_with("why does the fovea lag?\n  On average")) << paragraph;
    EXPECT_TRUE(text.starts_with(paragraph));
    EXPECT_THAT(text, HasSubstr("\n  - Is it reused? no: each frame"));
    EXPECT_TRUE(text.ends_with(".\n"));
}

TEST(LagJson, HasWhatTheTextHas) {
    Made made;
    const nlohmann::ordered_json json = lag_json(made.reasons());
    EXPECT_THAT(json["paragraph"].get<std::string>(), HasSubstr("Most of it, 12.0 ms"));
    EXPECT_EQ(json["rules"][0], "timed");
    EXPECT_EQ(json["answers"]["reused"]["answer"], "no");
    EXPECT_EQ(json["answers"]["late"]["answer"], "cannot be known");
    EXPECT_EQ(json["answers"]["lost"]["question"], "Is it lost?");
}

TEST(GazeOrigin, IsReadFromWhatASourceSaysOfItself) {
    EXPECT_EQ(origin_of("simulated tracker (120 Hz, delay 15 ms)"), GazeOrigin::Simulated);
    EXPECT_EQ(origin_of("trace a.csv (HTC)"), GazeOrigin::Trace);
    EXPECT_EQ(origin_of("fixed gaze (azimuth 0 deg)"), GazeOrigin::Fixed);
    EXPECT_EQ(origin_of("OpenXR eye gaze of X"), GazeOrigin::Runtime);
    EXPECT_EQ(origin_of("HID eye tracker (usage page 0x12)"), GazeOrigin::Tracker);
    EXPECT_EQ(origin_of("PlayStation VR2 over USB"), GazeOrigin::Tracker);
    EXPECT_EQ(origin_of("Steam Frame through its eye service's file"), GazeOrigin::Tracker);
    EXPECT_EQ(origin_of("simulated tracker, of who looks at the points, calibrated"),
              GazeOrigin::Simulated);
    EXPECT_EQ(origin_of("session a.gaze (3 samples)"), GazeOrigin::Unknown);
    EXPECT_EQ(origin_of(""), GazeOrigin::Unknown);
}

}  // namespace
}  // namespace gazeloop::report
