#include "runtime/foveation/plans/shading_rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "runtime/foveation/eye/guenter_acuity.h"
#include "tests/unit/foveation/picture/example_views.h"

namespace gazeloop::foveation {
namespace {

RingRates plan(const gaze::EyeView& view, const glm::dvec3& gaze, const RingParameters& rings) {
    return plan_rings(GazeField::create(view, gaze).value(), rings).value();
}

TEST(ShadingRings, CountEverySampleOnce) {
    const gaze::EyeView view = symmetrical_view(250, 133, 90, 60);  // no whole number of tiles
    for (const glm::dvec3& gaze : {kAhead, towards(20, 10), towards(100, 0)}) {
        const RingRates planned = plan(view, gaze, {8.0, 21.0, 16});
        EXPECT_EQ(planned.rows.size(), 9U);
        // By hand: each coarse pixel that has a pixel of the picture.
        std::uint64_t samples = 0;
        for (std::uint32_t y = 0; y < view.height_px; ++y) {
            for (std::uint32_t x = 0; x < view.width_px; ++x) {
                const std::uint32_t rate = 1U << planned.log2_rate(x, y);
                samples += x % rate == 0 && y % rate == 0 ? 1 : 0;
            }
        }
        EXPECT_EQ(planned.samples(), samples);
    }
}

// Rates go by the true angle of the nearest point, so that no pixel gets less than it should.
TEST(ShadingRings, NoPixelGetsLessThanItsEccentricityAsksFor) {
    for (const glm::dvec3& gaze : {kAhead, towards(30, 0), towards(-40, 35), towards(60, 0)}) {
        const GazeField field = GazeField::create(fove_view(), gaze).value();
        const RingParameters rings{10.0, 25.0, 32};
        const RingRates planned = plan_rings(field, rings).value();
        for (std::uint32_t y = 0; y < 1440; y += 3) {
            for (std::uint32_t x = 0; x < 1280; x += 3) {
                const double e = field.at(gaze::PixelPosition{x + 0.5, y + 0.5}).eccentricity_deg;
                const unsigned most = e <= rings.inner_deg ? 0 : e <= rings.outer_deg ? 1 : 2;
                ASSERT_LE(planned.log2_rate(x, y), most);
            }
        }
    }
}

TEST(ShadingRings, SufficientOnesFollowTheLine) {
    const auto line = GuenterAcuity::create({}).value();
    const RingParameters rings = sufficient_rings(fove_view(), *line, 0.0, 16);
    // omega(e) = 2 x 2/p and 4 x 2/p, p = 9.37 pixels a degree.
    EXPECT_NEAR(rings.inner_deg, (4.0 / 9.3731 - 1.0 / 48.0) / 0.022, 0.01);
    EXPECT_NEAR(rings.outer_deg, (8.0 / 9.3731 - 1.0 / 48.0) / 0.022, 0.01);
    // Fifteen times finer than the fovea: coarsest everywhere.
    EXPECT_EQ(sufficient_rings(symmetrical_view(16384, 16384, 10, 10), *line, 0.0, 16).outer_deg,
              0.0);
}

TEST(ShadingRings, Extremes) {
    EXPECT_EQ(plan(symmetrical_view(1, 1, 100, 100), kAhead, {0, 0, 16}).samples(), 1U);
    EXPECT_EQ(plan(fove_view(), kAhead, {180, 180, 16}).samples(), 1280U * 1440U);
    const RingRates coarse = plan(fove_view(), towards(180, 0), {0, 0, 64});
    EXPECT_EQ(coarse.samples(), 1280U * 1440U / 16U);
    EXPECT_GT(plan(symmetrical_view(16384, 16384, 170, 170), kAhead, {5, 20, 64}).samples(),
              16384ULL * 16384 / 16);
}

TEST(ShadingRings, RefuseWithTheValueAndTheRange) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto message = [](const RingParameters& rings) {
        const auto planned = plan_rings(GazeField::create(fove_view(), kAhead).value(), rings);
        EXPECT_FALSE(planned.has_value());
        return planned ? std::string() : planned.error().message;
    };
    using testing::HasSubstr;
    EXPECT_THAT(message({kNan, 20, 16}), HasSubstr("rings.inner_deg = nan: must lie in [0, 180]"));
    EXPECT_THAT(message({-1, 20, 16}), HasSubstr("rings.inner_deg = -1"));
    EXPECT_THAT(message({10, 9, 16}), HasSubstr("rings.outer_deg = 9"));
    EXPECT_THAT(message({10, kNan, 16}), HasSubstr("rings.outer_deg = nan"));
    EXPECT_THAT(message({10, 181, 16}), HasSubstr("[10, 180]"));
    for (const std::uint32_t tile : {0U, 2U, 18U, 68U, 4294967292U}) {
        EXPECT_THAT(message({10, 20, tile}), HasSubstr("multiple of 4 in [4, 64]")) << tile;
    }
}

}  // namespace
}  // namespace gazeloop::foveation
