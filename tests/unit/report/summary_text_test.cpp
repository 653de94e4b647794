#include "runtime/report/summary_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/report/summary_json.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kExamplePeriodNs;
using latency::kMs;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

latency::SummaryReport example_report(std::uint64_t frames, const latency::SummaryConfig& config) {
    latency::LatencySummary summary(config);
    for (std::uint64_t index = 0; index < frames; ++index) {
        summary.add(example_frame(index));
        summary.add(example_gpu(index));
    }
    return summary.report();
}

latency::SummaryReport example_report(std::uint64_t frames) {
    return example_report(frames, {.period_ns = kExamplePeriodNs,
                                   .switching_ns = 2 * kMs,
                                   .passes = latency::kExamplePasses,
                                   .grids = latency::kExampleGrids});
}

std::vector<std::string> lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> result;
    for (std::string line; std::getline(stream, line);) {
        result.push_back(line);
    }
    return result;
}

std::string line_with(const std::string& text, const std::string& begin) {
    for (const std::string& line : lines(text)) {
        if (line.starts_with(begin)) {
            return line;
        }
    }
    return {};
}

TEST(SummaryText, BeginsWithHowEyeToPhotonWasObtained) {
    const std::string text = summary_text(example_report(200));
    EXPECT_EQ(lines(text)[0],
              "eye-to-photon: 38.9 % measured, 27.8 % profile, 0.0 % modelled, 33.3 % predicted, "
              "0.0 % unknown");
    EXPECT_EQ(lines(text)[1],
              "real time: median interval 10.00 ms, display period 10.00 ms, missed 0.0 %");
}

// A share of what is known says nothing of the rest.
TEST(SummaryText, SaysOfHowManyFramesTheAgeIsKnown) {
    latency::LatencySummary summary({.period_ns = 10 * kMs, .switching_ns = 2 * kMs});
    for (std::uint64_t index = 0; index < 40; ++index) {
        frame::FrameRecord frame = example_frame(index);
        if (index % 4 != 0) {
            for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
                eye.sampled = {};
                eye.ready = {};
            }
        }
        summary.add(frame);
    }
    const latency::SummaryReport report = summary.report();
    EXPECT_THAT(lines(summary_text(report))[0],
                ::testing::EndsWith("in the 10 of 40 frames with gaze whose age is known"));
    EXPECT_EQ(summary_json(report)["eye_to_photon_frames"]["known"], 10);
    EXPECT_EQ(summary_json(report)["eye_to_photon_frames"]["of"], 40);
}

TEST(SummaryText, ShowsEveryRow) {
    const std::string text = summary_text(example_report(200));
    EXPECT_EQ(line_with(text, "gaze age at display"),
              "gaze age at display     predicted        200    18.00    18.00    18.00    18.00"
              "    18.00    18.00");
    EXPECT_EQ(line_with(text, "  wait for display"),
              "  wait for display      predicted        200     6.00     6.00     6.00     6.00"
              "     6.00     6.00");
    for (const char* begin :
         {"gaze age at latch ", "  tracker ", "  queue ", "  submit ", "  gpu ", "  switching ",
          "  unaccounted ", "frame interval ", "loop (cpu) ", "pass pass_i ", "pass resolve "}) {
        EXPECT_NE(line_with(text, begin), "") << begin;
    }
    EXPECT_EQ(line_with(text, "pass disc"), "");
    EXPECT_EQ(line_with(text, "lp "),
              "lp       shaded 160000 of 200000, off screen 30000, covered by another grid 10000");
    EXPECT_EQ(line_with(text, "picture "), "picture  shaded 40000 of 40000");
    EXPECT_EQ(line_with(text, "-:"), "");
    EXPECT_THAT(text, HasSubstr("3.4x fewer samples than full resolution"));
    EXPECT_THAT(text, HasSubstr("tracking 100.0 %, other-eye 0.0 %"));
}

TEST(SummaryText, SaysFirstThatARunWasNotRealTime) {
    const latency::SummaryReport report =
        example_report(200, {.period_ns = 5 * kMs, .switching_ns = 2 * kMs});
    EXPECT_EQ(lines(summary_text(report))[0],
              "NOT REAL TIME: median interval 10.00 ms, display period 5.00 ms, missed 0.0 %; no "
              "latency verdict");
    EXPECT_THAT(lines(summary_text(report))[1], StartsWith("eye-to-photon:"));
}

TEST(SummaryText, SaysThatVirtualTimeIsModelled) {
    const std::string text =
        summary_text(example_report(2, {.clock = latency::LoopClock::Virtual, .period_ns = 1}));
    EXPECT_EQ(lines(text)[1], "virtual time: durations of the loop are modelled");
}

TEST(SummaryText, WithheldFiguresAreDashesWithOneNote) {
    const std::string text = summary_text(example_report(30));
    EXPECT_THAT(line_with(text, "gaze age at latch"),
                ::testing::EndsWith("5.00        -     5.00"));
    EXPECT_THAT(line_with(text, "-:"), HasSubstr("withheld"));
}

TEST(SummaryText, UnknownIsNeverZero) {
    latency::LatencySummary summary({});
    frame::FrameRecord frame = example_frame(0);
    frame.stamps = {};
    frame.fovea = {};
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.state = gaze::FoveaState::Tracking;
    }
    summary.add(frame);
    const std::string text = summary_text(summary.report());
    EXPECT_EQ(lines(text)[0],
              "eye-to-photon: unknown (no frame has both a gaze sample and a display time)");
    EXPECT_EQ(
        lines(text)[1],
        "no latency verdict: median interval unknown, display period unknown, missed unknown");
    EXPECT_THAT(text, Not(HasSubstr("0.00")));
    EXPECT_EQ(line_with(text, "missed"), "missed   unknown");
    EXPECT_THAT(text, HasSubstr("switching time is unknown"));
}

TEST(SummaryText, SaysWhatWasHiddenOnlyWhereThereIsAMask) {
    const auto text_with = [](std::uint64_t texels_hidden, std::uint64_t pixels_hidden) {
        latency::LatencySummary summary({.period_ns = 10'000'000, .grids = latency::kExampleGrids});
        frame::FrameRecord frame = example_frame(0);
        frame.samples.grids[0].hidden = texels_hidden;
        frame.samples.pixels_hidden = pixels_hidden;
        summary.add(frame);
        return summary_text(summary.report());
    };
    EXPECT_THAT(text_with(0, 0), testing::Not(HasSubstr("hidden")));
    const std::string masked = text_with(70, 400);
    EXPECT_THAT(masked, HasSubstr("covered by another grid 50, hidden 70\n"));
    EXPECT_THAT(masked, HasSubstr("pixels   3400, hidden 400\n"));
    // Full resolution would leave them out as well: 3000 over 1000, not 3400.
    EXPECT_THAT(masked, HasSubstr("3.0x fewer samples"));
}

TEST(SummaryText, NeverExceedsItsWidth) {
    latency::LatencySummary summary({.period_ns = std::numeric_limits<std::int64_t>::max(),
                                     .passes = latency::kExamplePasses,
                                     .grids = latency::kExampleGrids});
    for (std::uint64_t index = 0; index < 20; ++index) {
        frame::FrameRecord frame = example_frame(index);
        const std::int64_t far = index % 2 == 0 ? std::numeric_limits<std::int64_t>::min()
                                                : std::numeric_limits<std::int64_t>::max();
        frame.stamps.latch.ns = far;
        frame.stamps.wake_up.ns = -(far / 2);
        frame.fovea.eyes[0].sampled.ns = -(far / 3);
        frame.samples.grid_count = frame::kMostGrids;
        frame.samples.grids.fill({.planned = std::uint64_t{1} << 50U,
                                  .shaded = std::uint64_t{1} << 50U,
                                  .off_screen = std::uint64_t{1} << 50U,
                                  .covered = std::uint64_t{1} << 50U});
        frame.samples.pixels_output = 1;
        summary.add(frame);
    }
    latency::SummaryReport report = summary.report();
    report.gaze = {.received = ~0U, .invalid = ~0U, .lost = ~0ULL, .out_of_order = ~0U};
    report.frames.total = ~0ULL;
    report.frames.rendered = ~0ULL;
    report.frames.in_time_unknown = ~0ULL / 2;
    report.frames.missed = ~0ULL / 3;
    report.frames.periods_missed = ~0ULL;
    for (const std::string& line : lines(summary_text(report))) {
        EXPECT_LE(line.size(), 100U) << line;
    }
}

TEST(SummaryJson, MirrorsTheText) {
    const nlohmann::ordered_json json = summary_json(example_report(30));
    EXPECT_EQ(json["verdict"], "real-time");
    EXPECT_EQ(json["clock"], "wall");
    EXPECT_EQ(json["display_period_ns"], 10'000'000);
    EXPECT_EQ(json["switching_ns"], 2'000'000);
    EXPECT_NEAR(json["eye_to_photon_percent_by_kind"]["measured"], 38.9, 0.1);
    const auto& age = json["durations"]["gaze_age_at_display"];
    EXPECT_EQ(age["kind"], "predicted");
    EXPECT_EQ(age["frames"], 30);
    EXPECT_EQ(age["frames_by_kind"]["predicted"], 30);
    EXPECT_EQ(age["max_ms"], 18.0);
    EXPECT_TRUE(age["p99_ms"].is_null());
    EXPECT_EQ(json["durations"]["stage_wait_for_display"]["mean_ms"], 6.0);
    EXPECT_EQ(json["frames"]["missed"], 0);
    EXPECT_EQ(json["frames"]["by_gaze_state"]["tracking"], 30);
    EXPECT_EQ(json["samples"]["grids"]["lp"]["covered"], 1500);
    EXPECT_EQ(json["samples"]["grids"]["picture"]["shaded"], 6000);
    EXPECT_EQ(json["samples"]["times_fewer_than_full"], 3.4);
}

TEST(SummaryJson, UnknownIsNull) {
    const nlohmann::ordered_json json = summary_json(latency::LatencySummary({}).report());
    EXPECT_TRUE(json["display_period_ns"].is_null());
    EXPECT_TRUE(json["switching_ns"].is_null());
    EXPECT_TRUE(json["eye_to_photon_percent_by_kind"].is_null());
    EXPECT_TRUE(json["frames"]["missed"].is_null());
    EXPECT_TRUE(json["frames"]["missed_percent"].is_null());
    EXPECT_TRUE(json["samples"]["times_fewer_than_full"].is_null());
    EXPECT_TRUE(json["durations"]["gaze_age_at_latch"]["min_ms"].is_null());
}

TEST(SummaryText, SaysWhatHappenedOnlyWhereSomethingDid) {
    EXPECT_THAT(summary_text(example_report(2)), Not(HasSubstr("what happened")));
    EXPECT_EQ(summary_json(example_report(2))["happenings"], nlohmann::ordered_json::array());

    latency::LatencySummary summary({.period_ns = kExamplePeriodNs});
    summary.add(example_frame(10));
    const auto at = [](std::int64_t ms) {
        return time::Stamp{ms * kMs, time::StampKind::Measured};
    };
    summary.add_event(at(150), "display-time-odd", "the announced display time lies 7 s ahead");
    summary.add_event(at(1350), "display-time-odd", "the announced display time lies 9 s ahead");
    summary.add_event(at(350), "head-found", "the head is tracked");
    summary.add_event({}, "left-out", "shadows: no light casts one");
    summary.add_event({}, "display", std::string(150, 'x') + " " + std::string(80, 'y'));
    const latency::SummaryReport report = summary.report();
    const std::string text = summary_text(report);
    EXPECT_THAT(text,
                HasSubstr("what happened, from the first frame on\n"
                          "- display-time-odd, 2 times from 0.050 s to 1.250 s: the announced "
                          "display time lies 9 s ahead\n"
                          "- head-found at 0.250 s: the head is tracked\n"
                          "- left-out all along: shadows: no light casts one\n"
                          "- display, at an unknown time:"));
    for (const std::string& line : lines(text)) {
        EXPECT_LE(line.size(), 100U) << line;
    }
    const nlohmann::ordered_json json = summary_json(report);
    ASSERT_EQ(json["happenings"].size(), 4U);
    EXPECT_EQ(json["happenings"][0]["kind"], "display-time-odd");
    EXPECT_EQ(json["happenings"][0]["warning"], true);
    EXPECT_EQ(json["happenings"][0]["times"], 2);
    EXPECT_EQ(json["happenings"][0]["last_s"], 1.25);
    EXPECT_EQ(json["happenings"][1]["warning"], false);
    EXPECT_EQ(json["happenings"][2]["first_s"], nullptr);
    EXPECT_EQ(json["other_happenings"], 0);
}

TEST(SummaryText, CountsFramesThatAreShownAtAnUnknownTime) {
    latency::LatencySummary summary({.period_ns = kExamplePeriodNs});
    for (std::uint64_t index = 0; index < 4; ++index) {
        frame::FrameRecord frame = example_frame(index);
        if (index == 1) {
            frame.stamps.display = {};
        }
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    EXPECT_EQ(line_with(summary_text(summary.report()), "shown "),
              "shown    at an unknown time in 1 of 4 rendered frames");
    EXPECT_EQ(summary_json(summary.report())["frames"]["display_unknown"], 1);
    EXPECT_THAT(summary_text(summary.report()), HasSubstr("missed 0.0 % of the 75.0 % known"));
    EXPECT_THAT(summary_text(example_report(4)), Not(HasSubstr("at an unknown time")));
}

}  // namespace
}  // namespace gazeloop::report
