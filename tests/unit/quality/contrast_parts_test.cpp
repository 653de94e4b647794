#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/picture/gaze_frame.h"
#include "runtime/quality/band_sensitivity.h"
#include "runtime/quality/contrast_levels.h"
#include "runtime/quality/convolution.h"
#include "runtime/quality/fast_exponent.h"
#include "runtime/quality/opponent_planes.h"
#include "runtime/quality/pyramid.h"
#include "runtime/quality/temporal_filter.h"
#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::flat_view;
using tests::looking;
using tests::made_picture;

const RowWork kWork(2);

TEST(RowWork, CoversEveryRowOnce) {
    for (const unsigned threads : {0U, 1U, 2U, 7U, 1000U}) {
        for (const std::uint32_t rows : {0U, 1U, 31U, 64U, 1001U}) {
            std::vector<int> visits(rows);
            RowWork(threads).over(rows, [&](std::uint32_t from, std::uint32_t to) {
                for (std::uint32_t row = from; row < to; ++row) {
                    ++visits[row];
                }
            });
            EXPECT_EQ(visits, std::vector<int>(rows, 1)) << threads << ' ' << rows;
        }
    }
}

TEST(FastExponent, IsAsExactAsItSays) {
    for (float x = 1e-37F; x < 1e38F; x *= 1.0173F) {
        EXPECT_NEAR(log2_of(x), std::log2(static_cast<double>(x)), 2e-5) << x;
    }
    for (float x = -126.0F; x < 126.0F; x += 0.0371F) {
        EXPECT_NEAR(static_cast<double>(exp2_of(x)) / std::exp2(static_cast<double>(x)), 1.0, 6e-6)
            << x;
    }
    EXPECT_LE(log2_of(0.0F), -126.0F);
    EXPECT_EQ(exp2_of(-1e9F), exp2_of(-126.0F));
    EXPECT_TRUE(std::isfinite(exp2_of(1e9F)));
}

TEST(Convolution, RepeatsWhatLiesAtTheEdges) {
    Plane plane(3, 2);
    plane.values = {1, 2, 4, 8, 16, 32};
    const Plane sum = convolved(plane, {1, 1, 1}, {0, 1, 10}, kWork);
    // Rows: 1+1+2, 1+2+4, 2+4+4; 8+8+16, ...; below the last row it goes on as that.
    const std::vector<float> expected{4 + 320, 7 + 560, 10 + 800, 32 * 11, 56 * 11, 80 * 11};
    EXPECT_EQ(sum.values, expected);
}

TEST(Pyramid, OfAConstantIsTheConstant) {
    for (const auto& [width, height] : {std::pair{1U, 1U}, {2U, 3U}, {17U, 5U}, {64U, 33U}}) {
        Plane plane(width, height);
        plane.values.assign(plane.values.size(), 3.25F);
        Plane next;
        reduce(plane, kWork, next);
        EXPECT_EQ(next.width, (width + 1) / 2);
        EXPECT_EQ(next.height, (height + 1) / 2);
        std::vector<float> scratch(next.width);
        std::vector<float> row(width);
        for (std::uint32_t y = 0; y < height; ++y) {
            expand_row(next, y, width, scratch.data(), row.data());
            for (const float value : row) {
                EXPECT_NEAR(value, 3.25F, 1e-5F);
            }
        }
    }
}

TEST(Pyramid, FollowsItsFilter) {
    // An impulse in the middle: the next level holds the filter's weights.
    Plane plane(9, 9);
    plane.row(4)[4] = 400.0F;
    Plane next;
    reduce(plane, kWork, next);
    EXPECT_NEAR(next.row(2)[2], 64.0F, 1e-4F);  // 8/20 each way
    EXPECT_NEAR(next.row(2)[1], 8.0F, 1e-4F);   // 8/20 and 1/20
    EXPECT_NEAR(next.row(1)[1], 1.0F, 1e-4F);
    Plane coarse(5, 5);
    coarse.row(2)[2] = 100.0F;
    std::vector<float> scratch(5);
    std::vector<float> row(9);
    expand_row(coarse, 4, 9, scratch.data(), row.data());
    const std::vector<float> even{0, 0, 8, 40, 64, 40, 8, 0, 0};
    expand_row(coarse, 3, 9, scratch.data(), row.data());
    const std::vector<float> odd{0, 0, 5, 25, 40, 25, 5, 0, 0};
    for (std::size_t x = 0; x < odd.size(); ++x) {
        EXPECT_NEAR(row[x], odd[x], 1e-4F);
    }
    expand_row(coarse, 4, 9, scratch.data(), row.data());
    for (std::size_t x = 0; x < even.size(); ++x) {
        EXPECT_NEAR(row[x], even[x], 1e-4F);
    }
}

TEST(OpponentPlanes, HaveLuminanceInCandelasAndNoColourInGreys) {
    std::array<Plane, 3> planes;
    opponent_planes(made_picture(4, 1,
                                 [](int x, int) {
                                     return x == 0   ? glm::vec3(1.0F)
                                            : x == 1 ? glm::vec3(0.25F)
                                            : x == 2 ? glm::vec3(1.0F, 0.0F, 0.0F)
                                                     : glm::vec3(-5.0F, 0.0F, 1.0F);
                                 }),
                    {.peak_cd_m2 = 200.0, .black_cd_m2 = 0.5}, kWork, planes);
    EXPECT_NEAR(planes[kLuminance].values[0], 200.5F, 1e-3F);
    EXPECT_NEAR(planes[kLuminance].values[1], 50.5F, 1e-3F);
    // Near Rec.709's .2126: the cones of CIE 2006 are others than those of 1931.
    EXPECT_NEAR(planes[kLuminance].values[2], 0.5F + 200.0F * 0.2126F, 200.0F * 0.012F);
    for (const std::size_t colour : {kRedGreen, kYellowViolet}) {
        EXPECT_NEAR(planes[colour].values[0], 0.0F, 1e-3F);
        EXPECT_NEAR(planes[colour].values[1], 0.0F, 1e-3F);
    }
    EXPECT_GT(planes[kRedGreen].values[2], 10.0F) << "red";
    EXPECT_LT(planes[kYellowViolet].values[2], -10.0F);
    EXPECT_GT(planes[kYellowViolet].values[3], 50.0F) << "blue; what is below 0 is cut";
}

// stelaCSF by hand, 4 cpd, 100 cd/m2, an area of pi: A_c = 270 / (1 + (4/.65)^2) = 6.9467;
// sqrt(A_c / (1 + A_c / pi)) 4 = 5.8836. Sustained: peak 44.4763 (1.00713964)^-.277857 = 44.3884,
// f_m = 1.55909 (2.03604)^-.251815 = 1.30351, (lg 3.06864)^2 / 2^.177674 = .236986 / 1.13106 =
// .209526, 10^-.209526 = .617269. Transient: 211.504 100^.411266 = 1405.6, (lg 3465.53)^2
// = 12.5289, / 2^2.52628 = 5.7606: 2.17493, 10^-2.17493 = .0066845.
TEST(BandSensitivity, OfLuminanceIsStelaCsf) {
    EXPECT_NEAR(foveal_sensitivity(Mechanism::Sustained, 4.0, 100.0), 44.3884 * 0.617269 * 5.8836,
                0.2);
    EXPECT_NEAR(foveal_sensitivity(Mechanism::Transient, 4.0, 100.0), 1405.6 * 0.0066845 * 5.8836,
                0.1);
}

// The cut-offs that its authors' parameters give at 100 cd/m2: sensitivity is 1 there.
TEST(BandSensitivity, FallsToOneAtTheKnownCutOffs) {
    for (const auto& [e_deg, cpd] : {std::pair{2.0, 28.8}, {5.0, 16.4}, {10.0, 9.5}, {20.0, 4.7}}) {
        const foveation::StelaDecay decay = sensitivity_decay(Mechanism::Sustained, 0.0);
        const auto at = [&, e = e_deg](double f) {
            return foveal_sensitivity(Mechanism::Sustained, f, 100.0) *
                   std::pow(10.0, -(decay.per_deg + decay.per_deg_cpd * f) * e);
        };
        EXPECT_GT(at(cpd - 0.1), 1.0) << e_deg;
        EXPECT_LT(at(cpd + 0.1), 1.0) << e_deg;
    }
}

// castleCSF by hand, 1 cpd, 100 cd/m2, an area of pi. Red-green: 681.434 1.380038^-.480386 =
// 583.75; (lg(1 / .0178364))^2 = 3.05864, / 2^2.42104 = 5.3555: .571121, 10^-.571121 = .268460;
// A_c = 2816.44 / (1 + (1 / .0711058)^2) = 14.1684, sqrt(A_c / (1 + A_c / pi)) = 1.60352.
TEST(BandSensitivity, OfColourIsCastleCsf) {
    EXPECT_NEAR(foveal_sensitivity(Mechanism::RedGreen, 1.0, 100.0), 583.75 * 0.268460 * 1.60352,
                0.5);
    // Colour is low-pass: below the table's first step it still rises or stays.
    for (const Mechanism colour : {Mechanism::RedGreen, Mechanism::YellowViolet}) {
        EXPECT_GT(foveal_sensitivity(colour, 0.5, 100.0), foveal_sensitivity(colour, 4.0, 100.0));
        EXPECT_GT(foveal_sensitivity(colour, 1.0, 100.0), foveal_sensitivity(colour, 1.0, 1.0));
    }
    // Red-green falls about twice as fast with eccentricity as luminance does at low frequencies.
    EXPECT_NEAR(sensitivity_decay(Mechanism::RedGreen, 0.0).per_deg /
                    sensitivity_decay(Mechanism::Sustained, 0.0).per_deg,
                2.1, 0.1);
}

TEST(SensitivityTable, IsTheFormula) {
    for (std::size_t m = 0; m < kMechanisms; ++m) {
        const auto mechanism = static_cast<Mechanism>(m);
        const SensitivityTable table(mechanism);
        for (double cpd = 0.26; cpd < 63.0; cpd *= 1.07) {
            for (double luminance = 2.1e-3; luminance < 8e3; luminance *= 1.37) {
                const float log2 = table.log2_at(static_cast<float>(std::log2(cpd)),
                                                 static_cast<float>(std::log2(luminance)));
                EXPECT_NEAR(std::exp2(static_cast<double>(log2)) /
                                foveal_sensitivity(mechanism, cpd, luminance),
                            1.0, 0.02)
                    << kMechanismNames[m] << ' ' << cpd << " cpd, " << luminance;
            }
        }
        // Beyond its ends, as at them.
        EXPECT_EQ(table.log2_at(-50.0F, 2.0F), table.log2_at(-2.0F, 2.0F));
        EXPECT_NEAR(table.log2_at(50.0F, 99.0F), table.log2_at(6.0F, 13.0F), 0.01);
        EXPECT_TRUE(std::isfinite(table.log2_at(1.0F, std::nanf(""))));
    }
}

TEST(ContrastLevels, KnowFrequencySolidAngleAndDecay) {
    const gaze::EyeView view = flat_view(200, 120, 45.0);
    ContrastLevels levels(view, gaze::Eye::Left, kWork);
    const glm::dvec3 gaze = looking(-12.0, 5.0);
    const auto field = foveation::GazeField::create(view, gaze).value();
    levels.look(field, kWork);
    ASSERT_GE(levels.levels().size(), 2U);
    for (std::size_t at = 0; at < levels.levels().size(); ++at) {
        const ContrastLevels::Level& level = levels.levels()[at];
        EXPECT_NEAR(std::accumulate(level.weight.values.begin(), level.weight.values.end(), 0.0),
                    1.0, 1e-4);
        const double step = std::exp2(static_cast<double>(at));
        for (std::uint32_t y = 0; y < level.height; y += 7) {
            for (std::uint32_t x = 0; x < level.width; x += 11) {
                const gaze::PixelPosition pixel{x * step + 0.5, y * step + 0.5};
                const double per_deg =
                    foveation::pixels_per_degree(view, gaze::unproject(pixel, view)).mean;
                const double cycles = at == 0 ? 0.3 : 0.2115;
                const double cpd = cycles * per_deg / step;
                const bool rest = at + 1 == levels.levels().size();
                EXPECT_NEAR(std::exp2(static_cast<double>(level.log2_cpd.row(y)[x])),
                            rest ? std::max(cpd, 0.5) : cpd, 1e-4 * cpd);
                const foveation::FieldPoint point = field.at(pixel);
                const double nasal = foveation::nasal_share(gaze::Eye::Left, point.direction_rad);
                for (std::size_t m = 0; m < kStillMechanisms; ++m) {
                    const auto decay = sensitivity_decay(static_cast<Mechanism>(m), nasal);
                    const double expected =
                        point.eccentricity_deg *
                        (decay.per_deg + decay.per_deg_cpd * (rest ? std::max(cpd, 0.5) : cpd)) *
                        std::numbers::ln10 / std::numbers::ln2;
                    EXPECT_NEAR(level.decay[m].row(y)[x], expected, 1e-3 + 1e-3 * expected)
                        << at << ' ' << x << ',' << y << ' ' << kMechanismNames[m];
                }
            }
        }
    }
}

TEST(ContrastLevels, TakeAnyPicture) {
    for (const auto& [width, height] :
         {std::pair{1U, 1U}, {1U, 300U}, {3U, 2U}, {511U, 1U}, {16384U, 1U}}) {
        const gaze::EyeView view{
            .fov = {-0.5, 0.5, 0.5, -0.5}, .width_px = width, .height_px = height};
        ContrastLevels levels(view, gaze::Eye::Right, kWork);
        EXPECT_GE(levels.bands(), 1U);
        EXPECT_LE(levels.bands(), 14U);
    }
}

// The claims of temporal_filter.h.
TEST(TemporalResponse, IsNearStelaCsfs) {
    const TemporalResponse response(6.05);
    EXPECT_NEAR(response.sustained(6.05), 0.5, 1e-9);
    EXPECT_EQ(response.sustained(0.0), 1.0);
    EXPECT_EQ(response.transient(0.0), 0.0);
    for (double hz = 0.0; hz <= 60.0; hz += 0.25) {
        EXPECT_NEAR(response.sustained(hz), foveation::stela_sustained_response(hz), 0.08) << hz;
        const double off = response.transient(hz) - foveation::stela_transient_response(hz);
        EXPECT_LT(off, 0.08) << hz;
        EXPECT_GT(off, hz < 3.0 ? -0.17 : -0.12) << hz;
    }
}

/// How strongly the filter passes a channel that oscillates about 1 by .5.
struct Passed {
    double sustained;
    double transient;
};
Passed passed(double hz, double frames_hz) {
    TemporalFilter filter{TemporalResponse(6.05)};
    Plane plane(1, 1);
    Plane change;
    std::complex<double> sustained;
    std::complex<double> transient;
    const int frames = static_cast<int>(std::lround(frames_hz * 4.0));
    for (int frame = 0; frame < 2 * frames; ++frame) {
        const double phase = 2.0 * std::numbers::pi * hz * frame / frames_hz;
        plane.values[0] = static_cast<float>(1.0 + 0.5 * std::cos(phase));
        filter.show(plane, 1.0 / frames_hz, kWork);
        filter.transient(kWork, change);
        if (frame >= frames) {  // settled
            const std::complex<double> wave = std::polar(4.0 / frames, -phase);
            sustained += wave * static_cast<double>(filter.sustained().values[0]);
            transient += wave * static_cast<double>(change.values[0]);
        }
    }
    return {std::abs(sustained), std::abs(transient)};
}

TEST(TemporalFilter, PassesWhatItsResponseSays) {
    const TemporalResponse response(6.05);
    for (const double hz : {1.0, 3.0, 5.0, 8.0, 15.0, 30.0}) {
        // At 1 kHz, a held frame is as good as a continuous signal.
        const Passed fine = passed(hz, 1000.0);
        EXPECT_NEAR(fine.sustained, response.sustained(hz), 0.005) << hz;
        EXPECT_NEAR(fine.transient, response.transient(hz), 0.005) << hz;
        // At 90 Hz the sampled end of each frame sees it a little weaker or stronger.
        const Passed coarse = passed(hz, 90.0);
        EXPECT_NEAR(coarse.sustained, response.sustained(hz), 0.05) << hz;
        EXPECT_NEAR(coarse.transient, response.transient(hz), 0.1) << hz;
    }
}

TEST(TemporalFilter, IsTheSameHoweverAHoldIsCut) {
    TemporalFilter once{TemporalResponse(6.05)};
    TemporalFilter often{TemporalResponse(6.05)};
    Plane dark(1, 1);
    Plane light(1, 1);
    light.values[0] = 100.0F;
    for (TemporalFilter* const filter : {&once, &often}) {
        filter->show(dark, 0.01, kWork);
    }
    once.show(light, 0.04, kWork);
    for (int part = 0; part < 4; ++part) {
        often.show(light, 0.01, kWork);
    }
    EXPECT_NEAR(once.sustained().values[0], often.sustained().values[0], 1e-3F);
    EXPECT_GT(once.sustained().values[0], 5.0F);
    EXPECT_LT(once.sustained().values[0], 95.0F);
    once.forget();
    once.show(light, 0.01, kWork);
    EXPECT_EQ(once.sustained().values[0], 100.0F);
}

}  // namespace
}  // namespace gazeloop::quality
