#include "drivers/trace/formats/eyelink_asc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_findings.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kPreamble =
    "** CONVERTED FROM a.edf using edfapi 4.2.1\n"
    "** DATE: Tue Jan  1\n"
    "\n"
    "MSG\t100 !MODE RECORD CR 1000 2 1 LR\n"
    "MSG\t101 GAZE_COORDS 0.00 0.00 999.00 599.00\n"
    "START\t200 \tLEFT\tRIGHT\tSAMPLES\tEVENTS\n"
    "SAMPLES\tGAZE\tLEFT\tRIGHT\tRATE\t1000.00\tTRACKING\tCR\tFILTER\t2\n";

/// 40 x 30 cm of 1000 x 600 px, 50 cm away.
std::string with_sidecar(RecordingFolder& folder, const std::string& name,
                         const std::string& text) {
    folder.write(name + ".json", R"({"screen_size_m": [0.4, 0.3], "view_distance_m": 0.5})");
    return folder.write(name + ".asc", text);
}

TEST(EyelinkAsc, ReadsSamplesAmongMessagesAndEvents) {
    RecordingFolder folder;
    const std::string file =
        with_sidecar(folder, "a",
                     std::string{kPreamble} +
                         "200\t  499.5\t  299.5\t 1000.0\t 1749.5\t  299.5\t .\t.....\n"
                         "SFIX L   201\n"
                         "201\t  499.5\t   -0.5\t 1000.0\t   .\t   .\t    0.0\t...\n"
                         "MSG\t199 late \"message\n"
                         "EBLINK R 201\t202\t2\n"
                         "202\t  x\t  299.5\t 1000.0\t  499.5\t  299.5\t  1.0\t...\n"
                         "END\t203 \tSAMPLES\tEVENTS\tRES\t  38.5\t  31.1\n"
                         "203\t  49");
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_EQ(trace.format, "eyelink-asc");
    ASSERT_EQ(trace.samples.size(), 3U);
    EXPECT_EQ(trace.samples[0].device_ns, 200'000'000);
    EXPECT_EQ(trace.samples[1].sampled.ns, 1'000'000);
    // The middle of 1000 pixels whose centres are 0 to 999.
    expect_near(trace.samples[0].eyes[0].direction, {0.0, 0.0, -1.0});
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[1].direction), 45.0, 1e-9) << "without a pupil";
    EXPECT_NEAR(up_deg(trace.samples[1].eyes[0].direction), glm::degrees(std::atan(0.3)), 1e-9);
    EXPECT_FALSE(trace.samples[1].eyes[1].valid);
    EXPECT_FALSE(trace.samples[2].eyes[0].valid);
    EXPECT_TRUE(trace.samples[2].eyes[1].valid);
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("13: left eye: x or y is no number")));
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::CutRow), ElementsAre(HasSubstr("15: ")));
}

TEST(EyelinkAsc, ReadsHalfMillisecondsOfOneEye) {
    RecordingFolder folder;
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(with_sidecar(folder, "a",
                                               "** CONVERTED FROM a.edf\n"
                                               "MSG\t1 DISPLAY_COORDS 0 0 999 599\n"
                                               "SAMPLES\tGAZE\tRIGHT\tRATE\t2000.00\n"
                                               "10.0\t499.5\t299.5\t1\n10.5\t499.5\t299.5\t1\n")));
    EXPECT_EQ(trace.samples[1].sampled.ns, 500'000);
    EXPECT_FALSE(trace.samples[0].eyes[0].valid);
    EXPECT_TRUE(trace.samples[0].eyes[1].valid);
}

TEST(EyelinkAsc, RefusesWhatHasNoGeometry) {
    RecordingFolder folder;
    EXPECT_THAT(
        refusal(folder.write("alone.asc", std::string{kPreamble} + "1\t1\t1\t1\t1\t1\t1\n")),
        HasSubstr("pixels have no direction without screen_size_m and view_distance_m"));
    EXPECT_THAT(refusal(with_sidecar(folder, "h", "** CONVERTED FROM a\nSAMPLES\tHREF\tLEFT\n")),
                HasSubstr("h.asc:2: samples that are not GAZE have no geometry"));
    EXPECT_THAT(refusal(with_sidecar(folder, "b", "** CONVERTED FROM a\n1\t1\t1\t1\n")),
                HasSubstr("b.asc:2: a sample before a line SAMPLES"));
    EXPECT_THAT(refusal(with_sidecar(folder, "s", std::string{kPreamble} + "1\t1\t1\t1\n2\t1\n")),
                HasSubstr("s.asc:8: 4 cells, a sample of 2 eyes has 7"));
    EXPECT_THAT(refusal(with_sidecar(folder, "n", "** CONVERTED FROM a\n")), HasSubstr("no rows"));
}

TEST(EyelinkAsc, FollowsAScreenWhosePixelsChange) {
    RecordingFolder folder;
    const gaze::GazeTrace trace = value_or_throw(read_trace(
        with_sidecar(folder, "a",
                     std::string{kPreamble} + "200\t499.5\t299.5\t1\t1749.5\t299.5\t1\t...\n" +
                         "MSG\t201 GAZE_COORDS 0.00 0.00 1999.00 1199.00\n" +
                         "202\t999.5\t599.5\t1\t3499.5\t599.5\t1\t...\n")));
    ASSERT_EQ(trace.samples.size(), 2U);
    for (const gaze::GazeSample& sample : trace.samples) {
        expect_near(sample.eyes[0].direction, {0.0, 0.0, -1.0});
        EXPECT_NEAR(right_deg(sample.eyes[1].direction), 45.0, 1e-9);
    }
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                ElementsAre("9: the screen has 2000 x 1200 pixels from here on, not 1000 x 600"));
}

}  // namespace
}  // namespace gazeloop::drivers
