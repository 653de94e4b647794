// What files look like that other programs wrote, saved or cut: read where that is safe, and said.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "drivers/trace/text/text_lines.h"
#include "tests/support/gzip.h"
#include "tests/unit/drivers/trace/trace_findings.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using tests::gzipped;

/// Three rows whose directions differ.
std::string htc() {
    return fmt::format("{}\r\n{}{}{}", kHtcHeader, htc_row(1000, "-0.6;0;0.8"),
                       htc_row(2000, "0;0.6;0.8"), htc_row(3000, "0.6;0;0.8"));
}

std::string native() {
    return fmt::format("{}\n{}{}", kNativeHeader, native_row(0, 1000), native_row(1, 2000));
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

std::string refusal(const std::string& text) {
    const Expected<gaze::GazeTrace> trace = read_text(text);
    return trace ? "accepted" : trace.error().message;
}

/// The three rows of htc(), whatever they looked like.
void expect_read(const Expected<gaze::GazeTrace>& trace) {
    ASSERT_TRUE(trace.has_value()) << trace.error().message;
    ASSERT_EQ(trace->samples.size(), 3U);
    EXPECT_EQ(trace->report.rows, 3U);
    for (const gaze::GazeSample& sample : trace->samples) {
        EXPECT_TRUE(sample.eyes[0].valid);
        EXPECT_TRUE(sample.eyes[1].valid);
        EXPECT_DOUBLE_EQ(sample.eyes[0].openness, 0.9);
        EXPECT_TRUE(sample.head.has_value());
    }
    EXPECT_NEAR(trace->samples[0].eyes[0].direction.x, 0.6, 1e-12);
    EXPECT_NEAR(trace->samples[1].eyes[0].direction.y, 0.6, 1e-12);
    EXPECT_NEAR(trace->samples[2].eyes[0].direction.x, -0.6, 1e-12);
    EXPECT_EQ(trace->samples[2].sampled.ns, 200'000);
}

std::vector<std::string> notes(const Expected<gaze::GazeTrace>& trace) {
    return told(trace.value(), TraceFindingKind::Text);
}

TEST(TraceText, SaysNothingOfAnOrdinaryFile) {
    const auto trace = read_text(htc());
    expect_read(trace);
    EXPECT_THAT(trace->report.findings(), IsEmpty());
    EXPECT_THAT(read_text(native())->report.findings(), IsEmpty());
}

TEST(TraceText, ReadsQuotedNames) {
    std::string text = htc();
    const std::size_t end = text.find('\r');
    text = '"' + replaced(text.substr(0, end), ";", "\";\"") + '"' + text.substr(end);
    const auto trace = read_text(text);
    expect_read(trace);
    EXPECT_THAT(notes(trace), ElementsAre("1: cells in double quotes: read without them"));
}

TEST(TraceText, ReadsQuotedCells) {
    const auto trace = read_text(replaced(htc(), ";0.6;0;0.8", ";\"0.6\"; \"0\" ;\"0.8\""));
    expect_read(trace);
    EXPECT_THAT(notes(trace), ElementsAre("4: cells in double quotes: read without them"));
}

TEST(TraceText, TakesSeparatorsAndQuotesInQuotesForText) {
    std::string text = replaced(htc(), "\r\n", ";\"at 5\"\" or 6\"\"; not far\"\r\n");
    text = replaced(text, "helmet_rot_z;\"at 5\"\" or 6\"\"; not far\"",
                    "helmet_rot_z;\"what, of it; at \"\"all\"\", is, this, for, anyone, to, see, "
                    "in, here, or, there, or, at, home, with, so, many, commas, in, it\"");
    const auto trace = read_text(text);
    expect_read(trace);
    EXPECT_EQ(notes(trace).size(), 1U);
}

TEST(TraceText, RefusesQuotesThatDoNotClose) {
    EXPECT_THAT(refusal(replaced(htc(), "-0.6;0;0.8", "-0.6;\"0;0.8")),
                HasSubstr("gaze.csv:2: a cell's double quote is not closed on its line: close it"));
    EXPECT_THAT(refusal(replaced(htc(), "-0.6;0;0.8", "-0.6;\"0\"1;0.8")),
                HasSubstr("gaze.csv:2: text behind a cell's closing quote: "));
    EXPECT_THAT(refusal('"' + htc()), HasSubstr("gaze.csv:1: "));
}

TEST(TraceText, ReadsOldMacLines) {
    const auto trace = read_text(replaced(htc(), "\r\n", "\r"));
    expect_read(trace);
    EXPECT_THAT(notes(trace), ElementsAre("1: lines end with a lone CR, as old Macs wrote them"));
    // Also where a buffer of 128 KiB ends between CR and LF, wherever that is in a row.
    std::string text = std::string{kHtcHeader} + "\r\n";
    std::size_t rows = 0;
    for (; text.size() < 200'000; ++rows) {
        text += htc_row(static_cast<long long>(1000 + rows));
    }
    for (std::size_t shift = 0; shift < 90; ++shift) {
        const auto longer = read_text("#" + std::string(shift, ' ') + "\r\n" + text);
        ASSERT_TRUE(longer.has_value()) << longer.error().message;
        ASSERT_EQ(longer->samples.size(), rows);
        ASSERT_EQ(notes(longer).size(), 1U) << "the comment";
    }
}

TEST(TraceText, TakesTheSeparatorFromALineThatNamesIt) {
    for (const std::string_view line : {"sep=;\r\n", "SEP=;\n", "\"sep=;\"\r\n", "sep=;;;; \r\n"}) {
        const auto trace = read_text(std::string{line} + htc());
        expect_read(trace);
        EXPECT_THAT(notes(trace),
                    ElementsAre("1: a line 'sep=' before the header: its separator is used"));
    }
    expect_read(read_text("sep=|\n" + replaced(htc(), ";", "|")));
    expect_read(read_text("sep=\t\n" + replaced(htc(), ";", "\t")));
    EXPECT_THAT(refusal("sep=\n" + htc()),
                HasSubstr("gaze.csv:1: 'sep=' names no separator that is known: use"));
    EXPECT_THAT(refusal("sep=x\n" + htc()), HasSubstr("names no separator"));
    EXPECT_THAT(refusal("sep=,\n" + htc()), HasSubstr("gaze.csv:2: unknown header"));
}

TEST(TraceText, SkipsBlankAndCommentLinesBeforeTheHeader) {
    const auto trace = read_text("\r\n# made by us; on a Monday\r\n  \r\n" + htc());
    expect_read(trace);
    EXPECT_THAT(notes(trace), ElementsAre("1: blank or comment lines before the header, which is "
                                          "line 4: skipped"));
    EXPECT_THAT(refusal("# only\n\n"), HasSubstr("gaze.csv:3: no header: "));
    // Lines are counted from the file's beginning.
    EXPECT_THAT(refusal("# x\n" + htc() + "1;2\n"), HasSubstr("gaze.csv:6: 2 columns"));
    EXPECT_THAT(refusal("# x\nfoo,bar\n"), HasSubstr("gaze.csv:2: unknown header"));
}

TEST(TraceText, KnowsNamesInAnotherCase) {
    std::string text = htc();
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find('\r'));
    std::transform(text.begin(), end, text.begin(),
                   [](char c) { return static_cast<char>(std::toupper(c)); });
    const auto trace = read_text(text);
    expect_read(trace);
    EXPECT_THAT(notes(trace),
                ElementsAre("1: column names in another case: 'GAZE_DIRECT_L.X' (24 in all)"));
}

TEST(TraceText, PrefersTheExactNameAndGuessesNone) {
    // Two that differ in case from the name and from each other: neither is it.
    std::string text = replaced(htc(), "time_stamp(ms)", "Time(100ns)");
    expect_read(read_text(text));
    text = replaced(text, "time(100ns)", "TIME(100ns)");
    EXPECT_THAT(refusal(text), HasSubstr("for htc-vive-pro it lacks 'time(100ns)'"));
}

TEST(TraceText, ReadsGzip) {
    const auto trace = read_text(gzipped(htc()));
    expect_read(trace);
    EXPECT_THAT(notes(trace), ElementsAre("0: gzip: decompressed"));
    expect_read(read_text(gzipped(htc().substr(0, 300)) + gzipped(htc().substr(300))));
    const std::string file = gzipped(htc());
    EXPECT_THAT(refusal(file.substr(0, file.size() - 9)),
                HasSubstr(": the gzip data end early, the file was cut: copy or download it"));
    EXPECT_THAT(refusal(file + "more"), HasSubstr("something else follows the end of the gzip"));
    EXPECT_THAT(refusal(gzipped("")), HasSubstr("gaze.csv:1: empty file"));
}

TEST(TraceText, ReadsDecimalCommas) {
    for (const std::string_view separator : {";", "\t"}) {
        const auto trace = read_text(replaced(replaced(htc(), "0.", "0,"), ";", separator));
        expect_read(trace);
        EXPECT_THAT(notes(trace), ElementsAre("2: decimal commas: read as points"));
    }
    // In quotes a comma is safe even where commas separate.
    const auto quoted = read_text(replaced(native(), ",0.9,", ",\"0,9\","));
    ASSERT_TRUE(quoted.has_value()) << quoted.error().message;
    EXPECT_DOUBLE_EQ(quoted->samples[0].eyes[0].confidence, 0.9);
    EXPECT_THAT(refusal(replaced(native(), ",0.9,", ",0,9,")),
                HasSubstr("30 columns, the header has 28: mend or remove the line; numbers with "
                          "decimal commas need ';' between them, or quotes"));
}

TEST(TraceText, ReadsWholeNumbersThatWereWrittenAsReals) {
    const auto trace = read_text(replaced(htc(), ";31;31;", ";31.0;31.0;"));
    expect_read(trace);
    EXPECT_THAT(notes(trace),
                ElementsAre("2: whole numbers with zeros behind a point: read without them"));
}

TEST(TraceText, DropsALastLineThatWasCut) {
    const std::string text = htc();
    const std::size_t last = text.rfind("3000;");
    for (const std::size_t left : {last + 1, last + 4, last + 5, text.rfind(';')}) {
        const auto trace = read_text(text.substr(0, left));
        ASSERT_TRUE(trace.has_value()) << trace.error().message;
        EXPECT_EQ(trace->samples.size(), 2U);
        EXPECT_EQ(trace->report.rows, 3U);
        EXPECT_EQ(trace->report.rows_dropped(), 1U);
        EXPECT_THAT(told(*trace, TraceFindingKind::CutRow),
                    ElementsAre("4: the last line was not finished: it is not used"));
    }
    // With an end it is no cut; nor is it one with all its cells.
    EXPECT_THAT(refusal(text.substr(0, last + 5) + "\n"),
                HasSubstr("gaze.csv:4: 2 columns, the header has 24"));
    expect_read(read_text(text.substr(0, text.size() - 2)));
    EXPECT_THAT(refusal(text.substr(0, text.size() - 2) + ";1"), HasSubstr("gaze.csv:4: 25 col"));
}

TEST(TraceText, DropsALastLineThatWasCutInQuotes) {
    const std::string text = replaced(htc(), "0.6;0;0.8", "0.6;0;\"0.8\"");
    const auto trace = read_text(text.substr(0, text.rfind("8\"")));
    ASSERT_TRUE(trace.has_value()) << trace.error().message;
    EXPECT_EQ(trace->samples.size(), 2U);
    EXPECT_EQ(findings(*trace, TraceFindingKind::CutRow).size(), 1U);
}

TEST(TraceText, TakesASeparatorAtTheEndOfAllRowsOrOfTheHeader) {
    std::string text = htc();
    const std::size_t end = text.find('\r');
    const auto rows_end = read_text(text.substr(0, end) +
                                    replaced(text.substr(end), "\r\n", ";\r\n").replace(0, 1, ""));
    expect_read(rows_end);
    EXPECT_THAT(notes(rows_end),
                ElementsAre("2: rows end with a separator, the header does not: read without it"));
    const auto header_ends = read_text(text.substr(0, end) + ';' + text.substr(end));
    expect_read(header_ends);
    EXPECT_THAT(notes(header_ends),
                ElementsAre("1: the header ends with a separator, rows do not: read without it"));
    // One row alone that has a cell too many may have it anywhere.
    EXPECT_THAT(refusal(text + "4000;;" + htc_row(0).substr(2)), HasSubstr("gaze.csv:5: 25 col"));
}

std::string utf16(std::string_view text, bool little) {
    std::string wide;
    for (const char c : text) {
        wide += little ? std::string{c, '\0'} : std::string{'\0', c};
    }
    return wide;
}

TEST(TraceText, RefusesWhatIsNoTableByItsKind) {
    for (const bool little : {true, false}) {
        EXPECT_EQ(refusal((little ? "\xFF\xFE" : "\xFE\xFF") + utf16(htc(), little)),
                  "gaze.csv:1: UTF-16 text: save it as UTF-8");
        EXPECT_EQ(refusal(utf16(htc(), little)), "gaze.csv:1: UTF-16 text: save it as UTF-8");
    }
    EXPECT_THAT(refusal(std::string("PK\x03\x04\x14\0\x06\0", 8)),
                HasSubstr("gaze.csv:1: a zip archive, as Excel's .xlsx is one: save the table"));
    EXPECT_THAT(refusal("\n <!DOCTYPE html>\n<html>"),
                HasSubstr("gaze.csv:1: an HTML or XML page, not a table: download the file"));
    EXPECT_THAT(refusal("\xEF\xBB\xBF<?xml version"), HasSubstr("an HTML or XML page"));
    EXPECT_THAT(refusal(std::string("SQLite format 3\0", 16)), HasSubstr("replay FILE"));
    EXPECT_THAT(refusal("\xFD"
                        "7zXZ\x01"),
                HasSubstr("decompress it with xz -d"));
    EXPECT_EQ(refusal("\x89HDF\r\n\x1a\n"),
              "gaze.csv:1: an HDF5 file: export the table in it as CSV");
    EXPECT_THAT(refusal(gzipped(utf16(htc(), true))), HasSubstr("UTF-16 text"));
    std::string tar = "gaze.csv" + std::string(249, 'x') + "ustar";
    EXPECT_THAT(refusal(tar), HasSubstr("a tar archive"));
    EXPECT_THAT(refusal(""), HasSubstr("gaze.csv:1: empty file: record or copy it again"));
}

TEST(TraceText, SaysWhereAFileStopsToBeText) {
    EXPECT_THAT(refusal(htc() + std::string(512, '\0')),
                HasSubstr("gaze.csv:5: not a text file (a byte 0x00): export the table as CSV; if "
                          "it is text up to here"));
}

/// Lines are looked at eight bytes at a time.
TEST(TextLines, FindsEveryControlByteWhereverItStands) {
    for (std::size_t length = 0; length < 20; ++length) {
        for (const std::string_view filling : {"a", "\t", " ", "\xC3\xA9"}) {
            std::string first;
            while (first.size() < length) {
                first += filling;
            }
            std::istringstream in(first + "\nsecond\r\n" + first + '\x01');
            TextLines lines(in, "text");
            ASSERT_TRUE(value_or_throw(lines.next()));
            EXPECT_EQ(lines.text(), first);
            lines.hold();
            ASSERT_TRUE(value_or_throw(lines.next()));
            EXPECT_EQ(lines.text(), first) << "once more";
            ASSERT_TRUE(value_or_throw(lines.next()));
            EXPECT_EQ(lines.text(), "second");
            const auto third = lines.next();
            ASSERT_FALSE(third);
            EXPECT_THAT(third.error().message, HasSubstr("text:3: not a text file (a byte 0x01)"));
        }
    }
}

TEST(TraceText, SkipsOtherCommentsAndTitlesBeforeTheHeader) {
    for (const std::string_view comment : {"// made by us; twice", "\"# a; b\"", "\"// a\""}) {
        const auto trace = read_text(std::string{comment} + "\r\n" + htc());
        expect_read(trace);
        EXPECT_THAT(notes(trace), ElementsAre("1: blank or comment lines before the header, which "
                                              "is line 2: skipped"));
    }
    for (const std::string_view title : {"My recording", "My recording;;;;", "\"One, two\""}) {
        const auto trace = read_text(std::string{title} + "\r\n" + htc());
        expect_read(trace);
        EXPECT_THAT(notes(trace),
                    ElementsAre("1: a title before the header, which is line 2: skipped"));
    }
    EXPECT_THAT(refusal(replaced(htc(), ";", " ")),
                HasSubstr("no header: no line up to here has columns' names with , ; | or tabs"));
}

TEST(TraceText, KnowsBarsForSeparators) {
    const auto trace = read_text(replaced(htc(), ";", "|"));
    expect_read(trace);
    EXPECT_THAT(notes(trace), IsEmpty());
}

}  // namespace
}  // namespace gazeloop::drivers
