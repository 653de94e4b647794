#include "runtime/report/runtime_metrics/wivrn_csv_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/temporary_folder.h"

namespace gazeloop::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Expected<WivrnCsvReader> open(const std::string& text) {
    return WivrnCsvReader::open(std::make_unique<std::istringstream>(text), "w.csv");
}

std::string message(const std::string& text) {
    const auto reader = open(text);
    return reader ? "" : reader.error().message;
}

std::vector<WivrnRow> rows(WivrnCsvReader& reader) {
    std::vector<WivrnRow> all;
    while (const auto row = value_or_throw(reader.next())) {
        all.push_back(*row);
    }
    return all;
}

TEST(WivrnCsv, ReadsRowsWithAndWithoutAStreamAndFurtherCells) {
    auto reader =
        value_or_throw(open("\"wake_up\",7,1000,255\n"
                            "\"encode_begin\",7,1100,1,idr\n"
                            "display,9223372036854775807,9223372036854775807,0\n"));
    const std::vector<WivrnRow> all = rows(reader);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].event, WivrnEvent::WakeUp);
    EXPECT_EQ(all[0].frame, 7U);
    EXPECT_EQ(all[0].ns, 1000);
    EXPECT_EQ(all[0].stream, std::nullopt);
    EXPECT_EQ(all[1].event, WivrnEvent::EncodeBegin);
    EXPECT_EQ(all[1].stream, 1);
    EXPECT_EQ(all[2].event, WivrnEvent::Display);
    EXPECT_EQ(all[2].ns, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(reader.counts().rows, 3U);
}

TEST(WivrnCsv, KnowsEveryEventByItsName) {
    std::string text = "event,frame,timestamp,stream\r\n";
    for (const std::string_view name : kWivrnEventNames) {
        text += "\"" + std::string(name) + "\",1,5,0\r\n";
    }
    auto reader = value_or_throw(open(text));
    const std::vector<WivrnRow> all = rows(reader);
    ASSERT_EQ(all.size(), kWivrnEventCount);
    for (std::size_t i = 0; i < kWivrnEventCount; ++i) {
        EXPECT_EQ(all[i].event, static_cast<WivrnEvent>(i));
    }
    EXPECT_EQ(reader.counts().rows, kWivrnEventCount) << "the header is no row";
    EXPECT_EQ(reader.counts().bad, 0U);
}

TEST(WivrnCsv, CountsWhatIsOfNoUse) {
    auto reader =
        value_or_throw(open("\"begin\",1,5,255\n"
                            "\"begin\",1,soon,255\n"  // line 2
                            "\"begin\",1\n"
                            "\n"
                            "\"begin\",1,99999999999999999999,255\n"
                            "\"begin\"x,1,5,255\n"
                            "\"begin,1,5,255\n"
                            "\"yawn\",1,5,255\n"
                            "\"begin\",1,5,256\n"
                            "\"begin\",1,0,255\n"
                            "\"begin\",-1,5,255\n"
                            "\"begin\",2,6,255\n"
                            "\"begin\",3,7,25"));
    const std::vector<WivrnRow> all = rows(reader);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].frame, 2U);
    EXPECT_EQ(reader.counts().bad, 6U);
    EXPECT_EQ(reader.counts().first_bad_line, 2U);
    EXPECT_EQ(reader.counts().unknown, 2U);
    EXPECT_EQ(reader.counts().untimed, 2U);
    EXPECT_TRUE(reader.counts().cut);
}

TEST(WivrnCsv, RefusesWhatIsNoSuchFile) {
    EXPECT_THAT(message(""),
                AllOf(HasSubstr("w.csv"), HasSubstr("empty"), HasSubstr("WIVRN_DUMP_TIMINGS")));
    EXPECT_THAT(message("t_device_ns,left_x\n"),
                AllOf(HasSubstr("w.csv:1:"), HasSubstr("no row of WiVRn's timings")));
    EXPECT_THAT(message(std::string("\x03\x0a\x02", 3)), HasSubstr("w.csv:1:"));
    EXPECT_THAT(message(std::string(100'000, 'x')), HasSubstr("w.csv:1:"));
    const tests::TemporaryFolder folder;
    const auto missing = WivrnCsvReader::open(folder / "none.csv");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("none.csv: No such file"));
}

TEST(WivrnCsv, NamesTheLineOfBytesThatAreNoText) {
    auto reader = value_or_throw(open(std::string("\"begin\",1,5,255\n\"be\0gin\"", 24)));
    EXPECT_TRUE(value_or_throw(reader.next()));
    const auto row = reader.next();
    ASSERT_FALSE(row);
    EXPECT_THAT(row.error().message, HasSubstr("w.csv:2:"));
}

}  // namespace
}  // namespace gazeloop::report
