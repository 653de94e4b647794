#include "runtime/report/prediction_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::kMs;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr latency::TrackerFigures kTracker{
    .delay_ns = 3 * kMs, .uncertainty_ns = 0, .jitter_ns = 0, .rate_hz = 1000.0 / 3.0};

latency::SummaryReport example_report(std::uint64_t frames, std::int64_t display_later_ms = 0) {
    latency::LatencySummary summary(
        {.period_ns = latency::kExamplePeriodNs, .switching_ns = 2 * kMs, .rolling_ns = 0});
    for (std::uint64_t index = 0; index < frames; ++index) {
        frame::FrameRecord frame = latency::example_frame(index);
        frame.stamps.display.ns += display_later_ms * kMs;
        summary.add(frame);
        summary.add(latency::example_gpu(index));
    }
    return summary.report();
}

TEST(PredictionText, PutsTheMeasuredBesideThePredicted) {
    const latency::SummaryReport report = example_report(200);
    const std::string text = prediction_text(check_prediction(kTracker, report), report);
    EXPECT_THAT(text, HasSubstr("gaze age at display            9.00      22.0"));
    EXPECT_THAT(text, HasSubstr("\n  wait for display             0.00      10.00     6.00"));
    EXPECT_THAT(text, HasSubstr("\neye waits for a frame          0.00      10.0"));
    EXPECT_THAT(text, Not(HasSubstr("Outside")));
    EXPECT_THAT(text, Not(HasSubstr("Unknown")));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 100U) << line;
    }
}

TEST(PredictionText, NamesWhatLiesOutsideAndWhatIsUnknown) {
    const latency::SummaryReport late = example_report(200, 20);
    EXPECT_THAT(prediction_text(check_prediction(kTracker, late), late),
                HasSubstr("Outside: p50 (38.0 ms) lies above that, mostly by wait for display "
                          "(26.0 ms, predicted at most\n10.0)."));
    const latency::SummaryReport report = example_report(200);
    EXPECT_THAT(prediction_text(check_prediction({}, report), report),
                HasSubstr("Unknown, so that the worst case is at least that: tracker, delivery, "
                          "sample waits."));
}

TEST(PredictionSentence, SpeaksOfTheMiddleFirst) {
    EXPECT_EQ(prediction_sentence(check_prediction(kTracker, example_report(200))),
              "; its parts allow 9.0 to 22.0 ms, which it keeps");
    EXPECT_THAT(prediction_sentence(check_prediction(kTracker, example_report(200, 20))),
                HasSubstr("and its p50 (38.0 ms) lies above that"));
    EXPECT_THAT(prediction_sentence(check_prediction({}, example_report(200))),
                HasSubstr("of which is unknown: tracker, delivery"));
}

TEST(PredictionJson, HasNullForTheUnknown) {
    const nlohmann::ordered_json json =
        prediction_json(check_prediction({}, example_report(200, 20)));
    EXPECT_TRUE(json["parts"]["tracker"]["least_ms"].is_null());
    EXPECT_EQ(json["parts"]["switching"]["greatest_ms"], 2.0);
    EXPECT_EQ(json["gaze_age_at_display"]["worst_is_at_least"], true);
    EXPECT_EQ(json["comparable"], false);
    EXPECT_EQ(json["unknown_parts"][0], "tracker");
    const nlohmann::ordered_json outside =
        prediction_json(check_prediction(kTracker, example_report(200, 20)));
    EXPECT_EQ(outside["outside"][0]["figure"], "min");
    EXPECT_EQ(outside["outside"][0]["part"], "display");
}

}  // namespace
}  // namespace gazeloop::report
