#include "drivers/trace/formats/pupil_labs.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "drivers/trace/directions.h"
#include "drivers/trace/trace_source.h"
#include "tests/support/recorded_data.h"
#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_findings.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr long long kStart_ns = 1'629'390'345'036'471'431;
constexpr std::string_view kHeader =
    "section id,recording id,timestamp [ns],gaze x [px],gaze y [px],worn,fixation id,blink id,"
    "azimuth [deg],elevation [deg]\n";

std::string row(int number, std::string_view angles, std::string_view worn = "1",
                std::string_view blink = "") {
    return fmt::format("s,r,{},484.3,525.1,{},,{},{}\n", kStart_ns + number * 5'000'000LL, worn,
                       blink, angles);
}

TEST(PupilLabs, ReadsAzimuthToTheRightAndElevationUp) {
    RecordingFolder folder;
    const std::string file = folder.write(
        "gaze.csv", std::string{kHeader} + row(0, "30,0") + row(1, "0,20") + row(2, "-90,0"));
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_EQ(trace.format, "pupil-labs");
    ASSERT_EQ(trace.samples.size(), 3U);
    // sin 30 = 1/2 to the right; sin 20 up; all the way to the left.
    expect_near(trace.samples[0].eyes[0].direction, {0.5, 0.0, -std::sqrt(0.75)});
    EXPECT_NEAR(up_deg(trace.samples[1].eyes[1].direction), 20.0, 1e-9);
    expect_near(trace.samples[2].eyes[1].direction, {-1.0, 0.0, 0.0});
    EXPECT_EQ(trace.samples[2].device_ns, kStart_ns + 10'000'000) << "whole, not by a double";
    EXPECT_EQ(trace.samples[1].sampled.ns, 5'000'000);
    // Pupils 63 mm apart, content at .5 m or beyond: .063 / (1 - .063^2) rad.
    ASSERT_TRUE(trace.samples[0].parallax_rad);
    EXPECT_NEAR(*trace.samples[0].parallax_rad, 0.063 / (1.0 - 0.063 * 0.063), 1e-12);
}

TEST(PupilLabs, DoesNotVouchForBlinksAndGlassesThatAreOff) {
    RecordingFolder folder;
    const std::string file =
        folder.write("gaze.csv", std::string{kHeader} + row(0, "1,1") + row(1, "1,1", "1", "7") +
                                     row(2, "1,1", "0") + row(3, "1,1", "", "") + row(4, "abc,1") +
                                     row(5, ",") + row(6, "1,1"));
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    std::string valid;
    for (const gaze::GazeSample& sample : trace.samples) {
        EXPECT_EQ(sample.eyes[0].valid, sample.eyes[1].valid);
        valid += sample.eyes[0].valid ? '1' : '0';
    }
    EXPECT_EQ(valid, "1001001");
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::RefusedByBit),
                ElementsAre("3: gaze not vouched for in 1 row: a blink (blink id)",
                            "4: gaze not vouched for in 1 row: not worn"));
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("6: left eye: column 'azimuth [deg]': 'abc' is no number"),
                            HasSubstr("6: right eye")));
}

TEST(PupilLabs, ReadsBlinksBesideATableThatHasNoneOfThem) {
    RecordingFolder folder;
    std::string text = "timestamp [ns],azimuth [deg],elevation [deg]\n";
    for (int i = 0; i < 5; ++i) {
        text += fmt::format("{},1,2\n", kStart_ns + i * 5'000'000LL);
    }
    folder.write("blinks.csv",
                 fmt::format("blink id,start timestamp [ns],end timestamp [ns]\n1,{},{}\n",
                             kStart_ns + 4'000'000, kStart_ns + 11'000'000));
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("gaze.csv", text)));
    std::string valid;
    for (const gaze::GazeSample& sample : trace.samples) {
        valid += sample.eyes[0].valid ? '1' : '0';
    }
    EXPECT_EQ(valid, "10011");
}

/// The eyes' places of 3d_eye_states.csv, by name in any order: the scene camera has +Y down, +Z
/// forward.
TEST(PupilLabs, PutsTheEyesWhereEyeStatesHaveThem) {
    RecordingFolder folder;
    folder.write("3d_eye_states.csv",
                 fmt::format("eyeball center right x [mm],eyeball center right y [mm],"
                             "eyeball center right z [mm],timestamp [ns],"
                             "eyeball center left x [mm],eyeball center left y [mm],"
                             "eyeball center left z [mm],optical axis left x\n"
                             "32,12,-38,{},-31,13,-37,0\n",
                             kStart_ns + 1'000'000));
    const gaze::GazeTrace trace = value_or_throw(
        read_trace(folder.write("gaze.csv", std::string{kHeader} + row(0, "0,0") + row(9, "0,0"))));
    expect_near(trace.samples[0].eyes[0].origin_m, {-0.031, -0.013, 0.037});
    expect_near(trace.samples[0].eyes[1].origin_m, {0.032, -0.012, 0.038});
    expect_near(trace.samples[1].eyes[0].origin_m, {0.0, 0.0, 0.0});
    EXPECT_EQ(trace.device, "Pupil Labs Neon");
}

std::string imu_row(long long time_ns, std::string_view quaternion) {
    return fmt::format("s,r,{},0,0,0,{}\n", time_ns, quaternion);
}

constexpr std::string_view kImuHeader =
    "section id,recording id,timestamp [ns],roll [deg],pitch [deg],yaw [deg],"
    "quaternion w,quaternion x,quaternion y,quaternion z\n";

TEST(PupilLabs, TakesTheHeadFromTheImu) {
    RecordingFolder folder;
    // At rest facing north; then turned by 90 degrees about the world's up, to the west.
    folder.write("imu.csv",
                 std::string{kImuHeader} + imu_row(kStart_ns, "1,0,0,0") +
                     imu_row(kStart_ns + 10'000'000, "0.7071067811865476,0,0,0.7071067811865476"));
    const gaze::GazeTrace trace = value_or_throw(
        read_trace(folder.write("gaze.csv", std::string{kHeader} + row(0, "0,12") + row(1, "0,12") +
                                                row(2, "0,12") + row(30, "0,0"))));
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    const glm::dvec3 right{1.0, 0.0, 0.0};
    const auto head = [&](std::size_t sample) { return trace.samples[sample].head->orientation; };
    ASSERT_TRUE(trace.samples[0].head && trace.samples[1].head && trace.samples[2].head);
    // The camera looks 12 degrees below the IMU's horizon, north is ahead (-Z), east is right.
    EXPECT_NEAR(up_deg(head(0) * ahead), -12.0, 1e-9);
    expect_near(head(0) * right, {1.0, 0.0, 0.0});
    // A gaze 12 degrees up in the camera is level in the world.
    expect_near(head(0) * trace.samples[0].eyes[0].direction, ahead);
    // West is to the left.
    expect_near(head(2) * trace.samples[2].eyes[0].direction, {-1.0, 0.0, 0.0});
    expect_near(head(2) * right, ahead);
    // Half way in between.
    expect_near(head(1) * trace.samples[1].eyes[0].direction,
                {-std::sqrt(0.5), 0.0, -std::sqrt(0.5)});
    EXPECT_FALSE(trace.samples[3].head) << "140 ms behind the last reading";
}

TEST(PupilLabs, RefusesPixelsWithoutAngles) {
    RecordingFolder folder;
    const std::string file =
        folder.write("gaze.csv", "timestamp [ns],gaze x [px],gaze y [px],worn\n1,2,3,1\n");
    EXPECT_THAT(refusal(file),
                HasSubstr("lacks 'azimuth [deg]', 'elevation [deg]': gaze in pixels needs the "
                          "camera's geometry"));
    EXPECT_THAT(refusal(folder.write("imu.csv", std::string{kImuHeader} + imu_row(1, "1,0,0,0"))),
                HasSubstr("a table of an IMU: read gaze.csv beside it"));
    EXPECT_THAT(refusal(folder.write("r.csv", "timestamp [ns],azimuth [rad],elevation [rad]\n")),
                HasSubstr("r.csv:1: angles in radians: write them in degrees"));
}

TEST(PupilLabs, ReadsTheFirstOfSeveralRecordings) {
    RecordingFolder folder;
    std::string text = std::string{kHeader} + row(0, "1,1") + row(1, "1,1");
    text += "s,another,5,1,1,1,,,2,2\n";
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("gaze.csv", text)));
    EXPECT_EQ(trace.samples.size(), 2U);
    EXPECT_EQ(trace.report.rows, 3U);
    EXPECT_EQ(trace.report.rows_dropped(), 1U);
    EXPECT_TRUE(trace.report.worth_a_warning());
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::OtherRecording),
                ElementsAre("4: only 'r' is read, which the first row is of by 'recording id'; "
                            "left out: 'another' (1 rows); write the rows of each to a file of its "
                            "own to read it"));
}

TEST(PupilLabs, NotesFromHowManyEyesTheGazeIs) {
    RecordingFolder folder;
    folder.write("info.json", R"({"gaze_mode": "monocular", "wearer_name": "A"})");
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(folder.write("gaze.csv", std::string{kHeader} + row(0, "0,0"))));
    EXPECT_EQ(trace.device, "Pupil Labs Neon");
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                ElementsAre("0: info.json beside it: gaze_mode monocular"));
    const std::string deep = std::string(100, '[') + std::string(100, ']');
    folder.write("info.json", R"({"a": )" + deep + "}");
    EXPECT_THAT(refusal(folder / "gaze.csv"), HasSubstr("nested 32 deep at most"));
}

TEST(PupilLabs, NamesADamagedFileBesideIt) {
    RecordingFolder folder;
    folder.write("imu.csv", std::string{kImuHeader} + "1,2\n" + imu_row(2, "1,0,0,0"));
    EXPECT_THAT(refusal(folder.write("gaze.csv", std::string{kHeader} + row(0, "0,0"))),
                HasSubstr("imu.csv:2: 2 columns, the header has 10"));
}

/// A file that is there and says nothing of this recording is not "read".
TEST(PupilLabs, WarnsOfFilesThatDoNotCoverTheRecording) {
    RecordingFolder folder;
    std::string text = "timestamp [ns],azimuth [deg],elevation [deg]\n";
    std::string eyes =
        "timestamp [ns],eyeball center left x [mm],eyeball center left y [mm],"
        "eyeball center left z [mm],eyeball center right x [mm],eyeball center right y [mm],"
        "eyeball center right z [mm]\n";
    std::string imu{kImuHeader};
    std::string other_day{kImuHeader};
    for (int i = 0; i < 60; ++i) {
        const long long now_ns = kStart_ns + i * 5'000'000LL;
        text += fmt::format("{},{},2\n", now_ns, 1 + 0.1 * i);
        eyes += i < 20 ? fmt::format("{},-31,10,-40,31,10,-40\n", now_ns) : "";
        imu += imu_row(now_ns, "1,0,0,0");
        other_day += imu_row(now_ns - 86'400'000'000'000LL, "1,0,0,0");
    }
    const std::string file = folder.write("gaze.csv", text);
    folder.write("imu.csv", imu);
    gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_FALSE(trace.report.worth_a_warning());
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::Text),
                ElementsAre("0: imu.csv beside it: the head's pose for 60 of 60 rows"));
    folder.write("imu.csv", other_day);
    folder.write("3d_eye_states.csv", eyes);
    folder.write("blinks.csv", "start timestamp [ns],end timestamp [ns]\n5,9\n");
    trace = value_or_throw(read_trace(file));
    EXPECT_TRUE(trace.report.worth_a_warning());
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::NotRead),
                ElementsAre(HasSubstr("3d_eye_states.csv beside it: the eyes' places for 21 of 60 "
                                      "rows; it does not cover the recording"),
                            HasSubstr("imu.csv beside it: the head's pose for 0 of 60 rows"),
                            HasSubstr("blinks.csv beside it: 1 blink with 0 of 60 rows")));
    folder.write("imu.csv", "timestamp [ns],gyro x [deg/s]\n1,2\n");
    EXPECT_THAT(told(value_or_throw(read_trace(file)), gaze::TraceFindingKind::NotRead),
                testing::Contains("0: imu.csv: not read, for want of the column 'quaternion w'"));
}

/// Nobody recorded when a sample arrived: the tracker profile's delay after it, modelled.
TEST(PupilLabs, ArrivesByTheTrackersDelay) {
    RecordingFolder folder;
    gaze::GazeTrace trace = value_or_throw(
        read_trace(folder.write("gaze.csv", std::string{kHeader} + row(0, "0,0") + row(1, "0,0"))));
    EXPECT_FALSE(trace.samples[1].arrived.known());
    TraceSource source(std::move(trace), 1'000'000'000, 20'000'000);
    std::vector<gaze::GazeSample> samples;
    source.poll(1'100'000'000, samples);
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[1].arrived, (time::Stamp{1'025'000'000, time::StampKind::Modelled}));
    EXPECT_EQ(samples[1].sampled, (time::Stamp{1'005'000'000, time::StampKind::Modelled}));
}

TEST(PupilLabsRecording, IsRead) {
    const std::string name = "traces/pupil_invisible/trampoline_02/gaze.csv";
    if (const std::string missing = tests::no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const auto file = tests::recorded_data(name);
    const gaze::GazeTrace trace = value_or_throw(read_trace(file.string()));
    EXPECT_EQ(trace.report.rows, 5338U);
    EXPECT_EQ(trace.report.rows_dropped(), 0U);
    EXPECT_EQ(trace.report.valid[0], 5338U - 2103U) << "2103 rows have a blink";
    EXPECT_NEAR(trace.report.rate_hz, 199.5, 0.5) << "steps of 4 and 8 ms";
    expect_near(
        trace.samples[0].eyes[0].direction,
        of_azimuth_elevation(glm::radians(-6.124952556831593), glm::radians(1.4396192997836719)));
}

}  // namespace
}  // namespace gazeloop::drivers
