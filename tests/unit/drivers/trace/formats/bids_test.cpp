#include "drivers/trace/bids/read_bids.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/bids_rules.h"
#include "tests/support/gzip.h"
#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_findings.h"

namespace gazeloop::drivers {
namespace {

using Json = nlohmann::json;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Json physio(std::string_view eye = "left") {
    return {{"PhysioType", "eyetrack"},
            {"RecordedEye", eye},
            {"SampleCoordinateSystem", "eye-in-head"},
            {"SamplingFrequency", 250},
            {"StartTime", 0},
            {"Manufacturer", "Maker"},
            {"ManufacturersModelName", "Model"},
            {"Columns", {"timestamp", "x_coordinate", "y_coordinate", "pupil_size"}},
            {"timestamp", {{"Units", "ms"}}},
            {"x_coordinate", {{"Units", "deg"}}},
            {"y_coordinate", {{"Units", "deg"}}}};
}

Json on_screen(std::string_view eye = "left") {
    Json json = physio(eye);
    json["SampleCoordinateSystem"] = "gaze-on-screen";
    json["x_coordinate"]["Units"] = "pixel";
    json["y_coordinate"]["Units"] = "pixel";
    return json;
}

Json screen() {
    return {{"StimulusPresentation",
             {{"ScreenDistance", 0.5},
              {"ScreenOrigin", {"top", "left"}},
              {"ScreenResolution", {1000, 600}},
              {"ScreenSize", {0.4, 0.3}}}}};
}

/// A data set of one subject; `eye` is "eye1" or "eye2".
class BidsFolder {
  public:
    BidsFolder() { folder_.write("ds/dataset_description.json", "{}"); }
    std::string write(const std::string& name, const std::string& bytes) {
        return folder_.write("ds/" + name, bytes);
    }
    std::string recording(const std::string& eye, const Json& json, const std::string& rows) {
        const std::string stem =
            fmt::format("sub-01/beh/sub-01_task-look_recording-{}_physio", eye);
        write(stem + ".json", json.dump());
        return write(stem + ".tsv.gz", tests::gzipped(rows));
    }

  private:
    RecordingFolder folder_;
};

TEST(BidsName, TakesNamesApart) {
    const auto name = bids_name("a/sub-01_task-look_recording-eye1_physio.tsv.gz");
    ASSERT_TRUE(name);
    EXPECT_EQ(name->suffix, "physio");
    EXPECT_EQ(name->extension, ".tsv.gz");
    EXPECT_THAT(name->entities, testing::SizeIs(3));
    EXPECT_EQ(name->entities.at("recording"), "eye1");
    EXPECT_FALSE(bids_name("sub-_physio.tsv.gz"));
    EXPECT_FALSE(bids_name("-01_physio.tsv.gz"));
    EXPECT_FALSE(bids_name("sub_physio.tsv.gz"));
    EXPECT_FALSE(bids_name("sub-01.tsv.gz"));
    EXPECT_FALSE(is_bids_physio("physio.tsv.gz"));
    EXPECT_TRUE(is_bids_physio("sub-01_physio.tsv"));
    EXPECT_EQ(with_recording("d/sub-01_recording-eye1_physio.tsv.gz", "eye2", "physioevents"),
              "d/sub-01_recording-eye2_physioevents.tsv.gz");
}

TEST(BidsRules, NameEachThatIsBroken) {
    EXPECT_THAT(broken_bids_rules(physio(), {}), IsEmpty());
    EXPECT_THAT(broken_bids_rules(on_screen(), screen()), IsEmpty());
    struct Case {
        const char* key;
        Json value;
        const char* said;
    };
    for (const Case& wrong : {
             Case{"PhysioType", "generic", "PhysioType must be \"eyetrack\"; it is \"generic\""},
             Case{"RecordedEye", "both",
                  "RecordedEye must be \"left\", \"right\" or \"cyclopean\"; it is \"both\""},
             Case{"SampleCoordinateSystem", 3, "it is 3"},
             Case{"SamplingFrequency", 0, "SamplingFrequency must be a number above 0; it is 0"},
             Case{"SamplingFrequency", "n/a", "it is \"n/a\""},
             Case{"StartTime", nullptr, "StartTime must be a number; it is null"},
             Case{"Columns", {"timestamp", "y_coordinate", "x_coordinate"}, "Columns must be"},
             Case{"Columns",
                  {"timestamp", "x_coordinate", "y_coordinate", "timestamp"},
                  "Columns must be distinct names"},
             Case{"Columns", Json::parse("[[[]]]"), "it is of another form"},
             Case{"x_coordinate", Json::object(),
                  "x_coordinate/Units must be a unit; it is "
                  "missing"},
             Case{"y_coordinate", "deg", "y_coordinate/Units must be a unit; it is missing"},
         }) {
        Json json = physio();
        json[wrong.key] = wrong.value;
        EXPECT_THAT(broken_bids_rules(json, {}), ElementsAre(HasSubstr(wrong.said))) << wrong.key;
        json = physio();
        json.erase(wrong.key);
        EXPECT_THAT(broken_bids_rules(json, {}), ElementsAre(HasSubstr("it is missing")))
            << wrong.key;
    }
    for (const char* const key :
         {"ScreenDistance", "ScreenOrigin", "ScreenResolution", "ScreenSize"}) {
        Json events = screen();
        events["StimulusPresentation"].erase(key);
        EXPECT_THAT(broken_bids_rules(on_screen(), events), ElementsAre(HasSubstr(key)));
        EXPECT_THAT(broken_bids_rules(physio(), events), IsEmpty()) << "no screen";
        events["StimulusPresentation"][key] = "words";
        EXPECT_THAT(broken_bids_rules(on_screen(), events), ElementsAre(HasSubstr("\"words\"")));
    }
    EXPECT_THAT(broken_bids_rules({}, {}), testing::SizeIs(8));
}

TEST(Bids, JoinsBothEyesByTheirTimes) {
    BidsFolder folder;
    std::string left;
    std::string right;
    for (int i = 0; i < 30; ++i) {
        left += fmt::format("{}\t{}\t{}\t3.1\n", 100 + 4 * i, i == 2 ? "n/a" : "31",
                            i == 2 ? "n/a" : "5");
        if (i != 3) {
            right += fmt::format("{}\t29\t5\t3.2\n", 100 + 4 * i);
        }
    }
    const std::string file = folder.recording("eye1", physio("left"), left);
    folder.recording("eye2", physio("right"), right);
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_EQ(trace.format, "bids");
    EXPECT_EQ(trace.device, "Maker Model");
    ASSERT_EQ(trace.samples.size(), 30U);
    EXPECT_EQ(trace.samples[1].sampled.ns, 4'000'000);
    EXPECT_EQ(trace.samples[0].device_ns, 100'000'000);
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[0].direction), 31.0, 1e-9);
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[1].direction), 29.0, 1e-9);
    EXPECT_NEAR(up_deg(trace.samples[0].eyes[0].direction), 5.0, 1e-9);
    EXPECT_FALSE(trace.samples[2].eyes[0].valid);
    EXPECT_TRUE(trace.samples[2].eyes[1].valid);
    EXPECT_FALSE(trace.samples[3].eyes[1].valid);
    EXPECT_FALSE(trace.samples[0].parallax_rad);
    EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::BadCells).rows, 0U) << "n/a is a loss";
    EXPECT_EQ(gaze::anatomy_of(trace.samples).verdict, gaze::AnatomyVerdict::Agrees);
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                Contains("0: two recordings, of which 29 rows have the same times"));
    // The other eye's file finds its pair too.
    const gaze::GazeTrace other =
        value_or_throw(read_trace(with_recording(file, "eye2", "physio").string()));
    EXPECT_EQ(other.samples.size(), 30U);
    EXPECT_NEAR(right_deg(other.samples[0].eyes[0].direction), 31.0, 1e-9);
}

TEST(Bids, InheritsSidecarsAndTheScreen) {
    BidsFolder folder;
    Json shared = on_screen("left");
    shared.erase("RecordedEye");
    folder.write("task-look_physio.json", shared.dump());
    folder.write("task-other_physio.json", R"({"SamplingFrequency": "not ours"})");
    folder.write("task-look_events.json", screen().dump());
    const std::string file =
        folder.recording("eye1", {{"RecordedEye", "cyclopean"}}, "0\t500\t300\t1\n2\t1750\t0\t1\n");
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    expect_near(trace.samples[0].eyes[0].direction, {0.0, 0.0, -1.0});
    EXPECT_NEAR(right_deg(trace.samples[1].eyes[1].direction), 45.0, 1e-9);
    EXPECT_GT(up_deg(trace.samples[1].eyes[1].direction), 0.0);
    EXPECT_TRUE(trace.samples[0].parallax_rad);
}

TEST(Bids, TakesBlinksFromPhysioevents) {
    BidsFolder folder;
    const std::string file =
        folder.recording("eye1", physio(), "0\t1\t1\t1\n4\t1\t1\t1\n8\t1\t1\t1\n12\t1\t1\t1\n");
    const std::string stem = "sub-01/beh/sub-01_task-look_recording-eye1_physioevents";
    folder.write(stem + ".json",
                 R"({"Columns": ["onset", "duration", "trial_type"], "OnsetSource": "timestamp"})");
    folder.write(stem + ".tsv.gz",
                 tests::gzipped("-5\t0.001\tblink\n3\t0.006\tblink\n10\t0.1\tsaccade\n"));
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    std::string valid;
    for (const gaze::GazeSample& sample : trace.samples) {
        valid += sample.eyes[0].valid ? '1' : '0';
    }
    EXPECT_EQ(valid, "1001");
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::RefusedByBit),
                ElementsAre("2: gaze not vouched for in 2 rows: a blink (physioevents)"));

    // Onsets by row: one from before the first row on (4 ms each), one of no length at the last.
    folder.write(stem + ".json",
                 R"({"Columns": ["onset", "duration", "blink"], "OnsetSource": "n/a"})");
    folder.write(stem + ".tsv.gz", tests::gzipped("3\t0\t1\n-2\t0.008\t1\n1\t1\t0\n"));
    const gaze::GazeTrace by_row = value_or_throw(read_trace(file));
    valid.clear();
    for (const gaze::GazeSample& sample : by_row.samples) {
        valid += sample.eyes[0].valid ? '1' : '0';
    }
    EXPECT_EQ(valid, "0110");
}

TEST(Bids, RefusesWithTheRuleOrTheUnit) {
    BidsFolder folder;
    const std::string row = "0\t1\t1\t1\n";
    const auto said = [&](const Json& json, const std::string& rows) {
        return refusal(folder.recording("eye1", json, rows));
    };
    EXPECT_THAT(said(physio("both"), row),
                HasSubstr("breaks BIDS' rules for eye tracking: RecordedEye must be"));
    Json json = physio();
    json["timestamp"]["Units"] = "fortnights";
    EXPECT_THAT(said(json, row), HasSubstr("timestamp/Units is 'fortnights': write s, ms, us"));
    json = physio();
    json["x_coordinate"]["Units"] = json["y_coordinate"]["Units"] = "pixel";
    EXPECT_THAT(said(json, row), HasSubstr("an eye's direction in 'pixel': write deg or rad"));
    json = physio();
    json["SampleCoordinateSystem"] = "gaze-in-world";
    EXPECT_THAT(said(json, row), HasSubstr("says no direction in the head"));
    EXPECT_THAT(said(on_screen(), row), HasSubstr("StimulusPresentation/ScreenDistance (of the "
                                                  "events' JSON"));
    EXPECT_THAT(said(physio(), "timestamp\tx\ty\tpupil\n" + row),
                HasSubstr("'timestamp' is no time in ms"))
        << "a header line";
    EXPECT_THAT(said(physio(), "0\t1\t1\n4\t1\t1\t1\n"), HasSubstr(":1: 3 columns"));
    EXPECT_THAT(refusal(folder.write("sub-01/beh/sub-01_task-alone_physio.tsv.gz", "")),
                HasSubstr("no sidecar"));
}

/// Two eyes of 250 Hz over 1 s; the right one's times as they are given.
gaze::GazeTrace two_eyes(const std::vector<int>& right_ms, double right_rate_hz = 250.0) {
    BidsFolder folder;
    std::string left;
    std::string right;
    for (int i = 0; i < 250; ++i) {
        left += fmt::format("{}\t31\t{}\t3.1\n", 100 + 4 * i, 5 + 0.01 * i);
    }
    for (std::size_t i = 0; i < right_ms.size(); ++i) {
        right += fmt::format("{}\t29\t{}\t3.2\n", right_ms[i], 5 + 0.01 * static_cast<double>(i));
    }
    const std::string file = folder.recording("eye1", physio("left"), left);
    Json json = physio("right");
    json["SamplingFrequency"] = right_rate_hz;
    folder.recording("eye2", json, right);
    return value_or_throw(read_trace(file));
}

std::vector<int> times_ms(int first, int count) {
    std::vector<int> times;
    times.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        times.push_back(first + 4 * i);
    }
    return times;
}

TEST(Bids, JudgesTheClockOfEachEyeBeforeItJoinsThem) {
    std::vector<int> right = times_ms(100, 250);
    EXPECT_FALSE(two_eyes(right).report.worth_a_warning());
    right[60] += 2'500;
    std::swap(right[120], right[121]);
    const gaze::GazeTrace trace = two_eyes(right);
    ASSERT_EQ(trace.samples.size(), 250U) << "of the outlier's time the left eye is there";
    EXPECT_EQ(trace.report.rows, 251U);
    EXPECT_EQ(trace.report.rows_dropped(), 1U);
    EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::DeviceClockSet).times, 0U);
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::TimeOutlier),
                ElementsAre(HasSubstr("61: sub-01_task-look_recording-eye2_physio.tsv.gz: 2.5")));
    for (std::size_t i = 0; i < 250; ++i) {
        EXPECT_EQ(trace.samples[i].sampled.ns, static_cast<std::int64_t>(i) * 4'000'000);
        EXPECT_TRUE(trace.samples[i].eyes[0].valid) << i;
        EXPECT_EQ(trace.samples[i].eyes[1].valid, i != 60) << i;
    }
}

std::string eye_rows(int step) {
    std::string rows;
    for (int i = 0; i < 100; ++i) {
        rows += fmt::format("{}\t{}\t5\t3\n", i * step, i % 10);
    }
    return rows;
}

TEST(Bids, ReadsEyesOfWhichOneIsPacked) {
    BidsFolder folder;
    folder.recording("eye1", physio("left"), eye_rows(4));
    const std::string packed = folder.recording("eye2", physio("right"), eye_rows(4));
    const std::string stem = "sub-01/beh/sub-01_task-look_recording-eye1_physio";
    const std::string plain = folder.write(stem + ".tsv", eye_rows(4));
    std::filesystem::remove(plain + ".gz");
    for (const std::string& file : {plain, packed}) {
        const gaze::GazeTrace trace = value_or_throw(read_trace(file));
        EXPECT_EQ(trace.report.valid, (gaze::PerEye<std::uint64_t>{100, 100})) << file;
    }
}

TEST(Bids, RefusesEyesWhoseClocksAreInOtherUnits) {
    BidsFolder folder;
    const std::string file = folder.recording("eye1", physio("left"), eye_rows(4));
    Json json = physio("right");
    json["timestamp"]["Units"] = "ns";
    folder.recording("eye2", json, eye_rows(4));
    EXPECT_THAT(refusal(file), HasSubstr("one goes on 1e+06 times as fast as the other: mend the "
                                         "timestamp's Units"));
}

TEST(Bids, CountsWhatIsMissingWhereOtherRowsHaveIt) {
    BidsFolder folder;
    Json json = physio("left");
    for (const char* column :
         {"eye_openness", "confidence", "origin_x_m", "origin_y_m", "origin_z_m"}) {
        json["Columns"].push_back(column);
    }
    std::string rows;
    for (int i = 0; i < 100; ++i) {
        rows += fmt::format("{}\t{}\t5\t3\t{}\n", 4 * i, i % 10,
                            i == 30 ? "n/a\tn/a\tn/a\t0\t0" : "1\t1\t-0.03\t0\t0");
    }
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.recording("eye1", json, rows)));
    EXPECT_EQ(trace.samples[30].eyes[0].origin_m, glm::dvec3(0.0));
    EXPECT_THAT(
        told(trace, gaze::TraceFindingKind::BadCells),
        ElementsAre(HasSubstr("31: left eye's place: column 'origin_x_m': 'n/a'"),
                    HasSubstr("31: left eye's openness"), HasSubstr("31: left eye's confidence")));
}

TEST(Bids, OfAFolderNamesARecording) {
    BidsFolder folder;
    const std::string file = folder.recording("eye1", physio("left"), eye_rows(4));
    const std::string root =
        std::filesystem::path(file).parent_path().parent_path().parent_path().string();
    EXPECT_THAT(refusal(root), HasSubstr("name a recording, " + file));
}

TEST(Bids, WarnsWhereTheEyesTimesDoNotMatch) {
    for (const auto& [times, same] :
         {std::pair{times_ms(101, 250), 0}, std::pair{times_ms(100, 125), 125},
          std::pair{times_ms(2'101, 250), 0}}) {
        const gaze::GazeTrace trace = two_eyes(times);
        EXPECT_TRUE(trace.report.worth_a_warning()) << times[0];
        EXPECT_THAT(told(trace, gaze::TraceFindingKind::OddTimes),
                    ElementsAre(HasSubstr(fmt::format("only {} have the same", same))));
    }
}

TEST(Bids, WarnsOfAStatedRateThatIsNotTheTimes) {
    const gaze::GazeTrace trace = two_eyes(times_ms(100, 250), 10.0);
    EXPECT_THAT(
        told(trace, gaze::TraceFindingKind::OddTimes),
        ElementsAre("0: sub-01_task-look_recording-eye2_physio.tsv.gz: its sidecar states a "
                    "SamplingFrequency of 10 Hz, its timestamps are those of 250 Hz: mend "
                    "the one that is wrong, or the timestamp's Units"));
    EXPECT_FALSE(two_eyes(times_ms(100, 250), 260.0).report.worth_a_warning()) << "about it is";
    // A fifth of the samples is missing, one at a time: the mean rate is 200 Hz.
    std::vector<int> thinned;
    for (const int time : times_ms(100, 250)) {
        if (time % 20 != 0) {
            thinned.push_back(time);
        }
    }
    for (const double stated_hz : {200.0, 250.0}) {
        EXPECT_THAT(told(two_eyes(thinned, stated_hz), gaze::TraceFindingKind::OddTimes),
                    Each(Not(HasSubstr("SamplingFrequency"))))
            << stated_hz;
    }
}

}  // namespace
}  // namespace gazeloop::drivers
