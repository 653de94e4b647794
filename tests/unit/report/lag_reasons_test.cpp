// The paragraph: what costs most, against the budget, and what to try.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/report/made_lag.h"

namespace gazeloop::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

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
        {"try-its-log",
         [](Made& m) {
             m.forget_frames(0);
             m.facts.log_missing = true;
         },
         "The recording's log (-wal) is not beside it"},
        {"try-more-frames", [](Made& m) { m.forget_frames(0); }, "Run longer"},
        {"try-devices", [](Made& m) { m.forget_gaze(0); }, "gazeloop devices"},
        {"try-younger-samples",
         [](Made& m) {
             m.forget_gaze(400);
             m.facts.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Stale)] = 200;
         },
         "gaze.stale_ms (now 100)"},
        {"try-placing-gaze",
         [](Made& m) {
             m.forget_gaze(400);
             m.facts.unplaced = "a direction needs the viewing distance";
         },
         "Set what it does not state: a direction needs the viewing distance."},
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

/// What the layer recorded was drawn by a program that has none of our settings but those of gaze.
TEST(LagRules, AdviseTheUserOfAnotherProgramNothingOfOurs) {
    const std::vector<NamedValue> device{
        {"application", "a game"}, {"vulkan device", "llvmpipe"}, {"processor", "some CPU"}};
    for (const RuleCase& one : cases()) {
        Made made;
        one.make(made);
        if (made.report.verdict == Verdict::VirtualTime) {
            continue;  // which the layer does not have
        }
        made.facts.device = device;
        for (const LagSentence& sentence : made.reasons().paragraph) {
            for (const char* const ours : {"render.", "kfr.", "acuity.", "--method", "--display",
                                           "--axes", "--tracker", "gazeloop doctor", "the loop"}) {
                EXPECT_THAT(sentence.text, Not(HasSubstr(ours))) << sentence.rule;
            }
        }
    }
    Made late;
    late.facts.device = device;
    late.set(Stage::Gpu, 14.0);
    EXPECT_THAT(late.text(), HasSubstr("Try a lower resolution or quality in a game"));
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

}  // namespace
}  // namespace gazeloop::report
