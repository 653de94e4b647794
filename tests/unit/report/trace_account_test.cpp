#include "runtime/report/trace_account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/frame/event.h"
#include "runtime/report/gaze_report.h"
#include "tests/unit/gaze/pair_of_eyes.h"

namespace gazeloop::report {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

gaze::TraceReport example_report() {
    gaze::TraceReport report;
    report.rows = 800;
    report.lost_by_tracker = 3;
    report.clock = "fitted to the host's clock: +148 ppm, within 0.20 ms";
    report.axes = "agree with anatomy (median vergence 2.4 deg)";
    report.add({.kind = TraceFindingKind::TimeOutlier,
                .line = 302,
                .rows = 1,
                .dropped = 1,
                .text = "2.5 s ahead: of the rows beside it; dropped"});
    report.add(
        {.kind = TraceFindingKind::OutOfOrder, .line = 410, .rows = 12, .text = "put in order"});
    report.add({.kind = TraceFindingKind::Text, .text = "decimal commas"});
    return report;
}

TraceAccount account_of(const gaze::TraceReport& report) {
    TraceAccount account;
    for (const std::string& event : trace_events(report)) {
        account.take(frame::kTraceEvent.name, event);
    }
    return account;
}

TEST(TraceEvents, SayCountsDirectionsAndFindings) {
    EXPECT_THAT(
        trace_events(example_report()),
        ElementsAre("rows 800, used 799, dropped as time outlier 1, out of order 12, lost by "
                    "the tracker 3",
                    "clock: fitted to the host's clock: +148 ppm, within 0.20 ms",
                    "directions: agree with anatomy (median vergence 2.4 deg)",
                    "302: time outlier: 2.5 s ahead: of the rows beside it; dropped",
                    "410: out of order (12 rows): put in order", "text: decimal commas"));
    EXPECT_TRUE(trace_events({}).empty()) << "no file was read";
}

/// Nobody knows what was lost where no sequence number counts.
TEST(TraceEvents, SayWhereLossesAreUnknown) {
    gaze::TraceReport report = example_report();
    report.lost_by_tracker.reset();
    EXPECT_THAT(trace_events(report)[0],
                HasSubstr(", out of order 12, lost by the tracker unknown"));
    nlohmann::ordered_json json;
    account_of(report).add_to(json);
    EXPECT_TRUE(json["trace"]["lost_by_tracker"].is_null()) << json["trace"];
    report.lost_by_tracker = 0;
    account_of(report).add_to(json);
    EXPECT_EQ(json["trace"]["lost_by_tracker"], 0);
}

TEST(TraceEvents, CountWhatIsNotKept) {
    gaze::TraceReport report;
    report.rows = 100;
    for (std::uint64_t line = 2; line < 32; ++line) {
        report.add({.kind = TraceFindingKind::Repeat,
                    .line = line,
                    .rows = 2,
                    .dropped = 2,
                    .text = "again"});
    }
    const std::vector<std::string> events = trace_events(report);
    EXPECT_EQ(events.size(), 1 + gaze::TraceReport::kKeptOfEachKind + 1);
    EXPECT_EQ(events.back(), "repeat: and 22 more (44 rows)");
}

TEST(TraceEvents, NameFileAndLineForTheLog) {
    EXPECT_EQ(at_file("g.csv", "302: time outlier: x"), "g.csv:302: time outlier: x");
    EXPECT_EQ(at_file("g.csv", "text: decimal commas"), "g.csv: text: decimal commas");
    EXPECT_FALSE(is_finding("rows 800, used 799"));
    EXPECT_FALSE(is_finding("clock: the device's"));
    EXPECT_FALSE(is_finding("directions: agree"));
    EXPECT_TRUE(is_finding("302: time outlier: x"));
}

TEST(TraceAccount, IsTextForPeople) {
    EXPECT_EQ(
        account_of(example_report()).text(),
        "trace    rows 800, used 799, dropped as time outlier 1, out of order 12, lost by the "
        "tracker 3\n"
        "         clock: fitted to the host's clock: +148 ppm, within 0.20 ms\n"
        "         line 302: time outlier: 2.5 s ahead: of the rows beside it; dropped\n"
        "         line 410: out of order (12 rows): put in order\n"
        "         text: decimal commas\n");
    EXPECT_EQ(TraceAccount().text(), "");
}

TEST(TraceAccount, IsJsonForPrograms) {
    nlohmann::ordered_json json;
    account_of(example_report()).add_to(json);
    EXPECT_EQ(json["trace"]["rows"], 800);
    EXPECT_EQ(json["trace"]["used"], 799);
    EXPECT_EQ(json["trace"]["dropped"].dump(), R"({"time outlier":1})");
    EXPECT_EQ(json["trace"]["out_of_order"], 12);
    EXPECT_EQ(json["trace"]["lost_by_tracker"], 3);
    EXPECT_EQ(json["trace"]["clock"], "fitted to the host's clock: +148 ppm, within 0.20 ms");
    ASSERT_EQ(json["trace"]["findings"].size(), 3U);
    EXPECT_EQ(json["trace"]["findings"][0].dump(),
              R"({"line":302,"kind":"time outlier","text":"2.5 s ahead: of the rows beside it; )"
              R"(dropped"})");
    EXPECT_TRUE(json["trace"]["findings"][2]["line"].is_null());
    EXPECT_THAT(json["directions"], HasSubstr("agree"));

    TraceAccount().add_to(json);
    EXPECT_TRUE(json["trace"].is_null());
    EXPECT_TRUE(json["directions"].is_null());
}

/// What a session holds may be cut, or somebody else's.
TEST(TraceAccount, BearsAnyText) {
    TraceAccount account;
    for (const char* const text : {"rows ", "rows 5, used", "rows 8, dropped , ,, x", ":", ": ",
                                   "7: ", "99999999999999999999: x: y", "", "directions: "}) {
        account.take(frame::kTraceEvent.name, text);
    }
    nlohmann::ordered_json json;
    account.add_to(json);
    EXPECT_EQ(json["trace"]["rows"], 8);
    EXPECT_THAT(account.text(), HasSubstr("rows 8"));
}

TEST(TraceAccount, HoldsWhatALiveSourcesDirectionsAreLike) {
    TraceAccount account;
    account.take("tracker", "plugged in");
    account.take("tracker", "directions: agree with anatomy");
    EXPECT_EQ(account.text(), "");
    account.take("axes", "the eyes' rays diverge (median -2.4 deg)");
    EXPECT_EQ(account.text(), "") << "it is among what happened";
    nlohmann::ordered_json json;
    account.add_to(json);
    EXPECT_EQ(json["directions"], "the eyes' rays diverge (median -2.4 deg)");
}

TEST(TraceAccount, KeepsToAHundredColumns) {
    TraceAccount account;
    account.take("trace", "rows " + std::string(40, 'a') + " " + std::string(60, 'b') + " " +
                              std::string(120, 'c') + " d");
    std::istringstream text(account.text());
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
        lines.push_back(line);
    }
    EXPECT_THAT(
        lines, ElementsAre("trace    rows " + std::string(40, 'a'),
                           std::string(9, ' ') + std::string(60, 'b'),
                           std::string(9, ' ') + std::string(120, 'c'), std::string(9, ' ') + "d"));
}

gaze::GazeTrace example_trace() {
    gaze::GazeTrace trace{.file = "g.csv", .format = "gazeloop", .device = "a tracker"};
    trace.samples = gaze::pair_of_eyes();
    for (std::size_t i = 200; i < trace.samples.size(); ++i) {
        trace.samples[i].sampled.ns += 500'000'000;
    }
    trace.samples[10].eyes[1].valid = false;
    trace.report = example_report();
    return trace;
}

TEST(GazeReport, IsTextForPeople) {
    EXPECT_EQ(
        gaze_text(example_trace()),
        "g.csv\n"
        "format   gazeloop, a tracker\n"
        "rows     800, used 400\n"
        "rate     120 Hz for 3.825 s\n"
        "gaps     0.508 s at 1.66 s\n"
        "clock    fitted to the host's clock: +148 ppm, within 0.20 ms\n"
        "eyes     left valid 100.0 %, right 99.8 %, both 99.8 %\n"
        "interval 8.33 ms median, 8.33 to 8.33 ms (5 to 95 %), 13.1 % of the samples missing\n"
        "losses   none\n"
        "noise    left eye 0.455 deg from sample to sample (RMS), 2.585 deg SD, BCEA 12.2472 deg2; "
        "right eye\n"
        "         0.408 deg from sample to sample (RMS), 2.186 deg SD, BCEA 11.2613 deg2 (the "
        "stiller half of\n"
        "         200 ms windows)\n"
        "smoothed unknown: too few saccades: 0 of 2 to 30 deg stand out from the noise, 20 are "
        "needed; look\n"
        "         around for half a minute\n"
        "fixation 4, 62.7 a minute, 4.8 % of the time, each 75 ms (8 to 92), SD 0.75 deg (0.00 to "
        "1.34)\n"
        "saccade  2, 31.4 a minute, 4.1 % of the time, each 83 ms (75 to 83), 5.3 deg (4.3 to "
        "5.3), peaks of\n"
        "         73 deg/s (66 to 73)\n"
        "         unknown: fewer than 10 saccades of 2 deg or more\n"
        "pursuit  2, 31.4 a minute, 71.7 % of the time, each 1325 ms (1325 to 1325), 2.5 deg/s "
        "(2.5 to 2.5)\n"
        "blink    0, 0.0 a minute, 0.0 % of the time\n"
        "other    2, 31.4 a minute, 18.5 % of the time (the eye unseen, or a movement that no eye "
        "makes)\n"
        "axes     agree with anatomy (median vergence 2.4 deg)\n"
        "head     not recorded\n"
        "lost     3 by the tracker\n"
        "found    line 302: time outlier: 2.5 s ahead: of the rows beside it; dropped\n"
        "         line 410: out of order (12 rows): put in order\n"
        "         text: decimal commas\n");
}

TEST(GazeReport, IsJsonForPrograms) {
    const nlohmann::ordered_json json = gaze_json(example_trace());
    EXPECT_EQ(json["samples"], 400);
    EXPECT_NEAR(json["rate_hz"], 120.0, 1e-3);
    EXPECT_NEAR(json["longest_gaps"][0]["length_s"], 0.508333, 1e-5);
    EXPECT_EQ(json["longest_gaps"].size(), 1U);
    EXPECT_EQ(json["valid_percent"]["right"], 99.75);
    EXPECT_EQ(json["clock"], "fitted to the host's clock: +148 ppm, within 0.20 ms");
    EXPECT_EQ(json["trace"]["rows"], 800);
    EXPECT_EQ(json["lost"], 3);
}

/// A session's gaze has no reader, and may lack times.
TEST(GazeReport, DoesWithoutAReadersReport) {
    gaze::GazeTrace trace{.file = "s.gaze", .format = "session", .device = "recorded session"};
    trace.samples = gaze::pair_of_eyes(-2.4);
    trace.samples[399].sequence = 402;
    for (gaze::GazeSample& sample : trace.samples) {
        sample.sampled = {};
    }
    const std::string text = gaze_text(trace);
    EXPECT_THAT(text, HasSubstr("samples  400\nrate     unknown"));
    EXPECT_THAT(text, HasSubstr("rays diverge"));
    EXPECT_THAT(text, HasSubstr("lost     3 by the tracker"));
    EXPECT_THAT(text, Not(HasSubstr("found")));
}

}  // namespace
}  // namespace gazeloop::report
