// Pico Neo 3, GazeBaseVR, Pupil Core and Aria.
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

// ---- Pico
// ----------------------------------------------------------------------------------------

constexpr std::string_view kPicoHeader =
    "User Name\tTimeline\tHead Position. x\tHead Position. y\tHead Position. z\tHead Rotation. x\t"
    "Head Rotation. y\tHead Rotation. z\tLeft Eye Gaze Openness\tRight Eye Gaze Openness\t"
    "Combine Eye Gaze Vector. x\tCombine Eye Gaze Vector. y\tCombine Eye Gaze Vector. z\t"
    "Foveated Gaze Tracking State\n";

TEST(PicoNeo3, ReadsTheCombinedGazeAndTheHead) {
    RecordingFolder folder;
    const std::string file = folder.write(
        "boxing.csv", std::string{kPicoHeader} +
                          "u\t1.100002\t1\t2\t3\t0\t30\t0\t0.9\t0.7\t0.6\t0\t0.8\t0\n" +
                          "u\t1.111113\t1\t2\t3\t-20\t0\t0\t1\t1\t0\t0.6\t0.8\t0\n" +
                          "u\t1.122224\t1\t2\t3\t0\t0\t0\t0\t0\t0\t0\t0\t2\n");
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_EQ(trace.format, "pico-neo-3");
    ASSERT_EQ(trace.samples.size(), 3U);
    EXPECT_EQ(trace.samples[0].device_ns, 1'100'002'000);
    EXPECT_EQ(trace.samples[1].sampled.ns, 11'111'000);
    // +X right, +Z forward there: .6 of the way is to the right; and up.
    expect_near(trace.samples[0].eyes[0].direction, {0.6, 0.0, -0.8});
    expect_near(trace.samples[1].eyes[1].direction, {0.0, 0.6, -0.8});
    EXPECT_DOUBLE_EQ(trace.samples[0].eyes[0].openness, 0.9);
    EXPECT_DOUBLE_EQ(trace.samples[0].eyes[1].openness, 0.7);
    EXPECT_TRUE(trace.samples[0].parallax_rad);
    EXPECT_FALSE(trace.samples[2].eyes[0].valid);
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    expect_near(trace.samples[0].head->position_m, {1.0, 2.0, -3.0});
    EXPECT_NEAR(right_deg(trace.samples[0].head->orientation * ahead), 30.0, 1e-9);
    EXPECT_NEAR(up_deg(trace.samples[1].head->orientation * ahead), 20.0, 1e-9);
}

TEST(PicoNeo3, ReadsDecimalCommasBesideSemicolons) {
    RecordingFolder folder;
    std::string text = std::string{kPicoHeader} +
                       "u\t1,5\t0\t0\t0\t0\t0\t0\t1\t1\t0,6\t0\t0,8\t0\n" +
                       "u\t1,6\t0\t0\t0\t0\t0\t0\t1\t1\t0,6\t0\t0,8\t0\n";
    std::ranges::replace(text, '\t', ';');
    const gaze::GazeTrace trace = value_or_throw(read_trace(folder.write("p.csv", text)));
    EXPECT_EQ(trace.samples[0].device_ns, 1'500'000'000);
    expect_near(trace.samples[0].eyes[0].direction, {0.6, 0.0, -0.8});
}

TEST(PicoNeo3Recording, IsRead) {
    const std::string name = "traces/pico_neo_3/boxing_VR.csv";
    if (const std::string missing = tests::no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const auto file = tests::recorded_data(name);
    const gaze::GazeTrace trace = value_or_throw(read_trace(file.string()));
    EXPECT_EQ(trace.report.rows, 492U);
    EXPECT_EQ(trace.report.rows_dropped(), 0U);
    EXPECT_EQ(trace.report.valid[0], 486U) << "6 rows have the state 2";
    EXPECT_NEAR(trace.report.rate_hz, 90.0, 2.0);
    for (const gaze::GazeSample& sample : trace.samples) {
        EXPECT_TRUE(sample.head);
    }
}

// ---- GazeBaseVR
// ----------------------------------------------------------------------------------

TEST(GazeBaseVr, ReadsEachEyesAngles) {
    RecordingFolder folder;
    std::string text = "n,x,y,lx,ly,rx,ry,xT,yT,zT,clx,cly,clz,crx,cry,crz\n";
    for (int i = 0; i < 30; ++i) {
        text += fmt::format("{},0,0,{},20,28,20,0,0,1,-0.031,0.001,0.002,0.032,0.001,0.002\n",
                            4 * i, i == 5 ? "nan" : "30");
    }
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(folder.write("S_1_VRG.csv.gz", tests::gzipped(text))));
    EXPECT_EQ(trace.format, "gazebase-vr");
    EXPECT_EQ(trace.samples[1].sampled.ns, 4'000'000);
    EXPECT_NEAR(trace.report.rate_hz, 250.0, 1e-6);
    // h = atan2(x, hypot(y, z)) = 30, v = atan2(y, z) = 20.
    const double c = std::cos(glm::radians(30.0));
    expect_near(trace.samples[0].eyes[0].direction,
                {0.5, c * std::sin(glm::radians(20.0)), -c * std::cos(glm::radians(20.0))});
    expect_near(trace.samples[0].eyes[1].origin_m, {0.032, 0.001, -0.002});
    EXPECT_FALSE(trace.samples[5].eyes[0].valid);
    EXPECT_TRUE(trace.samples[5].eyes[1].valid);
    expect_anatomy(trace);
}

// ---- Pupil Core
// ----------------------------------------------------------------------------------

constexpr std::string_view kCoreHeader =
    "gaze_timestamp,world_index,confidence,norm_pos_x,norm_pos_y,base_data,gaze_point_3d_x,"
    "gaze_point_3d_y,gaze_point_3d_z,eye_center0_3d_x,eye_center0_3d_y,eye_center0_3d_z,"
    "gaze_normal0_x,gaze_normal0_y,gaze_normal0_z,eye_center1_3d_x,eye_center1_3d_y,"
    "eye_center1_3d_z,gaze_normal1_x,gaze_normal1_y,gaze_normal1_z\n";

std::string core_row(double time_s, std::string_view confidence, std::string_view right,
                     std::string_view left) {
    return fmt::format("{:.6f},1,{},.5,.5,1-0,0,0,500,31,12,-20,{},-32,13,-21,{}\n", time_s,
                       confidence, right, left);
}

TEST(PupilCore, ReadsEyeZeroAsTheRightOne) {
    RecordingFolder folder;
    std::string text{kCoreHeader};
    for (int i = 0; i < 30; ++i) {
        text += core_row(81.5 + 0.008 * i, "0.95", "-0.04,0.1,1", "0.04,0.1,1");
    }
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(folder.write("gaze_positions.csv", text)));
    EXPECT_EQ(trace.format, "pupil-core");
    EXPECT_EQ(trace.samples[0].device_ns, 81'500'000'000);
    expect_near(trace.samples[0].eyes[0].origin_m, {-0.032, -0.013, 0.021});
    expect_near(trace.samples[0].eyes[1].origin_m, {0.031, -0.012, 0.02});
    EXPECT_NEAR(right_deg(trace.samples[0].eyes[0].direction), glm::degrees(std::atan(0.04)), 1e-9);
    // The camera's +Y is down.
    EXPECT_LT(up_deg(trace.samples[0].eyes[0].direction), -5.0);
    EXPECT_DOUBLE_EQ(trace.samples[0].eyes[0].confidence, 0.95);
    expect_anatomy(trace);
}

TEST(PupilCore, VouchesForConfidencesAboveSixTenths) {
    RecordingFolder folder;
    const std::string file = folder.write(
        "gaze_positions.csv", std::string{kCoreHeader} + core_row(1.00, "0.6", "0,0,1", "0,0,1") +
                                  core_row(1.01, "0.61", "0,0,1", ",,") +
                                  core_row(1.02, "", "0,0,1", "0,0,1"));
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    std::string valid;
    for (const gaze::GazeSample& sample : trace.samples) {
        valid += fmt::format("{:d}{:d} ", sample.eyes[0].valid, sample.eyes[1].valid);
    }
    EXPECT_EQ(valid, "00 01 11 ");
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::RefusedByBit),
                ElementsAre("2: gaze not vouched for in 1 row: confidence of .6 or less"));
    EXPECT_THAT(refusal(folder.write("two.csv",
                                     "gaze_timestamp,confidence,norm_pos_x,norm_pos_y\n1,1,0,0\n")),
                HasSubstr("norm_pos needs the camera's geometry"));
}

// ---- Aria
// ----------------------------------------------------------------------------------------

TEST(Aria, ReadsGeneration2BySinesAndMirrorsItsLeft) {
    RecordingFolder folder;
    std::string text =
        "tracking_timestamp_us,yaw_rads_cpf,pitch_rads_cpf,left_yaw_rads_cpf,right_yaw_rads_cpf,"
        "left_pitch_rads_cpf,right_pitch_rads_cpf,tx_left_eye_cpf,ty_left_eye_cpf,tz_left_eye_cpf,"
        "tx_right_eye_cpf,ty_right_eye_cpf,tz_right_eye_cpf\n";
    for (int i = 0; i < 30; ++i) {
        // The left eye .5 rad to the right, which is negative there, and .3 up.
        text += fmt::format("{},-0.48,0.3,-0.5,-0.46,0.3,0.3,0.0315,0,0,-0.0315,0,0\n",
                            7'000'000 + 11'111 * i);
    }
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(folder.write("general_eye_gaze.csv", text)));
    EXPECT_EQ(trace.device, "Aria Gen 2");
    EXPECT_EQ(trace.samples[1].sampled.ns, 11'111'000);
    expect_near(trace.samples[0].eyes[0].direction,
                {std::sin(0.5) * std::cos(0.3), std::sin(0.3), -std::cos(0.5) * std::cos(0.3)});
    expect_near(trace.samples[0].eyes[0].origin_m, {-0.0315, 0.0, 0.0});
    EXPECT_FALSE(trace.samples[0].parallax_rad);
    expect_anatomy(trace);
}

TEST(Aria, ReadsGeneration1ByTangents) {
    RecordingFolder folder;
    const gaze::GazeTrace each = value_or_throw(read_trace(folder.write(
        "vergence.csv",
        "tracking_timestamp_us,left_yaw_rads_cpf,right_yaw_rads_cpf,pitch_rads_cpf,depth_m\n"
        "1,-0.5,-0.4,0.3,1\n2,-0.5,-0.4,0.3,1\n")));
    const glm::dvec3 along{std::tan(0.5), std::tan(0.3), -1.0};
    expect_near(each.samples[0].eyes[0].direction, glm::normalize(along));
    EXPECT_NEAR(right_deg(each.samples[0].eyes[1].direction), glm::degrees(0.4), 1e-9);

    const gaze::GazeTrace both =
        value_or_throw(read_trace(folder.write("old.csv",
                                               "tracking_timestamp_us,yaw_rads_cpf,pitch_rads_cpf,"
                                               "depth_m\n1,-0.5,0.3,0.7\n2,-0.5,0.3,0\n")));
    expect_near(both.samples[0].eyes[1].direction, glm::normalize(along));
    const double u = 0.0315 / 0.7;
    EXPECT_NEAR(*both.samples[0].parallax_rad, u / (1.0 - u * u), 1e-12);
    EXPECT_NEAR(*both.samples[1].parallax_rad, 0.063 / (1.0 - 0.063 * 0.063), 1e-12);
}

}  // namespace
}  // namespace gazeloop::drivers
