#include "drivers/trace/native_trace.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/comma_locale.h"
#include "tests/support/gzip.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/drivers/trace/trace_findings.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

gaze::GazeTrace read_rows(const std::string& rows) {
    return value_or_throw(read_text(fmt::format("{}\n{}", kNativeHeader, rows)));
}

std::string refusal(const std::string& rows) {
    const Expected<gaze::GazeTrace> trace = read_text(fmt::format("{}\n{}", kNativeHeader, rows));
    return trace ? "accepted" : trace.error().message;
}

std::string written(const gaze::GazeTrace& trace) {
    std::ostringstream out;
    write_native_trace(trace, out);
    return out.str();
}

/// Numbers that need all their digits, both eyes in every state, with and without head and arrival.
gaze::GazeTrace awkward_trace() {
    gaze::GazeTrace trace;
    for (std::uint64_t i = 0; i < 6; ++i) {
        const double x = 0.1 * static_cast<double>(i) + 1.0 / 3.0;
        gaze::GazeSample sample;
        sample.sequence = 18'446'744'073'709'551'000U + 2 * i;
        sample.device_ns =
            -5'000'000'000'000'000'001 + static_cast<std::int64_t>(i * i) * 8'333'333;
        sample.sampled = {static_cast<std::int64_t>(i * i) * 8'333'333, time::StampKind::Modelled};
        if (i % 2 == 0) {
            sample.arrived = {sample.sampled.ns + static_cast<std::int64_t>(i) * 12'345,
                              time::StampKind::Modelled};
        }
        if (i % 3 != 0) {
            sample.head =
                gaze::Pose{glm::normalize(glm::dquat{x, -0.2, 0.3, x * x}), {x, -1e-300, 1e22 * x}};
        }
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.origin_m = {-x / 7.0, 5e-324, -0.0};
            ray.direction = glm::normalize(glm::dvec3{x, -x * x, -1.0});
            ray.openness = i == 1 ? -1.0 : x / 10.0;
            ray.confidence = i == 2 ? -1.0 : std::nextafter(1.0, 0.0);
            ray.valid = i != 4;
        }
        sample.eyes[i % 2].valid = false;
        trace.samples.push_back(sample);
    }
    return trace;
}

void expect_same_bits(double a, double b) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << ' ' << b;
}

void expect_same_bits(const glm::dvec3& a, const glm::dvec3& b) {
    expect_same_bits(a.x, b.x);
    expect_same_bits(a.y, b.y);
    expect_same_bits(a.z, b.z);
}

TEST(NativeTrace, ComesBackBitForBit) {
    const gaze::GazeTrace trace = awkward_trace();
    const std::string text = written(trace);
    const Expected<gaze::GazeTrace> read = read_text(text);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    ASSERT_EQ(read->samples.size(), trace.samples.size());
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        const gaze::GazeSample& a = trace.samples[i];
        const gaze::GazeSample& b = read->samples[i];
        EXPECT_EQ(a.sequence, b.sequence);
        EXPECT_EQ(a.device_ns, b.device_ns);
        EXPECT_EQ(a.sampled, b.sampled);
        EXPECT_EQ(a.arrived, b.arrived);
        for (const std::size_t eye : {0U, 1U}) {
            EXPECT_EQ(a.eyes[eye].valid, b.eyes[eye].valid);
            expect_same_bits(a.eyes[eye].direction, b.eyes[eye].direction);
            expect_same_bits(a.eyes[eye].origin_m, b.eyes[eye].origin_m);
            expect_same_bits(a.eyes[eye].openness, b.eyes[eye].openness);
            expect_same_bits(a.eyes[eye].confidence, b.eyes[eye].confidence);
        }
        ASSERT_EQ(a.head.has_value(), b.head.has_value()) << i;
        if (a.head) {
            expect_same_bits(a.head->position_m, b.head->position_m);
            expect_same_bits(a.head->orientation.w, b.head->orientation.w);
            expect_same_bits(a.head->orientation.x, b.head->orientation.x);
            expect_same_bits(a.head->orientation.y, b.head->orientation.y);
            expect_same_bits(a.head->orientation.z, b.head->orientation.z);
        }
    }
    EXPECT_EQ(written(*read), text);
    EXPECT_EQ(read->report.lost_by_tracker, 5U);
}

TEST(NativeTrace, WritesTheColumnsThatItReads) {
    EXPECT_EQ(written(gaze::GazeTrace{}), std::string{kNativeHeader} + "\n");
}

TEST(NativeTrace, DoesNotLetTheLocaleIn) {
    const char* const old = std::setlocale(LC_ALL, nullptr);
    const std::string before = old != nullptr ? old : "C";
    const tests::TemporaryFolder folder;
    const auto locale = tests::make_comma_locale(folder.path());
    if (!locale) {
        GTEST_SKIP() << "no locale with a decimal comma can be made (localedef)";
    }
    setenv("LOCPATH", locale->folder.c_str(), 1);
    ASSERT_NE(std::setlocale(LC_ALL, locale->name.c_str()), nullptr);
    ASSERT_STREQ(std::localeconv()->decimal_point, ",");
    const std::string text = written(awkward_trace());
    const bool read = read_text(text).has_value();
    std::setlocale(LC_ALL, before.c_str());
    EXPECT_TRUE(read);
    EXPECT_EQ(text, written(awkward_trace()));
}

TEST(NativeTrace, LeavesWhatIsNotFiniteBlankAndReadsItAsUnknown) {
    gaze::GazeTrace trace = awkward_trace();
    gaze::EyeRay& invalid = trace.samples[0].eyes[0];
    ASSERT_FALSE(invalid.valid);
    invalid.direction = {kNan, kNan, kNan};
    invalid.openness = kNan;
    const Expected<gaze::GazeTrace> read = read_text(written(trace));
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->samples[0].eyes[0].direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(read->samples[0].eyes[0].openness, -1.0);
}

/// 0,0,0 would be a place, 31 mm off.
TEST(NativeTrace, LeavesAnUnknownPlaceBlank) {
    gaze::GazeTrace trace = awkward_trace();
    for (gaze::EyeRay& ray : trace.samples[3].eyes) {
        ray.origin_m = glm::dvec3{0.0};
    }
    const gaze::GazeTrace read = value_or_throw(read_text(written(trace)));
    EXPECT_EQ(read.samples[3].eyes[0].origin_m, glm::dvec3{0.0});
    EXPECT_THAT(told(read, gaze::TraceFindingKind::BadCells),
                ::testing::Contains(HasSubstr("5: left eye's place: column 'left_origin_x_m': '' "
                                              "is no number, though other rows have one (1 row")));
}

TEST(NativeTrace, RefusesAValidEyeWithoutADirection) {
    EXPECT_EQ(refusal("0,1,,1,,0,-1,,,,,,0,,,,,,,,,,,,,,,\n"),
              "gaze.csv: no valid gaze in 1 row; from line 2: left eye: column 'left_x': '' is no "
              "number (1 row with such cells: the eye is invalid there): mend these cells, or "
              "set the tracker up for these eyes and record again");
    EXPECT_THAT(refusal("0,1,,2,0,0,-1,,,,,,0,,,,,,,,,,,,,,,\n"),
                HasSubstr("column 'left_valid': '2' does not say whether the eye is valid"));
}

TEST(NativeTrace, TakesBlanksForUnknown) {
    const gaze::GazeSample sample =
        read_rows("0,1,,1,0,0,-1,,,,,,0,,,,,,,,,,,,,,,\n").samples.front();
    EXPECT_TRUE(sample.eyes[0].valid);
    EXPECT_EQ(sample.eyes[0].openness, -1.0);
    EXPECT_EQ(sample.eyes[0].confidence, -1.0);
    EXPECT_EQ(sample.eyes[0].origin_m, glm::dvec3(0.0));
    EXPECT_FALSE(sample.eyes[1].valid);
    EXPECT_FALSE(sample.head.has_value());
    EXPECT_FALSE(sample.arrived.known());
}

TEST(NativeTrace, MakesUnitVectorsOfOtherLengths) {
    const gaze::GazeSample sample =
        read_rows("0,1,,1,0,3,-4,,,,,,1,0,0,0,,,,,,1,2,3,0,0,0,2\n").samples.front();
    EXPECT_NEAR(sample.eyes[0].direction.y, 0.6, 1e-15);
    EXPECT_NEAR(sample.eyes[0].direction.z, -0.8, 1e-15);
    EXPECT_FALSE(sample.eyes[1].valid) << "all zero";
    EXPECT_DOUBLE_EQ(sample.head->orientation.w, 1.0);
    EXPECT_DOUBLE_EQ(sample.head->position_m.y, 2.0);
}

TEST(NativeTrace, CountsGapsInTheSequence) {
    const gaze::GazeTrace trace =
        read_rows(native_row(10, 100) + native_row(11, 200) + native_row(15, 300) +
                  native_row(3, 400) + native_row(5, 500));
    EXPECT_EQ(trace.report.lost_by_tracker, 4U);
    EXPECT_EQ(trace.samples.size(), 5U);
}

TEST(NativeTrace, KeepsHowMuchLongerSomeReportsTook) {
    // Device and host clocks share nothing but their rate. Taken to arrived: 5000 + 0, 3, 1, -2.
    const gaze::GazeTrace trace =
        read_rows(native_row(0, 100, "5100") + native_row(1, 110, "5113") +
                  native_row(2, 120, "5121") + native_row(3, 130, "5128"));
    std::vector<std::int64_t> taken;
    for (const gaze::GazeSample& sample : trace.samples) {
        EXPECT_EQ(sample.arrived.kind, time::StampKind::Modelled);
        taken.push_back(sample.arrived.ns - sample.sampled.ns);
    }
    EXPECT_EQ(taken, (std::vector<std::int64_t>{2, 5, 3, 0}));
}

TEST(NativeTrace, WritesASidecarThatItAccepts) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                         fmt::format("gazeloop-native-trace-{}", ::getpid());
    std::filesystem::create_directories(folder);
    const std::string file = (folder / "out.csv").string();
    gaze::GazeTrace trace = awkward_trace();
    trace.device = "Tracker \"of\" ours";
    const Expected<void> done = write_native_trace(trace, file);
    ASSERT_TRUE(done.has_value()) << done.error().message;
    const Expected<gaze::GazeTrace> read = read_trace(file);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->device, trace.device);
    EXPECT_EQ(read->samples.size(), trace.samples.size());

    std::ifstream in(file + ".json");
    const nlohmann::json sidecar = nlohmann::json::parse(in);
    EXPECT_EQ(sidecar["format"], "gazeloop-gaze");
    EXPECT_EQ(sidecar["version"], 1);
    // Intervals of 1, 3, 5, 7 and 9 times 8.333333 ms: the median is the third.
    EXPECT_NEAR(sidecar["rate_hz"].get<double>(), 24.0, 0.01);
    std::filesystem::remove_all(folder);
}

TEST(NativeTrace, KnowsTheSidecarOfACompressedTrace) {
    const tests::TemporaryFolder folder;
    gaze::GazeTrace trace = awkward_trace();
    trace.device = "ours";
    const std::string file = (folder / "out.csv").string();
    ASSERT_TRUE(write_native_trace(trace, file).has_value());
    std::ofstream(file + ".gz", std::ios::binary) << tests::gzipped(written(trace));
    const Expected<gaze::GazeTrace> read = read_trace(file + ".gz");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->device, "ours");
    EXPECT_EQ(written(*read), written(trace));
}

TEST(NativeTrace, SaysWhereItCannotWrite) {
    const Expected<void> done = write_native_trace(awkward_trace(), "/nonexistent/folder/out.csv");
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(done.error().message,
              "/nonexistent/folder/out.csv: cannot be written (No such file or directory)");
}

}  // namespace
}  // namespace gazeloop::drivers
