#include "drivers/trace/formats/screen_pixels.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "drivers/trace/screen_geometry.h"
#include "tests/support/recorded_data.h"
#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_findings.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kSidecar =
    R"({"screen_size_m": [0.4, 0.3], "screen_px": [1000, 600], "view_distance_m": 0.5,
        "missing": "x and y are 0,0"})";

ScreenGeometry screen() {
    return {.size_m = {0.4, 0.3}, .size_px = {1000.0, 600.0}, .middle_m = {0.0, 0.0, -0.5}};
}

TEST(ScreenGeometry, TurnsPixelsIntoDirections) {
    expect_near(screen().direction({500.0, 300.0}), {0.0, 0.0, -0.5});
    expect_near(screen().direction({0.0, 0.0}), {-0.2, 0.15, -0.5});
    expect_near(screen().direction({1000.0, 600.0}), {0.2, -0.15, -0.5});
    expect_near(screen().direction({501.0, 300.0}), {0.0004, 0.0, -0.5});
    expect_near(screen().direction({-1000.0, 300.0}), {-0.6, 0.0, -0.5});
    EXPECT_NEAR(right_deg(screen().direction({1750.0, 300.0})), 45.0, 1e-9);
    ScreenGeometry other = screen();
    other.from_left = false;
    other.from_top = false;
    expect_near(other.direction({0.0, 0.0}), {0.2, -0.15, -0.5});
    EXPECT_TRUE(std::isnan(screen().direction({std::numeric_limits<double>::quiet_NaN(), 0.0}).x));
}

TEST(ScreenGeometry, RefusesWhatIsNoScreen) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(screen().check());
    for (const double bad : {0.0, -1.0, nan, inf, 1e9}) {
        for (const int axis : {0, 1}) {
            ScreenGeometry size = screen();
            size.size_m[axis] = bad;
            EXPECT_FALSE(size.check()) << bad;
            ScreenGeometry pixels = screen();
            pixels.size_px[axis] = bad;
            EXPECT_FALSE(pixels.check()) << bad;
        }
        ScreenGeometry distance = screen();
        distance.middle_m.z = -bad;
        EXPECT_FALSE(distance.check()) << bad;
    }
    ScreenGeometry large = screen();
    large.size_px = {16384.0, 16384.0};
    EXPECT_TRUE(large.check());
    large.size_m = {520.0, 290.0};
    EXPECT_THAT(large.check().error(), HasSubstr("write it in metres"));
}

TEST(ScreenPixels, NeedsTheSidecarsGeometry) {
    RecordingFolder folder;
    const std::string rows = "t_ms,x_px,y_px\n0.0,500,300\n2.0,1750,300\n4.0,0,0\n6.0,500,0\n";
    const std::string file = folder.write("a.csv", rows);
    EXPECT_THAT(refusal(file), HasSubstr("a.csv: no geometry of the screen; pixels have no "
                                         "direction without screen_size_m"));
    folder.write("a.json", R"({"screen_px": [1000, 600]})");
    EXPECT_THAT(refusal(file), HasSubstr("a.json lacks screen_size_m (two numbers) and "
                                         "view_distance_m (a number); pixels have"));
    folder.write("a.json", R"({"screen_size_m": [400, 300], "screen_px": [1000, 600],
                               "view_distance_m": 500})");
    EXPECT_THAT(refusal(file), HasSubstr("a.json: a size of 400 x 300 m is no screen's"));
    folder.write("a.json", "[]");
    EXPECT_THAT(refusal(file), HasSubstr("a.json: not a JSON object"));

    folder.write("a.json", std::string{kSidecar});
    const gaze::GazeTrace trace = value_or_throw(read_trace(file));
    EXPECT_EQ(trace.format, "screen-px");
    ASSERT_EQ(trace.samples.size(), 4U);
    EXPECT_EQ(trace.samples[1].sampled.ns, 2'000'000);
    expect_near(trace.samples[0].eyes[0].direction, {0.0, 0.0, -1.0});
    EXPECT_NEAR(right_deg(trace.samples[1].eyes[1].direction), 45.0, 1e-9);
    EXPECT_NEAR(up_deg(trace.samples[3].eyes[1].direction), glm::degrees(std::atan2(0.15, 0.5)),
                1e-9);
    EXPECT_FALSE(trace.samples[2].eyes[0].valid);
    EXPECT_THAT(told(trace, gaze::TraceFindingKind::RefusedByBit),
                ElementsAre("4: gaze not vouched for in 1 row: x and y are 0,0"));
    EXPECT_TRUE(trace.samples[0].parallax_rad);
}

TEST(ScreenPixels, GuessesNothingInSilence) {
    RecordingFolder folder;
    std::string shares = "t_ms,x_px,y_px\n";
    std::string pixels = shares;
    for (int i = 0; i < 60; ++i) {
        const double x = 0.3 + 0.007 * i;
        shares += fmt::format("{},{:.4f},{:.4f}\n", 2 * i, x, 1.2 - x);
        pixels += fmt::format("{},{:.1f},{:.1f}\n", 2 * i, 1000 * x, i < 50 ? 200.5 : 0.0);
    }
    const std::string file = folder.write("a.csv", shares);
    folder.write("a.json", std::string{kSidecar});
    EXPECT_THAT(refusal(file), HasSubstr("a.csv:1: x_px and y_px go from 0 to 1, as shares of the "
                                         "screen do: multiply them by its 1000 x 600 pixels"));
    folder.write("a.csv", pixels);
    EXPECT_EQ(refusal(file), "");
    folder.write("a.json", R"({"screen_size_m": [0.4, 0.3], "screen_px": [1000, 600],
                               "view_distance_m": 0.5, "missing": "zero"})");
    EXPECT_THAT(refusal(file), HasSubstr("a.json: 'missing' says how losses are written, and only "
                                         "\"x and y are 0,0\" is known"));
}

TEST(ScreenPixels, TakesMarksOfLossesForNoGaze) {
    for (const std::string_view mark :
         {"0,0", "-1,-1", "-32768,-32768", "1e8,300", "500,1e9", "-32768,300", "300,-9999"}) {
        RecordingFolder folder;
        std::string rows = "t_ms,x_px,y_px\n";
        for (int i = 0; i < 200; ++i) {
            rows += i % 10 == 3 ? fmt::format("{},{}\n", 2 * i, mark)
                                : fmt::format("{},{},{}\n", 2 * i, 300 + i, 200 + i);
        }
        const std::string file = folder.write("a.csv", rows);
        folder.write("a.json", R"({"screen_size_m": [0.4, 0.3], "screen_px": [1000, 600],
                                   "view_distance_m": 0.5})");
        const gaze::GazeTrace trace = value_or_throw(read_trace(file));
        EXPECT_EQ(trace.report.valid[0], 180U) << mark;
        EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::BadCells).rows, 40U) << "both eyes";
        EXPECT_THAT(told(trace, gaze::TraceFindingKind::BadCells)[0],
                    HasSubstr("as trackers mark losses (20 rows"));
        EXPECT_TRUE(trace.report.worth_a_warning());
    }
}

TEST(ScreenPixels, IsRefusedFromAStream) {
    std::istringstream in("t_ms,x_px,y_px\n0,1,2\n");
    const auto trace = read_trace(in, "stdin");
    ASSERT_FALSE(trace);
    EXPECT_THAT(trace.error().message, HasSubstr("no geometry of the screen"));
}

TEST(AnderssonRecordings, AreAllRead) {
    const std::string name = "traces/andersson2017";
    if (const std::string missing = tests::no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const auto folder = tests::recorded_data(name);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".csv") {
            continue;
        }
        const gaze::GazeTrace trace = value_or_throw(read_trace(entry.path().string()));
        EXPECT_NEAR(trace.report.rate_hz, 500.0, 1.0) << entry.path();
        EXPECT_EQ(trace.report.rows_dropped(), 0U) << entry.path();
        for (const gaze::GazeSample& sample : trace.samples) {
            if (sample.eyes[0].valid) {
                EXPECT_LT(sample.eyes[0].direction.z, 0.0);
            }
        }
        ++files;
    }
    EXPECT_GE(files, 20U);
}

}  // namespace
}  // namespace gazeloop::drivers
