// Of a format's columns only those are needed that a fovea point needs; SRanipal's bits are
// believed one by one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/drivers/trace/trace_findings.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A table of some of htc's columns: two rows, in which the gaze moves.
std::string htc_of(const std::vector<std::string>& names,
                   const std::map<std::string, std::string>& cells = {}) {
    std::string text;
    for (int row = -1; row < 2; ++row) {
        for (const std::string& name : names) {
            std::string cell = name;
            if (row >= 0) {
                cell = name == "time(100ns)"           ? std::to_string(1000 + 100 * row)
                       : name == "time_stamp(ms)"      ? std::to_string(2'147'483'646 + row)
                       : name.starts_with("eye_valid") ? "31"
                       : name.starts_with("openness")  ? "0.5"
                       : name.find(".z") != name.npos  ? "1"
                                                       : "0";
                if (const auto other = cells.find(name); other != cells.end()) {
                    cell = other->second;
                }
            }
            text += (name == names.front() ? "" : ";") + cell;
        }
        text += '\n';
    }
    return text;
}

const std::vector<std::string> kLeft{"time(100ns)", "eye_valid_L", "gaze_direct_L.x",
                                     "gaze_direct_L.y", "gaze_direct_L.z"};
const std::vector<std::string> kBoth{"time(100ns)",     "eye_valid_L",     "gaze_direct_L.x",
                                     "gaze_direct_L.y", "gaze_direct_L.z", "eye_valid_R",
                                     "gaze_direct_R.x", "gaze_direct_R.y", "gaze_direct_R.z"};

std::vector<std::string> with(std::vector<std::string> names, std::vector<std::string> more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
}

gaze::GazeTrace read_all(const std::string& text) { return value_or_throw(read_text(text)); }

std::string refusal(const std::string& text) {
    const Expected<gaze::GazeTrace> trace = read_text(text);
    return trace ? "accepted" : trace.error().message;
}

TEST(NeededColumns, AreTimeValidityAndDirection) {
    const gaze::GazeTrace trace = read_all(htc_of(kBoth));
    ASSERT_EQ(trace.samples.size(), 2U);
    for (const gaze::EyeRay& ray : trace.samples[0].eyes) {
        EXPECT_TRUE(ray.valid);
        EXPECT_EQ(ray.openness, -1.0);
        EXPECT_EQ(ray.confidence, -1.0);
        EXPECT_EQ(ray.origin_m, glm::dvec3(0.0));
    }
    EXPECT_FALSE(trace.samples[0].head.has_value());
    EXPECT_THAT(trace.report.findings(), IsEmpty());
}

TEST(NeededColumns, AreThoseOfOneEye) {
    const gaze::GazeTrace trace = read_all(htc_of(kLeft));
    EXPECT_TRUE(trace.samples[0].eyes[0].valid);
    EXPECT_FALSE(trace.samples[0].eyes[1].valid);
    EXPECT_THAT(told(trace, TraceFindingKind::Text),
                ElementsAre("1: no right eye, for want of its direction or 'eye_valid_R'"));
    EXPECT_THAT(refusal(htc_of({"time(100ns)", "eye_valid_L", "gaze_direct_L.x", "eye_valid_R",
                                "gaze_direct_R.y", "gaze_direct_R.z"})),
                HasSubstr("gaze.csv:1: unknown header; known formats: " + known_formats() +
                          "; for "
                          "htc-vive-pro it lacks 'gaze_direct_R.x'"));
}

TEST(NeededColumns, SayWhatIsIncomplete) {
    const gaze::GazeTrace trace = read_all(
        htc_of(with(kBoth, {"gaze_origin_L.x(mm)", "gaze_origin_L.z(mm)", "helmet_pos_x"})));
    EXPECT_EQ(trace.samples[0].eyes[0].origin_m, glm::dvec3(0.0));
    EXPECT_TRUE(trace.report.worth_a_warning());
    EXPECT_THAT(told(trace, TraceFindingKind::NotRead),
                ElementsAre("1: the left eye's origin: not read, for want of the column "
                            "'gaze_origin_L.y(mm)'",
                            HasSubstr("the helmet's pose: not read, for want of the column "
                                      "'helmet_pos_y', 'helmet_pos_z', 'helmet_rot_x'")));
}

TEST(NeededColumns, TakeTheMillisecondsForATime) {
    std::vector<std::string> names = kBoth;
    names[0] = "time_stamp(ms)";
    const gaze::GazeTrace trace = read_all(htc_of(names));
    ASSERT_EQ(trace.samples.size(), 2U);
    EXPECT_EQ(trace.samples[1].sampled.ns, 1'000'000);
    // With both the finer one counts.
    EXPECT_EQ(read_all(htc_of(with(kBoth, {"time_stamp(ms)"}))).samples[1].sampled.ns, 10'000);
    names[0] = "time";
    EXPECT_THAT(refusal(htc_of(names)), HasSubstr("it lacks 'time(100ns)'"));
}

TEST(NeededColumns, OfOurOwnFormatAreFew) {
    const gaze::GazeTrace trace =
        read_all("t_device_ns,right_x,right_y,right_z,right_valid\n5,0,0,-1,1\n9,0,0,-1,1\n");
    ASSERT_EQ(trace.samples.size(), 2U);
    EXPECT_FALSE(trace.samples[0].eyes[0].valid);
    EXPECT_TRUE(trace.samples[0].eyes[1].valid);
    EXPECT_EQ(trace.samples[1].sequence, 1U);
    EXPECT_EQ(trace.samples[1].sampled.ns, 4);
    EXPECT_FALSE(trace.samples[1].arrived.known());
    EXPECT_FALSE(trace.samples[1].head.has_value());
    EXPECT_EQ(trace.report.lost_by_tracker, std::nullopt);
}

/// An eye of which one column is missing was recorded: that is no info.
TEST(NeededColumns, WarnOfAnEyeThatLacksOne) {
    for (const std::string lacking : {"gaze_direct_R.z", "eye_valid_R", "gaze_direct_R.x"}) {
        std::vector<std::string> names = kBoth;
        std::erase(names, lacking);
        const gaze::GazeTrace trace = read_all(htc_of(names));
        EXPECT_FALSE(trace.samples[0].eyes[1].valid);
        EXPECT_TRUE(trace.report.worth_a_warning()) << lacking;
        EXPECT_THAT(told(trace, TraceFindingKind::NotRead),
                    ElementsAre("1: no right eye, although other columns of it are there: it lacks "
                                "'" +
                                lacking + "'"));
    }
    EXPECT_TRUE(read_all(htc_of(with(kLeft, {"openness_R"}))).report.worth_a_warning());
    EXPECT_FALSE(read_all(htc_of(kLeft)).report.worth_a_warning()) << "one eye is all there is";
}

// ---- Bits ---------------------------------------------------------------------------------------

const std::vector<std::string> kAll = with(
    kBoth, {"openness_L", "gaze_origin_L.x(mm)", "gaze_origin_L.y(mm)", "gaze_origin_L.z(mm)"});

gaze::GazeTrace read_with_bits(const std::string& left) {
    return read_all(htc_of(kAll, {{"eye_valid_L", left}, {"gaze_origin_L.x(mm)", "35"}}));
}

TEST(ValidityBits, AreBelievedOneByOne) {
    for (int bits = 0; bits <= 31; ++bits) {
        const gaze::EyeRay ray = read_with_bits(std::to_string(bits)).samples[0].eyes[0];
        EXPECT_EQ(ray.valid, (bits & 2) != 0) << bits;
        EXPECT_DOUBLE_EQ(ray.origin_m.x, (bits & 1) != 0 ? -0.035 : 0.0) << bits;
        EXPECT_DOUBLE_EQ(ray.openness, (bits & 8) != 0 ? 0.5 : -1.0) << bits;
    }
}

TEST(ValidityBits, CountWhatTheyRefuse) {
    EXPECT_THAT(told(read_with_bits("27"), TraceFindingKind::RefusedByBit), IsEmpty())
        << "the pupil is of no use here";
    const gaze::GazeTrace trace = read_with_bits("4");
    EXPECT_THAT(told(trace, TraceFindingKind::RefusedByBit),
                ElementsAre("2: left eye: direction not vouched for in 2 rows (validity bit 1)",
                            "2: left eye: origin not vouched for in 2 rows (validity bit 0)",
                            "2: left eye: openness not vouched for in 2 rows (validity bit 3)"));
    EXPECT_EQ(trace.report.count(TraceFindingKind::RefusedByBit).rows, 6U);
    EXPECT_EQ(trace.report.rows_dropped(), 0U);
}

TEST(ValidityBits, RefuseNothingThatIsNotThere) {
    const gaze::GazeTrace trace = read_all(htc_of(kBoth, {{"eye_valid_R", "0"}}));
    EXPECT_THAT(told(trace, TraceFindingKind::RefusedByBit),
                ElementsAre("2: right eye: direction not vouched for in 2 rows (validity bit 1)"));
}

TEST(ValidityBits, AreNoNumberThatHasOthers) {
    for (const std::string bits : {"-1", "32", "63", "2.5", "x"}) {
        const gaze::GazeTrace trace = read_with_bits(bits);
        EXPECT_FALSE(trace.samples[0].eyes[0].valid) << bits;
        EXPECT_THAT(told(trace, TraceFindingKind::BadCells),
                    ElementsAre(fmt::format("2: left eye: column 'eye_valid_L': '{}' does not say "
                                            "whether the eye is valid (2 rows with such cells: "
                                            "the eye is invalid there)",
                                            bits)));
    }
}

TEST(ValidityBits, AreNamedWhereNoEyeIsValid) {
    EXPECT_EQ(refusal(htc_of(kBoth, {{"eye_valid_L", "25"}, {"eye_valid_R", "24"}})),
              "gaze.csv: no valid gaze in 2 rows; from line 2: left eye: direction not vouched for "
              "in 2 rows (validity bit 1); from line 2: right eye: direction not vouched for in 2 "
              "rows (validity bit 1): set the tracker up for these eyes, and record again");
}

TEST(ValidityBits, ThatAreWordsAreToBeMended) {
    const std::string said =
        refusal(htc_of(kBoth, {{"eye_valid_L", "True"}, {"eye_valid_R", "True"}}));
    EXPECT_THAT(said, HasSubstr("'True' does not say whether the eye is valid"));
    EXPECT_THAT(said, testing::HasSubstr(": mend these cells, or set"));
}

TEST(NeededColumns, SayWhatToDoAboutATimeOfDay) {
    EXPECT_THAT(refusal(htc_of(kBoth, {{"time(100ns)", "00:00:01.25"}})),
                HasSubstr("column 'time(100ns)': '00:00:01.25' is no whole number of 100 ns but a "
                          "time of day: write how long it is since the first row instead"));
}

}  // namespace
}  // namespace gazeloop::drivers
