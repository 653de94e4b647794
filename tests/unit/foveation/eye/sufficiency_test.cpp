#include "runtime/foveation/eye/sufficiency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/stela_acuity.h"
#include "runtime/foveation/plans/kfr_density.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "tests/unit/foveation/picture/example_views.h"

namespace gazeloop::foveation {
namespace {

class SquareGrid final : public OfferedDensity {
  public:
    explicit SquareGrid(double per_deg) : per_deg_(per_deg) {}
    [[nodiscard]] SampleGrid at(const FieldPoint& /*at*/) const override {
        return SampleGrid::square(per_deg_);
    }

  private:
    double per_deg_;
};

TEST(SampleGrid, WorstDensityIsTheShortestReciprocalVector) {
    EXPECT_DOUBLE_EQ(SampleGrid::square(3.0).worst_density(), 3.0);
    EXPECT_DOUBLE_EQ((SampleGrid{{5.0, 0.0}, {0.0, 2.0}}).worst_density(), 2.0);
    // A hexagonal grid: three equal shortest vectors.
    EXPECT_NEAR((SampleGrid{{1.0, 0.0}, {0.5, std::sqrt(0.75)}}).worst_density(), 1.0, 1e-15);
    // A sheared basis of the square grid is still the square grid.
    EXPECT_NEAR((SampleGrid{{1.0, 0.0}, {1000.0, 1.0}}).worst_density(), 1.0, 1e-9);
    EXPECT_EQ(SampleGrid{}.worst_density(), 0.0);
    EXPECT_EQ((SampleGrid{{0.0, 0.0}, {7.0, 1.0}}).worst_density(), 0.0);
}

TEST(SampleGrid, WorstDensityIsThatOfBruteForce) {
    for (int seed = 0; seed < 200; ++seed) {
        const SampleGrid grid{{std::sin(seed * 1.7) * 4, std::cos(seed * 2.3)},
                              {std::sin(seed * 0.9 + 1) * 2, std::cos(seed * 3.1) * 9}};
        double brute = std::numeric_limits<double>::infinity();
        for (int a = -60; a <= 60; ++a) {
            for (int b = -60; b <= 60; ++b) {
                if (a != 0 || b != 0) {
                    const glm::dvec2 v = double(a) * grid.first + double(b) * grid.second;
                    brute = std::min(brute, std::hypot(v.x, v.y));
                }
            }
        }
        const double cell = grid.first.x * grid.second.y - grid.first.y * grid.second.x;
        if (std::abs(cell) > 0.5) {  // else the shortest may need larger factors
            EXPECT_NEAR(grid.worst_density(), brute, 1e-12) << seed;
        }
    }
}

// The reference's ratios of KFR to the line m = .022: FOVE eye (square pixels, 100 degrees across),
// sigma 1.8, alpha 4, no disc. Within 8.75 degrees the display and not the line is the limit.
TEST(KfrDensity, HasTheReferenceRatios) {
    const GazeField field = GazeField::create(square_pixel_view(1280, 1440, 100.0), kAhead).value();
    const KfrParameters parameters{};
    const LpSize lp = lp_buffer_size(parameters, {1280, 1440}).value();
    const LogPolarMap map(parameters.kernel, {1280, 1440}, field.fovea());
    const KfrDensity density(map, lp, field.fovea(), 0.0);
    const MarLine line;
    struct Expected {
        double eccentricity_deg;
        double ratio;
    };
    for (const auto& [e, ratio] :
         {Expected{.2, .17}, Expected{.5, 1.0}, Expected{1, 1.5}, Expected{5, 1.6},
          Expected{10, 1.5}, Expected{20, 1.5}, Expected{30, 1.5}, Expected{49.9, 1.6}}) {
        const FieldPoint at = field.at(e, 0.0).value();
        const double required =
            std::min(2.0 / line.omega_deg(e), FullDensity().at(at).worst_density());
        EXPECT_NEAR(density.at(at).worst_density() / required, ratio, 0.05) << e;
    }
    EXPECT_EQ(density.at(*field.at(0.05, 1.0)).worst_density(), 0.0);  // the hole, r < 1 px
}

TEST(Sufficiency, OfTheFullPictureIsExactlyOneWhereTheDisplayIsTheLimit) {
    const auto model = GuenterAcuity::create({}).value();
    for (const glm::dvec3& gaze : {kAhead, towards(30, -20), towards(80, 0)}) {
        const GazeField field = GazeField::create(square_2160_view(), gaze).value();
        const Sufficiency full = check_sufficiency(field, FullDensity(), *model, gaze::Eye::Left);
        EXPECT_TRUE(full.sufficient());
        EXPECT_GE(full.least_ratio, 1.0);
        if (gaze.x < 0.9) {
            EXPECT_EQ(full.least_ratio, 1.0);
        }
    }
}

TEST(Sufficiency, FindsTheWorstPlace) {
    const auto model = GuenterAcuity::create({}).value();
    const GazeField field = GazeField::create(retinal_view(), kAhead).value();
    // Ten samples a degree are too few where the line asks for more, worst at the gaze: 60 pixels.
    const Sufficiency sparse = check_sufficiency(field, SquareGrid(10.0), *model, gaze::Eye::Left);
    EXPECT_NEAR(sparse.least_ratio, 10.0 / 60.0, 0.001);
    EXPECT_LT(sparse.worst.eccentricity_deg, 0.6);
    EXPECT_FALSE(sparse.sufficient());
    const Sufficiency none = check_sufficiency(field, SquareGrid(0.0), *model, gaze::Eye::Left);
    EXPECT_EQ(none.least_ratio, 0.0);
}

TEST(Sufficiency, NothingAskedIsAlwaysEnough) {
    const auto stela = StelaAcuity::create({}, StelaField::TemporalEverywhere).value();
    const GazeField behind = GazeField::create(fove_view(), towards(180, 0)).value();
    const Sufficiency result = check_sufficiency(behind, SquareGrid(1.0), *stela, gaze::Eye::Left);
    EXPECT_TRUE(std::isinf(result.least_ratio));
    EXPECT_TRUE(result.sufficient());
}

TEST(Sufficiency, OfLayersAndRingsHoldsForEveryGaze) {
    const MarLine line;
    const auto model = GuenterAcuity::create(line).value();
    for (const gaze::EyeView& view : {fove_view(), square_2160_view(), xr4_view()}) {
        for (const glm::dvec3& gaze : {kAhead, towards(25, 10), towards(-45, -45)}) {
            const GazeField field = GazeField::create(view, gaze).value();
            for (const int layers : {2, 3, 4}) {
                const LayerDensity density(
                    plan_layers(field, line, {.layers = layers, .weights = {}}).value());
                const Sufficiency result =
                    check_sufficiency(field, density, *model, gaze::Eye::Left);
                EXPECT_TRUE(result.sufficient()) << layers << ' ' << result.least_ratio << " at "
                                                 << result.worst.eccentricity_deg;
            }
            const RingDensity rings(
                plan_rings(field, sufficient_rings(view, *model, 0.0, 16)).value());
            const Sufficiency result = check_sufficiency(field, rings, *model, gaze::Eye::Left);
            EXPECT_TRUE(result.sufficient()) << result.least_ratio;
        }
    }
}

// The published map is one in pixels, so that what it offers depends on where the gaze is; a coarse
// one shows it.
TEST(Sufficiency, OfKfrChangesWithTheGaze) {
    const auto model = GuenterAcuity::create({}).value();
    const ImageSize image{2160, 2160};
    const auto least = [&](double sigma, const glm::dvec3& gaze) {
        const KfrParameters parameters{.sigma = sigma, .kernel = {}};
        const LpSize lp = lp_buffer_size(parameters, image).value();
        const GazeField field = GazeField::create(square_2160_view(), gaze).value();
        LogPolarPlan plan;
        plan_kfr(parameters, lp, image, field.fovea(), plan);
        const LogPolarMap map(parameters.kernel, image, field.fovea());
        return check_sufficiency(
                   field,
                   KfrDensity(map, lp, field.fovea(), plan.disc_radius_px - plan.disc_border_px),
                   *model, gaze::Eye::Left)
            .least_ratio;
    };
    EXPECT_EQ(least(1.8, kAhead), 1.0);  // in the disc: a pixel is a pixel
    EXPECT_LT(least(4.5, kAhead), 0.9);
    EXPECT_GT(std::abs(least(4.5, towards(35, 0)) - least(4.5, kAhead)), 0.03)
        << least(4.5, towards(35, 0)) << ' ' << least(4.5, kAhead);
}

TEST(DensityProfile, OfTheFullPictureIsTheDisplays) {
    const GazeField field = GazeField::create(square_2160_view(), kAhead).value();
    const auto profile = density_profile(field, FullDensity(), 0.1, 50);
    ASSERT_FALSE(profile.empty());
    EXPECT_NEAR(profile.front().per_deg, 15.82, 0.01);
    EXPECT_NEAR(profile.front().eccentricity_deg, 0.1, 1e-12);
    for (std::size_t i = 1; i < profile.size(); ++i) {
        EXPECT_GT(profile[i].eccentricity_deg, profile[i - 1].eccentricity_deg);
    }
}

}  // namespace
}  // namespace gazeloop::foveation
