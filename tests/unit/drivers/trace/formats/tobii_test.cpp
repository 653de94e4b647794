#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/gzip.h"
#include "tests/support/recorded_data.h"
#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_findings.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kLeftEye =
    R"("eyeleft":{"gazeorigin":[28.5,-11,-25.2],"gazedirection":[-0.02,0.2,1]})";
constexpr std::string_view kRightEye =
    R"("eyeright":{"gazeorigin":[-31.8,-9.4,-25.9],"gazedirection":[0.02,0.2,1]})";

std::string gaze_line(double time_s, const std::string& data) {
    return fmt::format("{{\"type\":\"gaze\",\"timestamp\":{:.6f},\"data\":{{{}}}}}\n", time_s,
                       data);
}

std::string both_eyes(double time_s) {
    return gaze_line(time_s, fmt::format("{},{}", kLeftEye, kRightEye));
}

TEST(TobiiGlasses3, TurnsLeftForwardAxesIntoOurs) {
    RecordingFolder folder;
    std::string text;
    for (int i = 0; i < 30; ++i) {
        text += both_eyes(0.006684 + 0.01 * i);
    }
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(folder.write("gazedata.gz", tests::gzipped(text))));
    EXPECT_EQ(trace.format, "tobii-glasses-3");
    ASSERT_EQ(trace.samples.size(), 30U);
    EXPECT_EQ(trace.samples[0].device_ns, 6'684'000);
    EXPECT_EQ(trace.samples[1].sampled.ns, 10'000'000);
    const gaze::GazeSample& sample = trace.samples[0];
    expect_near(sample.eyes[0].origin_m, {-0.0285, -0.011, 0.0252});
    expect_near(sample.eyes[1].origin_m, {0.0318, -0.0094, 0.0259});
    // The file's -.02 is to the right of its left: the left eye looks right, up by atan .2.
    EXPECT_NEAR(right_deg(sample.eyes[0].direction), glm::degrees(std::atan(0.02)), 1e-9);
    EXPECT_NEAR(right_deg(sample.eyes[1].direction), -glm::degrees(std::atan(0.02)), 1e-9);
    EXPECT_NEAR(up_deg(sample.eyes[0].direction),
                glm::degrees(std::atan2(0.2, std::hypot(1.0, 0.02))), 1e-9);
    expect_anatomy(trace);
}

/// JSON has no such numbers, programs write them all the same.
TEST(TobiiGlasses3, TakesNumbersThatJsonLacks) {
    for (const std::string_view odd : {"NaN", "-Infinity", "Infinity", "1e999", "-nan", "inf"}) {
        RecordingFolder folder;
        const std::string file = folder.write(
            "gazedata",
            both_eyes(0.0) +
                gaze_line(0.01, fmt::format(R"("eyeleft":{{"gazedirection":[0,{},1]}},{})", odd,
                                            kRightEye)) +
                gaze_line(0.02, fmt::format(R"({},"eyeright":{{"gazeorigin":[-31.8,-9.4,-25.9],)"
                                            R"("gazedirection":[0,0,1],"pupildiameter":{}}})",
                                            kLeftEye, odd)) +
                both_eyes(0.03));
        const gaze::GazeTrace trace = value_or_throw(read_trace(file));
        ASSERT_EQ(trace.samples.size(), 4U) << odd;
        EXPECT_FALSE(trace.samples[1].eyes[0].valid) << odd;
        EXPECT_TRUE(trace.samples[1].eyes[1].valid) << odd;
        EXPECT_TRUE(trace.samples[2].eyes[1].valid) << odd << ": nobody asks for the diameter";
        EXPECT_THAT(told(trace, gaze::TraceFindingKind::BadCells),
                    ElementsAre(HasSubstr("2: left eye: 'gazedirection'")))
            << odd;
        EXPECT_EQ(trace.report.rows_dropped(), 0U);
    }
    RecordingFolder folder;
    EXPECT_THAT(refusal(folder.write("gazedata", both_eyes(0.0) + "{\"a\":abc}\n")),
                HasSubstr("no JSON object"));
}

TEST(TobiiGlasses3, CountsPlacesThatAreMissing) {
    RecordingFolder folder;
    const std::string file = folder.write(
        "gazedata", both_eyes(0.0) + gaze_line(0.01, R"("eyeleft":{"gazedirection":[0,0,1]})") +
                        both_eyes(0.02));
    EXPECT_THAT(told(value_or_throw(read_trace(file)), gaze::TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("2: left eye's place: 'gazeorigin'")));
}

TEST(TobiiGlasses3, MixesTypesAndLosesEyes) {
    RecordingFolder folder;
    const std::string file = folder.write(
        "gazedata",
        both_eyes(0.0) + "{\"type\":\"syncport\",\"timestamp\":0.004}\n" +
            gaze_line(0.01, std::string{kLeftEye}) + gaze_line(0.02, "") + "\n" +
            gaze_line(0.03, R"("eyeleft":{},"eyeright":{"gazedirection":[0,0,0]})") +
            gaze_line(0.04, R"("eyeleft":{"gazedirection":[0,"x",1]},"eyeright":null)") +
            both_eyes(0.05) + "{\"type\":\"gaze\",\"timesta");
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    std::string valid;
    for (const gaze::GazeSample& sample : trace.samples) {
        valid += fmt::format("{:d}{:d} ", sample.eyes[0].valid, sample.eyes[1].valid);
    }
    EXPECT_EQ(valid, "11 10 00 00 00 11 ");
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("7: left eye: 'gazedirection'"),
                            HasSubstr("6: right eye: 'gazedirection'")));
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::CutRow), ElementsAre(HasSubstr("9: ")));
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                ElementsAre("2: 1 line not of the type 'gaze': left out"));
}

TEST(TobiiGlasses3, RefusesWhatIsNotIt) {
    RecordingFolder folder;
    EXPECT_THAT(refusal(folder.write("a", "{\"type\":\"imu\",\"timestamp\":1}\n")),
                HasSubstr("no line of the type 'gaze'"));
    EXPECT_THAT(refusal(folder.write("b", both_eyes(0.0) + "{]\n" + both_eyes(0.01))),
                HasSubstr("b:2: no JSON object: mend or remove the line"));
    EXPECT_THAT(refusal(folder.write("c", gaze_line(0.0, "") + gaze_line(0.01, ""))),
                HasSubstr("no valid gaze"));
}

TEST(TobiiGlasses3Recording, IsReadWithTheLeftEyeOnTheLeft) {
    const std::string name = "traces/tobii_glasses_3/gazedata.gz";
    if (const std::string missing = tests::no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const auto file = tests::recorded_data(name);
    const gaze::GazeTrace trace = value_or_throw(read_trace(file.string()));
    EXPECT_EQ(trace.report.rows, 6547U);
    EXPECT_EQ(trace.report.rows_dropped(), 0U);
    EXPECT_EQ(trace.report.valid[0], 5347U + 613U);
    EXPECT_EQ(trace.report.valid[1], 5347U + 175U);
    expect_anatomy(trace);
}

// ---- Pro Lab
// -------------------------------------------------------------------------------------

std::string pro_lab(std::string_view unit, std::string_view suffix, std::string_view place) {
    std::string header = fmt::format("Recording timestamp{}\tSensor", unit);
    for (const std::string_view side : {"left", "right"}) {
        for (const char axis : {'X', 'Y', 'Z'}) {
            header += fmt::format("\tGaze direction {} {}{}", side, axis, suffix);
        }
        for (const char axis : {'X', 'Y', 'Z'}) {
            header += fmt::format("\t{} {} {}", place, side, axis);
        }
        header += fmt::format("\tValidity {}", side);
    }
    return header + "\n";
}

TEST(TobiiProLab, ReadsGlassesWithDecimalCommasAmongOtherSensors) {
    RecordingFolder folder;
    std::string text = pro_lab(" [\xCE\xBCs]", " [HUCS norm]", "Pupil position");
    for (int i = 0; i < 30; ++i) {
        text += fmt::format("{}\tGyroscope\t\t\t\t\t\t\t\t\t\t\t\t\t\t\n", 10'000 * i + 5'000);
        text += fmt::format(
            "{}\tEye Tracker\t-0,02\t0,2\t1\t28,5\t-11\t-25\tValid\t0,02\t0,2\t1\t-31,5\t-9\t-25\t"
            "{}\n",
            10'000 * i + 10'000, i == 3 ? "Invalid" : "Valid");
    }
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("e.tsv", text)));
    EXPECT_EQ(trace.format, "tobii-pro-lab");
    ASSERT_EQ(trace.samples.size(), 30U);
    EXPECT_EQ(trace.samples[2].sampled.ns, 20'000'000);
    EXPECT_FALSE(trace.samples[3].eyes[1].valid);
    EXPECT_TRUE(trace.samples[3].eyes[0].valid);
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[0].direction), glm::degrees(std::atan(0.02)), 1e-9);
    EXPECT_GT(up_deg(trace.samples[0].eyes[0].direction), 10.0);
    expect_near(trace.samples[0].eyes[0].origin_m, {-0.0285, -0.011, 0.025});
    expect_anatomy(trace);
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                ElementsAre("3: decimal commas: read as points",
                            "2: 30 rows of other sensors than 'Eye Tracker': left out"));
}

/// A project's export has all its recordings in one file.
TEST(TobiiProLab, NamesTheRecordingsThatItLeavesOut) {
    RecordingFolder folder;
    std::string text =
        "Recording timestamp [ms]\tRecording name\tSensor\tGaze direction left X [HUCS norm]\t"
        "Gaze direction left Y [HUCS norm]\tGaze direction left Z [HUCS norm]\n";
    std::string mouse = text;
    for (int i = 0; i < 30; ++i) {
        text += fmt::format("{}\tR{}\tEye Tracker\t0.02\t0.1\t1\n", 10 * i,
                            i < 20   ? 1
                            : i < 27 ? 2
                                     : 3);
        mouse += fmt::format("{}\tR1\tMouse\t\t\t\n", 10 * i);
    }
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("e.tsv", text)));
    EXPECT_EQ(trace.samples.size(), 20U);
    EXPECT_EQ(trace.report.rows, 30U);
    EXPECT_EQ(trace.report.rows_dropped(), 10U);
    EXPECT_TRUE(trace.report.worth_a_warning());
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::OtherRecording),
                ElementsAre(HasSubstr("22: only 'R1' is read, which the first row is of by "
                                      "'Recording name'; left out: 'R2' (7 rows), 'R3' (3 rows)")));
    EXPECT_THAT(
        refusal(folder.write("m.tsv", mouse)),
        HasSubstr("m.tsv:2: all 30 rows are of other sensors than 'Eye Tracker': export the "
                  "eye tracker's rows too"));
}

TEST(TobiiProLab, ReadsAScreenWhoseYIsDown) {
    RecordingFolder folder;
    std::string text = pro_lab(" [ms]", " [DACS norm]", "Eye position");
    for (int i = 0; i < 30; ++i) {
        text += fmt::format(
            "{}\tEye Tracker\t0.05\t0.1\t-1\t200\t90\t600\tValid\t"
            "-0.05\t0.1\t-1\t260\t90\t600\tValid\n",
            4 * i);
    }
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("e.tsv", text)));
    EXPECT_EQ(trace.samples[1].sampled.ns, 4'000'000);
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[0].direction), glm::degrees(std::atan(0.05)), 1e-9);
    EXPECT_LT(up_deg(trace.samples[0].eyes[0].direction), -5.0);
    const gaze::Anatomy anatomy = gaze::anatomy_of(trace.samples);
    EXPECT_EQ(anatomy.verdict, gaze::AnatomyVerdict::Agrees);
}

TEST(TobiiProLab, AsksForTheUnitOfTime) {
    RecordingFolder folder;
    EXPECT_THAT(refusal(folder.write("e.tsv", pro_lab("", "", "Eye position"))),
                HasSubstr("e.tsv:1: 'Recording timestamp' does not say its unit"));
    EXPECT_THAT(refusal(folder.write("p.tsv", "Recording timestamp [ms]\tSensor\tGaze point X\n")),
                HasSubstr("gaze points alone have no geometry"));
}

}  // namespace
}  // namespace gazeloop::drivers
