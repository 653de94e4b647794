#include "drivers/trace/axes_correction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "runtime/gaze/anatomy.h"
#include "tests/unit/drivers/trace/built_traces.h"
#include "tests/unit/drivers/trace/trace_findings.h"
#include "tests/unit/drivers/trace/trace_text.h"
#include "tests/unit/gaze/pair_of_eyes.h"

namespace gazeloop::drivers {
namespace {

using gaze::AnatomyVerdict;
using gaze::EyeRay;
using gaze::GazeSample;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The same of a trace in memory.
Expected<void> hold_against_anatomy(gaze::GazeTrace& trace, AxesCorrection correction,
                                    bool accept_repairs = false) {
    BuiltTrace built = built_of(trace);
    Expected<void> held = drivers::hold_against_anatomy(built, correction, accept_repairs);
    trace = all_of(built);
    return held;
}

struct Wrong {
    const char* name;
    void (*made)(EyeRay& left, EyeRay& right);
    AxesCorrection right;  ///< that makes it agree again
    std::vector<const char*> offered;
};

void PrintTo(const Wrong& at, std::ostream* out) { *out << at.name; }

void mirror_directions(EyeRay& left, EyeRay& right) {
    left.direction.x *= -1.0;
    right.direction.x *= -1.0;
}
void mirror_places(EyeRay& left, EyeRay& right) {
    left.origin_m.x *= -1.0;
    right.origin_m.x *= -1.0;
}
void mirror_all(EyeRay& left, EyeRay& right) {
    mirror_directions(left, right);
    mirror_places(left, right);
}
void put_behind(EyeRay& left, EyeRay& right) {
    left.direction.z *= -1.0;
    right.direction.z *= -1.0;
}

class CorrectAxes : public testing::TestWithParam<Wrong> {
  protected:
    gaze::GazeTrace wrong_{.file = "gaze.csv",
                           .samples = gaze::changed(gaze::pair_of_eyes(), GetParam().made)};
};

TEST_P(CorrectAxes, GivesBackWhatWasRight) {
    gaze::GazeTrace trace = wrong_;
    correct_axes(trace.samples, GetParam().right);
    const auto expected = gaze::pair_of_eyes();
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (const std::size_t e : {0U, 1U}) {
            EXPECT_EQ(trace.samples[i].eyes[e].direction, expected[i].eyes[e].direction);
            EXPECT_EQ(trace.samples[i].eyes[e].origin_m, expected[i].eyes[e].origin_m);
        }
    }
}

TEST_P(CorrectAxes, IsOfferedAndNothingIsDoneUnasked) {
    gaze::GazeTrace trace = wrong_;
    const Expected<void> held = hold_against_anatomy(trace, AxesCorrection::None);
    const std::string said = held ? trace.report.findings().at(0).text : held.error().message;
    for (const AxesCorrection correction : {AxesCorrection::MirrorX, AxesCorrection::SwapEyes,
                                            AxesCorrection::MirrorZ, AxesCorrection::MirrorXZ}) {
        const std::string name =
            fmt::format("--axes {} ", kAxesCorrectionNames[static_cast<std::size_t>(correction)]);
        const bool expected =
            std::ranges::any_of(GetParam().offered, [&](const char* one) { return name == one; });
        EXPECT_EQ(said.find(name) != std::string::npos, expected) << name << "in: " << said;
    }
    EXPECT_EQ(trace.samples[7].eyes[0].direction, wrong_.samples[7].eyes[0].direction);
}

TEST_P(CorrectAxes, MakesItAgreeAndIsSaid) {
    gaze::GazeTrace trace = wrong_;
    ASSERT_TRUE(hold_against_anatomy(trace, GetParam().right));
    EXPECT_THAT(trace.report.axes,
                AllOf(HasSubstr("corrected by --axes"), HasSubstr("agree with anatomy")));
    EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::Axes).rows, trace.samples.size());
    EXPECT_TRUE(trace.report.worth_a_warning());
}

INSTANTIATE_TEST_SUITE_P(
    Axes, CorrectAxes,
    testing::Values(
        Wrong{"directions", mirror_directions, AxesCorrection::MirrorX, {"--axes -x "}},
        Wrong{"places", mirror_places, AxesCorrection::MirrorX, {"--axes -x "}},
        Wrong{"all", mirror_all, AxesCorrection::MirrorX, {"--axes -x ", "--axes swap-eyes "}},
        Wrong{"eyes",
              [](EyeRay& left, EyeRay& right) { std::swap(left, right); },
              AxesCorrection::SwapEyes,
              {"--axes -x ", "--axes swap-eyes "}},
        Wrong{"behind", put_behind, AxesCorrection::MirrorZ, {"--axes -z "}},
        Wrong{"half_a_turn",
              [](EyeRay& left, EyeRay& right) {
                  put_behind(left, right);
                  mirror_all(left, right);
              },
              AxesCorrection::MirrorXZ,
              {"--axes -x-z "}}),
    [](const auto& at) { return std::string(at.param.name); });

TEST(HoldAgainstAnatomy, LeavesWhatAgreesAlone) {
    gaze::GazeTrace trace{.samples = gaze::pair_of_eyes()};
    ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::None));
    EXPECT_THAT(trace.report.axes, HasSubstr("agree with anatomy"));
    EXPECT_TRUE(trace.report.findings().empty());
}

TEST(HoldAgainstAnatomy, RefusesGazeBehindTheHeadWithTheRemedy) {
    gaze::GazeTrace trace{.file = "gaze.csv",
                          .samples = gaze::changed(gaze::pair_of_eyes(), put_behind)};
    const Expected<void> held = hold_against_anatomy(trace, AxesCorrection::None);
    ASSERT_FALSE(held);
    EXPECT_EQ(held.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(held.error().message,
              "gaze.csv: 100 % of the gaze points behind the head (+Z); --axes -z makes it agree");
}

/// No eye looks there: whatever says so in a row is no gaze.
TEST(HoldAgainstAnatomy, TakesEachLookBehindTheHeadForNone) {
    for (const std::size_t count : {1U, 10U, 40U}) {
        gaze::GazeTrace trace{.file = "gaze.csv", .samples = gaze::pair_of_eyes()};
        trace.report.rows = trace.samples.size();
        trace.report.valid = {400, 400};
        for (std::size_t i = 100; i < 100 + count; ++i) {
            put_behind(trace.samples[i].eyes[0], trace.samples[i].eyes[1]);
        }
        ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::None));
        for (std::size_t i = 0; i < trace.samples.size(); ++i) {
            const bool ahead = i < 100 || i >= 100 + count;
            EXPECT_EQ(trace.samples[i].eyes[0].valid, ahead) << i;
            EXPECT_EQ(trace.samples[i].eyes[1].valid, ahead) << i;
        }
        EXPECT_EQ(trace.report.valid[0], 400 - count);
        EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::BehindHead).rows, count);
        EXPECT_EQ(trace.report.findings().at(0).line, 102U);
        EXPECT_THAT(trace.report.findings()[0].text,
                    HasSubstr("gaze points behind the head (+Z): left eye in"));
        EXPECT_EQ(trace.report.worth_a_warning(), count > 4) << "1 % of the rows";
        EXPECT_THAT(trace.report.axes, HasSubstr("agree with anatomy"));
    }
}

TEST(HoldAgainstAnatomy, KeepsTheOtherEyeOfARow) {
    gaze::GazeTrace trace{.samples = gaze::changed(gaze::pair_of_eyes(), [](EyeRay& left, EyeRay&) {
                              left.direction.z *= -1.0;
                          })};
    ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::None));
    for (const GazeSample& sample : trace.samples) {
        EXPECT_FALSE(sample.eyes[0].valid);
        EXPECT_TRUE(sample.eyes[1].valid);
    }
    EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::BehindHead).rows, 400U);
}

TEST(HoldAgainstAnatomy, RefusesWhereATenthOfTheGazeIsBehindTheHead) {
    const auto held = [](std::size_t behind, bool accept) {
        gaze::GazeTrace trace{.file = "gaze.csv", .samples = gaze::pair_of_eyes()};
        for (std::size_t i = 400 - behind; i < 400; ++i) {
            put_behind(trace.samples[i].eyes[0], trace.samples[i].eyes[1]);
        }
        const Expected<void> result = hold_against_anatomy(trace, AxesCorrection::None, accept);
        return result ? std::string{} : result.error().message;
    };
    EXPECT_EQ(held(40, false), "");
    EXPECT_THAT(held(41, false), HasSubstr("gaze.csv:361: in 41 of 400 rows gaze points behind the "
                                           "head (+Z), the first of them here; "));
    EXPECT_EQ(held(41, true), "");
    EXPECT_EQ(held(199, true), "");
    EXPECT_THAT(held(200, true), HasSubstr("50 % of the gaze points behind the head"));
    EXPECT_THAT(held(200, false), HasSubstr("50 % of the gaze points behind the head"));
}

/// Where one eye is all there is, left and right cannot be told.
TEST(HoldAgainstAnatomy, OffersBothTurnsForOneEyeBehind) {
    gaze::GazeTrace trace{.samples =
                              gaze::changed(gaze::pair_of_eyes(), [](EyeRay& left, EyeRay& right) {
                                  put_behind(left, right);
                                  right.valid = false;
                              })};
    const Expected<void> held = hold_against_anatomy(trace, AxesCorrection::None);
    ASSERT_FALSE(held);
    EXPECT_THAT(held.error().message,
                AllOf(HasSubstr("--axes -z if"), HasSubstr("--axes -x-z if")));
}

TEST(HoldAgainstAnatomy, SaysWhenACorrectionIsOneTooMany) {
    gaze::GazeTrace trace{.samples = gaze::pair_of_eyes()};
    ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::MirrorX));
    EXPECT_THAT(trace.report.findings().at(0).text,
                AllOf(HasSubstr("corrected by --axes -x: the eyes' rays diverge"),
                      HasSubstr("look at the trace without it")));
}

TEST(HoldAgainstAnatomy, OffersNothingForOneMirroredEye) {
    gaze::GazeTrace trace{
        .samples = gaze::changed(gaze::pair_of_eyes(2.4, 400, 0.0),
                                 [](EyeRay&, EyeRay& right) { right.direction.x *= -1.0; })};
    ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::None));
    EXPECT_THAT(trace.report.findings().at(0).text,
                AllOf(HasSubstr("one of them is mirrored"), HasSubstr("no --axes mends it")));
}

/// 40 rows of the same directions.
std::string htc_file(std::string_view left, std::string_view right) {
    std::string text = std::string(kHtcHeader) + "\n";
    for (int i = 0; i < 40; ++i) {
        text += htc_row(638'500'000'000'000'000 + i * 83'333LL, left, right);
    }
    return text;
}

TEST(ReadTrace, HoldsItsDirectionsAgainstAnatomy) {
    const auto right = read_text(htc_file("-0.02;0;1", "0.02;0;1"));
    ASSERT_TRUE(right);
    EXPECT_THAT(right->report.axes, HasSubstr("agree with anatomy"));
    const auto mirrored = read_text(htc_file("0.02;0;1", "-0.02;0;1"));
    ASSERT_TRUE(mirrored);
    EXPECT_THAT(mirrored->report.axes, HasSubstr("diverge (median -2.3 deg)"));
    const auto behind = read_text(htc_file("-0.02;0;-1", "0.02;0;-1"));
    ASSERT_FALSE(behind);
    EXPECT_THAT(behind.error().message,
                AllOf(HasSubstr("gaze.csv: 100 %"), HasSubstr("--axes -z")));
}

TEST(ReadTrace, NamesTheLineOfGazeBehindTheHead) {
    std::string text = std::string(kHtcHeader) + "\n";
    for (int i = 0; i < 400; ++i) {
        const bool behind = i >= 50 && i < 60;
        text += htc_row(638'500'000'000'000'000 + i * 83'333LL, behind ? "-0.02;0;-1" : "-0.02;0;1",
                        behind ? "0.02;0;-1" : "0.02;0;1");
    }
    const auto trace = read_text(text);
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_FALSE(trace->samples[55].eyes[0].valid);
    EXPECT_EQ(trace->report.count(gaze::TraceFindingKind::BehindHead).rows, 10U);
    EXPECT_THAT(told(*trace, gaze::TraceFindingKind::BehindHead),
                testing::ElementsAre(HasSubstr("52: gaze points behind the head")));
    EXPECT_EQ(trace->report.valid[0], 390U);
}

TEST(ReadTrace, TurnsDirectionsOnRequest) {
    std::istringstream in(htc_file("-0.02;0;-1", "0.02;0;-1"));
    const auto trace = read_trace(in, "gaze.csv", {.axes = AxesCorrection::MirrorZ});
    ASSERT_TRUE(trace);
    EXPECT_LT(trace->samples[0].eyes[0].direction.z, 0.0);
    EXPECT_THAT(trace->report.axes, HasSubstr("agree"));
}

TEST(AxesCorrection, HasANameEach) {
    for (std::size_t i = 0; i < kAxesCorrectionNames.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(axes_correction_named(kAxesCorrectionNames[i])), i);
    }
}

TEST(HoldAgainstAnatomy, SaysThatOriginsAreInAnotherUnit) {
    const auto told_of = [](double factor) {
        gaze::GazeTrace trace;
        trace.samples = gaze::changed(gaze::pair_of_eyes(), [&](EyeRay& left, EyeRay& right) {
            left.origin_m *= factor;
            right.origin_m *= factor;
        });
        EXPECT_TRUE(hold_against_anatomy(trace, AxesCorrection::None).has_value());
        return trace.report.findings().empty() ? std::string{}
                                               : trace.report.findings().front().text;
    };
    EXPECT_EQ(told_of(1.0), "");
    EXPECT_EQ(told_of(0.0), "");  // places are not known
    EXPECT_THAT(told_of(1e3), HasSubstr("origins look like millimetres, the eyes would be 64 m"));
    EXPECT_THAT(told_of(1e2), HasSubstr("origins look like centimetres"));
    EXPECT_THAT(told_of(1.5), HasSubstr("origins are 96 mm apart, eyes are 45 to 80 mm"));
}

TEST(HoldAgainstAnatomy, SaysWhereAPartIsMirrored) {
    for (const std::size_t mirrored : {0U, 80U, 160U}) {
        gaze::GazeTrace trace;
        trace.samples = gaze::pair_of_eyes();
        for (std::size_t i = 200; i < 200 + mirrored; ++i) {
            mirror_directions(trace.samples[i].eyes[0], trace.samples[i].eyes[1]);
        }
        ASSERT_TRUE(hold_against_anatomy(trace, AxesCorrection::None).has_value());
        EXPECT_EQ(trace.report.worth_a_warning(), mirrored > 0) << mirrored;
        if (mirrored > 0) {
            ASSERT_EQ(trace.report.findings().size(), 1U);
            EXPECT_THAT(trace.report.findings()[0].text,
                        HasSubstr(fmt::format("diverge in {} of its 10 parts, the first from 1.7 s "
                                              "on",
                                              mirrored / 40)));
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
