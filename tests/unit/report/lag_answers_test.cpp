// The four answers, and how paragraph and answers are written down.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/report/made_lag.h"

namespace gazeloop::report {
namespace {

using ::testing::HasSubstr;

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
