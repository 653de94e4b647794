#include "drivers/trace/read_trace.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/trace/text/csv_table.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

using ::testing::HasSubstr;

/// The header, one good row, and whatever else.
std::string htc(const std::string& more) {
    return fmt::format("{}\r\n{}{}", kHtcHeader, htc_row(1000), more);
}

std::string native(const std::string& more) {
    return fmt::format("{}\n{}{}", kNativeHeader, native_row(0, 1000), more);
}

void expect_refused(const Expected<gaze::GazeTrace>& trace, const std::string& message) {
    ASSERT_FALSE(trace.has_value());
    EXPECT_EQ(trace.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(trace.error().message, HasSubstr(message));
}

/// A folder of its own, gone afterwards.
class ReadTraceFile : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) {
        const std::string file = (folder_ / name).string();
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

    std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                    fmt::format("gazeloop-read-trace-{}", ::getpid());
};

TEST(ReadTrace, KnowsTheFormatsByTheirHeaders) {
    const Expected<gaze::GazeTrace> from_htc = read_text(htc(""));
    ASSERT_TRUE(from_htc.has_value()) << from_htc.error().message;
    EXPECT_EQ(from_htc->format, "htc-vive-pro");
    EXPECT_EQ(from_htc->device, "HTC Vive Pro");
    EXPECT_EQ(from_htc->file, "gaze.csv");
    const Expected<gaze::GazeTrace> from_native = read_text(native(""));
    ASSERT_TRUE(from_native.has_value()) << from_native.error().message;
    EXPECT_EQ(from_native->format, "gazeloop");
}

TEST(ReadTrace, FindsColumnsByNameInAnyOrderAndAmongOthers) {
    const Expected<gaze::GazeTrace> trace = read_text(
        "frown_L;gaze_direct_L.z;gaze_direct_L.y;gaze_direct_L.x;gaze_direct_R.x;gaze_direct_R.y;"
        "gaze_direct_R.z;eye_valid_R;eye_valid_L;openness_R;openness_L;gaze_origin_L.x(mm);"
        "gaze_origin_L.y(mm);gaze_origin_L.z(mm);gaze_origin_R.x(mm);gaze_origin_R.y(mm);"
        "gaze_origin_R.z(mm);time(100ns);comment\n"
        "0;1;2;3;-3;2;1;0;31;.5;.25;1;2;3;4;5;6;77;not a number\n");
    ASSERT_TRUE(trace.has_value()) << trace.error().message;
    const gaze::GazeSample& sample = trace->samples.at(0);
    EXPECT_NEAR(sample.eyes[0].direction.x / sample.eyes[0].direction.z, 3.0, 1e-12);
    EXPECT_DOUBLE_EQ(sample.eyes[0].openness, 0.25);
    EXPECT_TRUE(sample.eyes[0].valid);
    EXPECT_FALSE(sample.eyes[1].valid);
    EXPECT_FALSE(sample.head.has_value());
}

TEST(ReadTrace, RefusesAFormatThatDoesNotExist) {
    const Expected<gaze::GazeTrace> trace = read_text(htc(""), "csv");
    ASSERT_FALSE(trace.has_value());
    EXPECT_EQ(trace.error().kind, ErrorKind::Usage);
    EXPECT_EQ(trace.error().message, "unknown trace format 'csv'; known: auto, " + known_formats());
}

TEST(ReadTrace, RefusesAnotherFormatThanTheOneAskedFor) {
    EXPECT_TRUE(read_text(htc(""), "htc-vive-pro").has_value());
    expect_refused(
        read_text(htc(""), "gazeloop"),
        "gaze.csv:1: unknown header; known formats: " + known_formats() +
            "; for "
            "gazeloop it lacks 't_device_ns', 'left_valid', 'left_x', 'left_y', 'left_z'");
}

TEST(ReadTrace, NamesTheColumnsThatTheNearestFormatLacks) {
    std::string text = htc("");
    text.replace(text.find("eye_valid_L"), 11, "eye_valiX_L");
    text.replace(text.find("gaze_direct_R.y"), 15, "gaze_direct_R_y");
    text.replace(text.find("gaze_direct_R.z"), 15, "gaze_direct_R_z");
    text.replace(text.find("time(100ns)"), 11, "time(200ns)");
    text.replace(text.find("time_stamp(ms)"), 14, "time_stamp( s)");
    expect_refused(read_text(text),
                   "gaze.csv:1: unknown header; known formats: " + known_formats() +
                       "; for "
                       "htc-vive-pro it lacks 'time(100ns)', 'eye_valid_L'");
}

TEST(ReadTrace, NamesNoNearestFormatWhereNothingFits) {
    const Expected<gaze::GazeTrace> trace = read_text("a,b,c\n1,2,3\n");
    ASSERT_FALSE(trace.has_value());
    EXPECT_EQ(trace.error().message,
              "gaze.csv:1: unknown header; known formats: " + known_formats());
}

TEST(ReadTrace, RefusesAnEmptyFile) {
    expect_refused(read_text(""), "gaze.csv:1: empty file");
    expect_refused(read_text("\xEF\xBB\xBF"), "gaze.csv:1: empty file");
    expect_refused(read_text("\xEF\xBB\xBF\n"), "gaze.csv:2: no header: a table begins with");
}

TEST(ReadTrace, RefusesAFileWithoutRows) {
    expect_refused(read_text(std::string{kHtcHeader}), "gaze.csv: no rows after the header");
    expect_refused(read_text(fmt::format("{}\r\n\r\n  \r\n", kHtcHeader)),
                   "gaze.csv: no rows after the header");
}

TEST(ReadTrace, RefusesAFileWithoutAValidEye) {
    std::string text = htc(htc_row(2000));
    for (std::size_t at = 0; (at = text.find(";31;31;", at)) != std::string::npos;) {
        text.replace(at, 7, ";25;24;");
    }
    expect_refused(read_text(text), "gaze.csv: no valid gaze in 2 rows; from line 2: left eye");
}

TEST(ReadTrace, RefusesRowsOfTheWrongWidth) {
    expect_refused(read_text(htc("1;2;3\r\n")), "gaze.csv:3: 3 columns, the header has 24");
    expect_refused(read_text(htc(htc_row(2000, "0;0;1;0"))),
                   "gaze.csv:3: 25 columns, the header has 24");
    expect_refused(read_text(htc(htc_row(2000) + "6383427940\n")),
                   "gaze.csv:4: 1 columns, the header has 24: mend or remove the line");
}

TEST(ReadTrace, RefusesAColumnNamedTwice) {
    expect_refused(read_text("sequence,t_device_ns,sequence\n1,2,3\n"),
                   "gaze.csv:1: column 'sequence' occurs twice");
}

TEST(ReadTrace, RefusesLinesWithoutEnd) {
    const std::string longest(CsvTable::kLongestLine, ' ');
    EXPECT_TRUE(read_text(htc(longest + "\r\n")).has_value());
    EXPECT_TRUE(read_text(htc(longest)).has_value());
    expect_refused(read_text(htc(longest + " \n")), "gaze.csv:3: longer than 65536 bytes");
    expect_refused(read_text(htc(longest + "  ")), "gaze.csv:3: longer than 65536 bytes");
    expect_refused(read_text(std::string(1'000'000, 'x')), "gaze.csv:1: longer than 65536 bytes");
}

TEST(ReadTrace, RefusesABinaryFile) {
    expect_refused(read_text("\x7f"
                             "ELF\x02\x01"),
                   "gaze.csv:1: not a text file");
    expect_refused(read_text(htc(std::string("1;\0;3\n", 6))), "gaze.csv:3: not a text file");
}

TEST(ReadTrace, AcceptsAMissingLastLineEnd) {
    std::string text = htc(htc_row(2000));
    text.resize(text.size() - 2);
    const Expected<gaze::GazeTrace> trace = read_text(text);
    ASSERT_TRUE(trace.has_value()) << trace.error().message;
    EXPECT_EQ(trace->samples.size(), 2U);
}

TEST(ReadTrace, IgnoresAByteOrderMark) {
    EXPECT_TRUE(read_text("\xEF\xBB\xBF" + htc("")).has_value());
}

TEST_F(ReadTraceFile, ReadsAFile) {
    const std::string file = write("gaze.csv", htc(htc_row(2000)));
    const Expected<gaze::GazeTrace> trace = read_trace(file);
    ASSERT_TRUE(trace.has_value()) << trace.error().message;
    EXPECT_EQ(trace->file, file);
    EXPECT_EQ(trace->samples.size(), 2U);
}

TEST_F(ReadTraceFile, RefusesAMissingFile) {
    const std::string file = (folder_ / "none.csv").string();
    expect_refused(read_trace(file), file + ": cannot be opened: No such file or directory");
}

TEST_F(ReadTraceFile, RefusesADirectory) {
    expect_refused(read_trace(folder_.string()), folder_.string() + ": a directory, not a trace");
}

TEST_F(ReadTraceFile, NamesTheFileInErrors) {
    const std::string file = write("bad.csv", htc("1;2\n"));
    expect_refused(read_trace(file), file + ":3: 2 columns");
}

TEST_F(ReadTraceFile, TakesTheDeviceFromTheSidecar) {
    const std::string file = write("gaze.csv", native(""));
    const std::string good = R"("format": "gazeloop-gaze", "version": 1,
                                "axes": "+x right, +y up, -z forward")";
    EXPECT_EQ(read_trace(file)->device, "unknown device");
    write("gaze.csv.json", "{" + good + R"(, "device": "Pupil Core"})");
    EXPECT_EQ(read_trace(file)->device, "Pupil Core");
    write("gaze.csv.json", "{" + good + R"(, "device": 7})");
    EXPECT_EQ(read_trace(file)->device, "unknown device");
}

TEST_F(ReadTraceFile, RefusesASidecarThatSaysOtherwise) {
    const std::string file = write("gaze.csv", native(""));
    const auto with_sidecar = [&](const std::string& text) {
        write("gaze.csv.json", text);
        return read_trace(file);
    };
    expect_refused(with_sidecar("{"), file + ".json: not a JSON object");
    expect_refused(with_sidecar("[1, 2]"), file + ".json: not a JSON object");
    expect_refused(with_sidecar(""), file + ".json: not a JSON object");
    expect_refused(with_sidecar("{}"), file + ".json: 'format' must be \"gazeloop-gaze\"");
    expect_refused(with_sidecar(R"({"format": "gazeloop-gaze", "version": 2})"),
                   file + ".json: 'version' must be 1");
    expect_refused(with_sidecar(R"({"format": "gazeloop-gaze", "version": 1, "axes": "y down"})"),
                   file + ".json: 'axes' must be");
}

}  // namespace
}  // namespace gazeloop::drivers
