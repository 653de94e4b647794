// A cell that holds no number refuses no file, by any format.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "tests/unit/drivers/trace/trace_findings.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::array<std::string_view, 10> kMissing{"",    "NaN", "nan",  "-nan(ind)", "inf",
                                                    "n/a", "N/A", "-inf", "null",      "-1.#IND"};

gaze::GazeTrace read_htc(const std::string& rows) {
    return value_or_throw(read_text(fmt::format("{}\n{}", kHtcHeader, rows)));
}

gaze::GazeTrace read_native(const std::string& rows) {
    return value_or_throw(read_text(fmt::format("{}\n{}", kNativeHeader, rows)));
}

/// A row of htc's whose left eye is as given.
std::string htc_left(long long time, std::string_view valid, std::string_view direction,
                     std::string_view openness = "0.9", std::string_view origin = "38;2;-37") {
    return fmt::format("{};-1;{};31;{};0.8;{};-32;1;-36;{};0;0;1;0;0;0;0;0;0\n", time, valid,
                       openness, origin, direction);
}

std::string native_left(long long time, std::string_view valid, std::string_view direction,
                        std::string_view other = "-0.03,0,0,1,0.9") {
    return fmt::format("{0},{0},,{1},{2},{3},1,0,0,-1,0.03,0,0,1,0.9,,,,,,,\n", time, valid,
                       direction, other);
}

TEST(BadCells, MeanNothingInAnEyeThatIsInvalid) {
    for (const std::string_view cell : kMissing) {
        const gaze::GazeTrace htc = read_htc(htc_left(1, "8", fmt::format("{0};{0};{0}", cell),
                                                      "0.1", fmt::format("{0};{0};{0}", cell)) +
                                             htc_left(2, "31", "0;0;1"));
        EXPECT_FALSE(htc.samples[0].eyes[0].valid) << cell;
        EXPECT_DOUBLE_EQ(htc.samples[0].eyes[0].openness, 0.1);
        EXPECT_THAT(told(htc, TraceFindingKind::BadCells), IsEmpty()) << cell;

        const gaze::GazeTrace native = read_native(native_left(
            1, "0", fmt::format("{0},{0},{0}", cell), fmt::format("{0},{0},{0},{0},{0}", cell)));
        EXPECT_FALSE(native.samples[0].eyes[0].valid) << cell;
        EXPECT_EQ(native.samples[0].eyes[0].direction, glm::dvec3(0.0, 0.0, -1.0)) << cell;
        EXPECT_EQ(native.samples[0].eyes[0].openness, -1.0) << cell;
        EXPECT_THAT(native.report.findings(), IsEmpty()) << cell;
    }
    // Nor does anything else there.
    EXPECT_THAT(
        told(read_htc(htc_left(1, "0", "abc;;z", "q", "x;y;z")), TraceFindingKind::BadCells),
        IsEmpty());
    EXPECT_THAT(read_native(native_left(1, "0", "abc,,z", "x,y,z,2,q")).report.findings(),
                IsEmpty());
}

TEST(BadCells, MakeAnEyeInvalidThatTheRowCallsValid) {
    for (const std::string cell : {"", "NaN", "-nan(ind)", "inf", "n/a", "abc", "1e999", "0x1"}) {
        const gaze::GazeTrace htc =
            read_htc(htc_left(1, "31", "0;0;1") + htc_left(2, "31", "0;" + cell + ";1") +
                     htc_left(3, "31", "0;0;" + cell) + htc_left(4, "31", "0;0;1"));
        ASSERT_EQ(htc.samples.size(), 4U);
        EXPECT_TRUE(htc.samples[0].eyes[0].valid);
        EXPECT_FALSE(htc.samples[1].eyes[0].valid);
        EXPECT_FALSE(htc.samples[2].eyes[0].valid);
        EXPECT_TRUE(htc.samples[3].eyes[0].valid);
        EXPECT_TRUE(htc.samples[1].eyes[1].valid) << "the other eye";
        EXPECT_DOUBLE_EQ(htc.samples[1].eyes[0].openness, 0.9);
        EXPECT_THAT(told(htc, TraceFindingKind::BadCells),
                    ElementsAre(fmt::format("3: left eye: column 'gaze_direct_L.y': '{}' is no "
                                            "number (2 rows with such cells: the eye is invalid "
                                            "there)",
                                            cell)));
        EXPECT_EQ(htc.report.count(TraceFindingKind::BadCells).rows, 2U);
        EXPECT_EQ(htc.report.rows_dropped(), 0U);

        const gaze::GazeTrace native =
            read_native(native_left(1, "1", "0," + cell + ",-1") + native_left(2, "1", "0,0,-1"));
        EXPECT_FALSE(native.samples[0].eyes[0].valid);
        EXPECT_TRUE(native.samples[1].eyes[0].valid);
        EXPECT_EQ(native.report.count(TraceFindingKind::BadCells).rows, 1U);
    }
}

TEST(BadCells, MakeADirectionWithoutLength) {
    const gaze::GazeTrace trace = read_htc(htc_left(1, "31", "0;0;1") + htc_left(2, "31", "0;0;0"));
    EXPECT_FALSE(trace.samples[1].eyes[0].valid);
    EXPECT_THAT(told(trace, TraceFindingKind::BadCells),
                ElementsAre("3: left eye: a direction without length (0, 0, 0) (1 row with such "
                            "cells: the eye is invalid there)"));
}

TEST(BadCells, MakeWhatIsNotNeededUnknown) {
    const gaze::GazeTrace trace =
        read_htc(htc_left(1, "31", "0;0;1", "abc") + htc_left(2, "31", "0;0;1", "0.9", "38;x;-37") +
                 htc_left(3, "31", "0;0;1", "1.5") + htc_left(4, "31", "0;0;1"));
    for (const gaze::GazeSample& sample : trace.samples) {
        EXPECT_TRUE(sample.eyes[0].valid);
    }
    EXPECT_EQ(trace.samples[0].eyes[0].openness, -1.0);
    EXPECT_EQ(trace.samples[1].eyes[0].origin_m, glm::dvec3(0.0));
    EXPECT_EQ(trace.samples[2].eyes[0].openness, -1.0);
    EXPECT_EQ(trace.samples[3].eyes[0].openness, 0.9);
    EXPECT_THAT(told(trace, TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("2: left eye, beside its direction: column 'openness_L': "
                                      "'abc' is neither 0 to 1 nor -1 (unknown) (3 rows")));
}

TEST(BadCells, CountNothingThatSaysItIsMissing) {
    for (const std::string_view cell : kMissing) {
        const gaze::GazeTrace trace =
            read_htc(htc_left(1, "31", "0;0;1", cell, fmt::format("{0};{0};{0}", cell)));
        EXPECT_TRUE(trace.samples[0].eyes[0].valid);
        EXPECT_EQ(trace.samples[0].eyes[0].openness, -1.0);
        EXPECT_EQ(trace.samples[0].eyes[0].origin_m, glm::dvec3(0.0));
        EXPECT_THAT(trace.report.findings(), IsEmpty()) << cell;
    }
}

TEST(BadCells, TakeARowWithoutAnEye) {
    EXPECT_THAT(read_htc(htc_left(1, "", ";;", "", ";;")).report.findings(), IsEmpty());
    // A direction that nothing vouches for is another matter.
    EXPECT_THAT(told(read_htc(htc_left(1, "n/a", "0;0;1")), TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("column 'eye_valid_L': 'n/a' does not say")));
}

TEST(BadCells, LeaveAHeadUnknown) {
    const auto with_head = [](long long time, std::string_view helmet) {
        return htc_row(time, "0;0;1", "0;0;1", helmet);
    };
    const gaze::GazeTrace htc = read_htc(
        with_head(1, "0;0;0;0;0;0") + with_head(2, "0;0;0;0;abc;0") + with_head(3, "0;0;;0;0;0") +
        with_head(4, "nan;nan;nan;nan;nan;nan") + with_head(5, ";;;;;"));
    ASSERT_EQ(htc.samples.size(), 5U);
    EXPECT_TRUE(htc.samples[0].head.has_value());
    for (const std::size_t row : {1U, 2U, 3U, 4U}) {
        EXPECT_FALSE(htc.samples[row].head.has_value()) << row;
        EXPECT_TRUE(htc.samples[row].eyes[0].valid) << row;
    }
    EXPECT_THAT(told(htc, TraceFindingKind::BadCells),
                ElementsAre("3: head: column 'helmet_rot_y': 'abc' is no number (2 rows with such "
                            "cells: its pose is unknown there)",
                            "5: head's pose: column 'helmet_pos_x': 'nan' is no number, though "
                            "other rows have one (2 rows with such cells: unknown there)"));

    const gaze::GazeTrace native =
        read_native(native_row(0, 1, "", "1,2,3,0,0,0,0") + native_row(1, 2, "", "1,2,3,0,0,,1") +
                    native_row(2, 3, "", "1,2,3,0,0,0,1"));
    EXPECT_FALSE(native.samples[0].head.has_value());
    EXPECT_FALSE(native.samples[1].head.has_value());
    EXPECT_TRUE(native.samples[2].head.has_value());
    EXPECT_THAT(told(native, TraceFindingKind::BadCells),
                ElementsAre("2: head: column 'head_qw': '0' ends an orientation without length (2 "
                            "rows with such cells: its pose is unknown there)"));
}

TEST(BadCells, LeaveTimesUnread) {
    const std::string text = fmt::format("{}\n{}", kHtcHeader,
                                         htc_row(1) + "x" + htc_row(2) + "12.5" + htc_row(3) +
                                             "nan" + htc_row(4).substr(1) + htc_row(5));
    EXPECT_EQ(read_text(text).error().message,
              "gaze.csv:3: column 'time(100ns)': 'x2' is no whole number of 100 ns; 3 rows without "
              "a readable time: dropped; mend the column, or --accept-repairs leaves "
              "these rows out");
    std::istringstream in(text);
    const gaze::GazeTrace trace =
        value_or_throw(read_trace(in, "gaze.csv", {.accept_repairs = true}));
    EXPECT_EQ(trace.samples.size(), 2U);
    EXPECT_EQ(trace.report.rows, 5U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::BadTime).rows, 3U);
    EXPECT_EQ(findings(trace, TraceFindingKind::BadTime).front().line, 3U);
}

TEST(BadCells, LeaveTheClockOfWholeMilliseconds) {
    const gaze::GazeTrace trace =
        read_htc("6.38E+17;100" + htc_row(0).substr(4) + "6.38E+17;108" + htc_row(0).substr(4) +
                 "6.38E+17;117" + htc_row(0).substr(4));
    ASSERT_EQ(trace.samples.size(), 3U);
    EXPECT_EQ(trace.samples[2].sampled.ns, 17'000'000);
    EXPECT_THAT(told(trace, TraceFindingKind::BadTime),
                ElementsAre("2: column 'time(100ns)': '6.38E+17' is no whole number of 100 ns, nor "
                            "is it in any row: the times are those of 'time_stamp(ms)'"));
}

TEST(BadCells, AreNamedWhereSecondsStandForNanoseconds) {
    std::string text = fmt::format("{}\n", kNativeHeader);
    for (int i = 0; i < 20; ++i) {
        text += fmt::format("{},5000.{:06}", i, 8'333 * i) + native_row(0, 0).substr(3);
    }
    EXPECT_THAT(read_text(text).error().message,
                HasSubstr("gaze.csv:3: column 't_device_ns': '5000.008333' is no whole number of "
                          "nanoseconds; 19 rows without a readable time"));
}

TEST(BadCells, LeaveASequenceOrArrivalUnknown) {
    const gaze::GazeTrace trace = read_native(native_row(0, 1, "10") + native_row(-1, 2, "11") +
                                              native_row(2, 3, "x") + native_row(3, 4, "nan"));
    ASSERT_EQ(trace.samples.size(), 4U);
    EXPECT_TRUE(trace.samples[1].arrived.known());
    EXPECT_FALSE(trace.samples[2].arrived.known());
    EXPECT_FALSE(trace.samples[3].arrived.known());
    EXPECT_THAT(told(trace, TraceFindingKind::BadCells),
                ElementsAre("3: sequence number or arrival: column 'sequence': '-1' is no whole "
                            "number from 0 on (2 rows with such cells: unknown there)",
                            "5: arrival: column 't_host_ns': 'nan' is no number, though other rows "
                            "have one (1 row with such cells: unknown there)"));
}

/// A valid eye without its place jumps there; what other rows say is missed.
TEST(BadCells, CountWhatIsMissingWhereOtherRowsHaveIt) {
    for (const std::string_view cell : kMissing) {
        std::string native;
        std::string htc;
        for (int i = 0; i < 40; ++i) {
            const bool lacks = i % 4 == 1;
            const std::string other =
                lacks ? fmt::format("{0},{0},{0},{0},{0}", cell) : std::string{"-0.03,0,0,1,0.9"};
            native += native_left(i * 10'000'000LL, "1", "0,0,-1", other);
            htc += htc_left(i * 100'000LL, "31", "0;0;1", lacks ? cell : "0.9",
                            lacks ? fmt::format("{0};{0};{0}", cell) : "38;2;-37");
        }
        const gaze::GazeTrace trace = read_native(native);
        EXPECT_TRUE(trace.samples[1].eyes[0].valid);
        EXPECT_EQ(trace.samples[1].eyes[0].origin_m, glm::dvec3(0.0));
        EXPECT_EQ(trace.samples[1].eyes[0].openness, -1.0);
        EXPECT_THAT(
            told(trace, TraceFindingKind::BadCells),
            ElementsAre(fmt::format("3: left eye's place: column 'left_origin_x_m': '{}' is no "
                                    "number, though other rows have one (10 rows with such cells: "
                                    "unknown there)",
                                    cell),
                        HasSubstr("3: left eye's openness: column 'left_openness'"),
                        HasSubstr("3: left eye's confidence: column 'left_confidence'")));
        EXPECT_TRUE(trace.report.worth_a_warning());
        EXPECT_EQ(trace.report.rows_dropped(), 0U);
        EXPECT_THAT(told(read_htc(htc), TraceFindingKind::BadCells),
                    ElementsAre(HasSubstr("3: left eye's place: column 'gaze_origin_L.x(mm)'"),
                                HasSubstr("3: left eye's openness: column 'openness_L'")))
            << cell;
    }
}

TEST(BadCells, CountRowsWithoutAHeadThatOthersHave) {
    std::string rows;
    for (int i = 0; i < 40; ++i) {
        rows += native_row(i, i * 10'000'000LL, i == 7 ? "" : std::to_string(i * 10'000'000LL),
                           i >= 10 && i < 15 ? ",,,,,," : "0,1,0,0,0,0,1");
    }
    const gaze::GazeTrace trace = read_native(rows);
    EXPECT_FALSE(trace.samples[12].head.has_value());
    EXPECT_FALSE(trace.samples[7].arrived.known());
    EXPECT_THAT(told(trace, TraceFindingKind::BadCells),
                ElementsAre(HasSubstr("12: head's pose: column 'head_x_m': '' is no number, though "
                                      "other rows have one (5 rows"),
                            HasSubstr("9: arrival: column 't_host_ns': '' is no number, though "
                                      "other rows have one (1 row ")));
}

TEST(BadCells, TakeWordsForAnEyesValidity) {
    for (const auto& [yes, no] : {std::pair{"true", "false"}, std::pair{"True", "False"},
                                  std::pair{"YES", "no"}, std::pair{"Valid", "Invalid"}}) {
        const gaze::GazeTrace trace =
            read_native(native_left(1, yes, "0,0,-1") + native_left(2, no, "0,0,-1"));
        EXPECT_TRUE(trace.samples[0].eyes[0].valid) << yes;
        EXPECT_FALSE(trace.samples[1].eyes[0].valid) << no;
        EXPECT_THAT(told(trace, TraceFindingKind::BadCells), IsEmpty());
        EXPECT_THAT(told(trace, TraceFindingKind::Text),
                    ElementsAre(HasSubstr("words for 1 and 0: read as these")));
    }
}

TEST(BadCells, TakeMinusSignsOfWordProcessors) {
    const gaze::GazeTrace trace = read_native(native_left(1, "1",
                                                          "\xE2\x88\x92"
                                                          "0.6,0,\xE2\x88\x92"
                                                          "0.8"));
    EXPECT_TRUE(trace.samples[0].eyes[0].valid);
    EXPECT_DOUBLE_EQ(trace.samples[0].eyes[0].direction.x, -0.6);
    EXPECT_THAT(told(trace, TraceFindingKind::Text),
                ElementsAre("2: minus signs (U+2212): read as '-'"));
}

TEST(BadCells, RefuseAFileOfWhichTooManyAreNotUnderstood) {
    const auto rows = [](int odd) {
        std::string text;
        for (int i = 0; i < 400; ++i) {
            text += fmt::format("{0},{1},,{2},0,0,-1,,,,,,{2},0,0,-1,,,,,,,,,,,,\n", i,
                                i * 10'000'000LL, i >= 10 && i < 10 + odd ? "oui" : "1");
        }
        return fmt::format("{}\n{}", kNativeHeader, text);
    };
    const auto few = read_text(rows(40));
    ASSERT_TRUE(few) << few.error().message;
    EXPECT_TRUE(few->report.worth_a_warning());
    EXPECT_EQ(
        read_text(rows(41)).error().message,
        "gaze.csv:12: 41 of 400 rows have no gaze that is understood, the first of them here "
        "(left eye: column 'left_valid': 'oui' does not say whether the eye is valid (41 rows "
        "with such cells: the eye is invalid there)); mend these cells, or --accept-repairs "
        "plays the other rows");
    std::istringstream in(rows(41));
    EXPECT_TRUE(read_trace(in, "gaze.csv", {.accept_repairs = true}));
}

TEST(BadCells, NameDirectionsOfAnotherLength) {
    const gaze::GazeTrace trace =
        read_native(native_left(1, "1", "0,0,-1.001") + native_left(2, "1", "0,1.5,-2"));
    EXPECT_THAT(told(trace, TraceFindingKind::Text),
                ElementsAre("3: left eye: 1 direction of another length than 1, the first of 2.5: "
                            "taken for where they point"));
}

TEST(BadCells, CountOnNumbersWithASign) {
    const auto read_numbered = [](long long first, long long range) {
        std::string rows;
        for (long long i = 0; i < 40; ++i) {
            const long long number = first + i;
            rows += native_row(number < range / 2 ? number : number - range, i * 10'000'000);
        }
        return read_native(rows);
    };
    for (const long long range : {1LL << 8, 1LL << 16, 1LL << 32}) {
        const gaze::GazeTrace trace = read_numbered(range / 2 - 20, range);
        EXPECT_THAT(told(trace, TraceFindingKind::BadCells), IsEmpty()) << range;
        EXPECT_THAT(told(trace, TraceFindingKind::SequenceRestarted),
                    ElementsAre(HasSubstr("22: column 'sequence': '-")));
        EXPECT_EQ(trace.report.lost_by_tracker, 0U) << range;
        for (std::size_t i = 0; i < 40; ++i) {
            EXPECT_EQ(trace.samples[i].sequence, static_cast<std::uint64_t>(range / 2 - 20) + i);
        }
    }
}

TEST(BadCells, LeaveUnknownWhatWasLostWhereManyNumbersAre) {
    const auto read_with = [](int unread) {
        std::string rows;
        for (int i = 0; i < 40; ++i) {
            rows += (i >= 10 && i < 10 + unread ? "x" : std::to_string(i)) +
                    native_row(0, i * 10'000'000LL).substr(1);
        }
        return read_native(rows).report.lost_by_tracker;
    };
    EXPECT_EQ(read_with(4), 0U);
    EXPECT_EQ(read_with(5), std::nullopt);
}

TEST(BadCells, AreNamedSafely) {
    const auto first_told = [](const std::string& cell) {
        return told(read_htc(htc_left(1, "31", "0;" + cell + ";1")), TraceFindingKind::BadCells)
            .at(0);
    };
    EXPECT_THAT(first_told("\xff\xfe"), HasSubstr("'?\?' is no number"));
    EXPECT_THAT(first_told(std::string(500, 'a')),
                HasSubstr(fmt::format("'{}...' is no number", std::string(40, 'a'))));
}

}  // namespace
}  // namespace gazeloop::drivers
