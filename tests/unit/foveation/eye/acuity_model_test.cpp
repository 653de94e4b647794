#include "runtime/foveation/eye/acuity_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/foveation/eye/geisler_perry_acuity.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/resolution_limit.h"
#include "runtime/foveation/eye/stela_acuity.h"

namespace gazeloop::foveation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Guenter, CutsOffAtTheInverseOfTheLine) {
    const auto model = GuenterAcuity::create({}).value();
    EXPECT_DOUBLE_EQ(model->cutoff_cpd(0.0, 0.0), 48.0);
    EXPECT_DOUBLE_EQ(model->cutoff_cpd(10.0, 1.0), 1.0 / (0.22 + 1.0 / 48.0));
    EXPECT_GT(model->cutoff_cpd(180.0, 0.0), 0.0);
}

TEST(Guenter, RefusesWithTheValueAndTheRange) {
    for (const double slope : {0.0, -0.022, kNan, kInfinity, 1.01, 1e-7}) {
        const auto model = GuenterAcuity::create({.slope = slope});
        ASSERT_FALSE(model.has_value()) << slope;
        EXPECT_EQ(model.error().kind, ErrorKind::Usage);
        EXPECT_THAT(model.error().message, testing::HasSubstr("must lie in [1e-06, 1]"));
        EXPECT_THAT(model.error().message, testing::HasSubstr("m = "));
    }
    for (const double omega0 : {0.0, -1.0, kNan, kInfinity}) {
        const auto model = GuenterAcuity::create({.omega0_deg = omega0});
        ASSERT_FALSE(model.has_value()) << omega0;
        EXPECT_THAT(model.error().message, testing::HasSubstr("omega0 = "));
    }
}

TEST(GeislerPerry, IsWhereFullContrastIsTheThreshold) {
    const GeislerPerryAcuity model;
    for (const double eccentricity : {0.0, 2.3, 20.0, 180.0}) {
        const double f = model.cutoff_cpd(eccentricity, 0.0);
        EXPECT_NEAR(std::exp(0.106 * f * (eccentricity + 2.3) / 2.3) / 64.0, 1.0, 1e-12);
    }
    EXPECT_NEAR(model.cutoff_cpd(0.0, 0.0), 39.23, 0.01);
}

TEST(ResolutionLimit, HasThePublishedPixelsPerDegree) {
    const ResolutionLimit model;
    EXPECT_DOUBLE_EQ(required_per_deg(model, 0.0, 0.0), 94.0);
    EXPECT_NEAR(required_per_deg(model, 20.0, 1.0), 94.0 / 2.3, 1e-12);
    EXPECT_GT(model.cutoff_cpd(180.0, 0.0), 0.0);
    // Nowhere does it ask for less than Guenter's line.
    const auto line = GuenterAcuity::create({}).value();
    for (double e = 0.5; e <= 180.0; e *= 1.3) {
        EXPECT_GT(model.cutoff_cpd(e, 0.0), line->cutoff_cpd(e, 0.0)) << e;
    }
}

TEST(StelaAcuity, HasTheReferenceCutOffs) {
    const auto model = StelaAcuity::create({}, StelaField::TemporalEverywhere).value();
    EXPECT_NEAR(model->cutoff_cpd(2.0, 0.0), 28.8, 0.1);
    EXPECT_NEAR(model->cutoff_cpd(5.0, 0.0), 16.4, 0.05);
    EXPECT_NEAR(model->cutoff_cpd(10.0, 0.0), 9.5, 0.05);
    EXPECT_NEAR(model->cutoff_cpd(20.0, 0.0), 4.7, 0.05);
    EXPECT_NEAR(model->cutoff_cpd(0.0, 0.0), 71.5, 0.05);
}

// Beyond that, not even the best grating is seen: a solver that starts from a least frequency
// returns that instead.
TEST(StelaAcuity, SeesNothingFarOut) {
    const auto model = StelaAcuity::create({}, StelaField::TemporalEverywhere).value();
    EXPECT_GT(model->cutoff_cpd(43.5, 0.0), 0.5);
    for (const double eccentricity : {43.7, 60.0, 180.0}) {
        EXPECT_EQ(model->cutoff_cpd(eccentricity, 0.0), 0.0) << eccentricity;
    }
}

TEST(StelaAcuity, CutOffIsTheLastFrequencyWithSensitivityOne) {
    for (const StelaConditions conditions :
         {StelaConditions{}, StelaConditions{.luminance_cd_m2 = 1e-3},
          StelaConditions{.luminance_cd_m2 = 1e4, .temporal_hz = 8.0, .area_deg2 = 0.01},
          StelaConditions{.temporal_hz = 40.0, .area_deg2 = 1e4}}) {
        const auto model = StelaAcuity::create(conditions, StelaField::Directional).value();
        for (const double nasal : {0.0, 0.3, 1.0}) {
            const StelaDecay decay = stela_decay(nasal);
            for (const double eccentricity : {0.0, 0.5, 3.0, 11.0, 29.0, 50.0, 90.0, 180.0}) {
                const auto sensitivity = [&](double f) {
                    return stela_foveal_sensitivity(f, conditions) *
                           std::pow(10.0, -(decay.per_deg + decay.per_deg_cpd * f) * eccentricity);
                };
                double expected = 0.0;  // by brute force
                for (double f = 256.0; f > 0.0157; f /= 1.0005) {
                    if (sensitivity(f) >= 1.0) {
                        expected = f;
                        break;
                    }
                }
                EXPECT_NEAR(model->cutoff_cpd(eccentricity, nasal), expected, 6e-4 * expected)
                    << conditions.luminance_cd_m2 << ' ' << nasal << ' ' << eccentricity;
            }
        }
    }
}

TEST(StelaAcuity, IsSharperTowardsTheNoseOnlyIfDirectional) {
    const auto directional = StelaAcuity::create({}, StelaField::Directional).value();
    const auto temporal = StelaAcuity::create({}, StelaField::TemporalEverywhere).value();
    EXPECT_NEAR(directional->cutoff_cpd(10.0, 1.0), 14.27, 0.02);
    EXPECT_EQ(temporal->cutoff_cpd(10.0, 1.0), temporal->cutoff_cpd(10.0, 0.0));
    EXPECT_EQ(directional->cutoff_cpd(10.0, 0.0), temporal->cutoff_cpd(10.0, 0.0));
}

TEST(StelaAcuity, RefusesWithTheValueAndTheRange) {
    using C = StelaConditions;
    for (const double bad : {kNan, kInfinity, -1.0}) {
        for (const C conditions :
             {C{.luminance_cd_m2 = bad}, C{.temporal_hz = bad}, C{.area_deg2 = bad}}) {
            const auto model = StelaAcuity::create(conditions, StelaField::Directional);
            ASSERT_FALSE(model.has_value());
            EXPECT_EQ(model.error().kind, ErrorKind::Usage);
            EXPECT_THAT(model.error().message, testing::HasSubstr("must lie in ["));
        }
    }
    EXPECT_FALSE(StelaAcuity::create({.luminance_cd_m2 = 0.0}, StelaField::Directional));
    EXPECT_FALSE(StelaAcuity::create({.area_deg2 = 0.0}, StelaField::Directional));
}

TEST(NasalShare, IsOneTowardsTheNoseAndNoneFromARightAngleOn) {
    constexpr double kPi = std::numbers::pi;
    using gaze::Eye;
    EXPECT_DOUBLE_EQ(nasal_share(Eye::Left, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(nasal_share(Eye::Right, kPi), 1.0);
    EXPECT_DOUBLE_EQ(nasal_share(Eye::Right, -kPi), 1.0);
    EXPECT_DOUBLE_EQ(nasal_share(Eye::Left, kPi), 0.0);
    EXPECT_NEAR(nasal_share(Eye::Left, kPi / 2), 0.0, 1e-12);
    EXPECT_NEAR(nasal_share(Eye::Left, -kPi / 4), 0.5, 1e-12);
    EXPECT_NEAR(nasal_share(Eye::Right, 3 * kPi / 4 + 2 * kPi), 0.5, 1e-12);
}

}  // namespace
}  // namespace gazeloop::foveation
