// The loop plans each frame in memory that the first plan takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/full_plan.h"
#include "runtime/foveation/plans/interleaved_plan.h"
#include "runtime/foveation/plans/kfr3d_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/foveation/plans/layered_plan.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/foveation/plans/sparse_plan.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 721;  // no whole number of bands or tiles

/// A gaze in tests::square_view, by its tangents to the right and down.
gaze::FoveaPoint looking(double right, double down) {
    gaze::FoveaPoint fovea;
    fovea.position = {0.5 * (right + 1.0) * kWidth, 0.5 * (down + 1.0) * kHeight};
    fovea.direction = glm::normalize(glm::dvec3{right, -down, -1.0});
    return fovea;
}

/// Plans once where least is needed, then everywhere on and off the screen.
void expect_memory_of_the_first_plan(MethodPlan& method, const HiddenArea* hidden) {
    const gaze::EyeView view = tests::square_view(kWidth, kHeight);
    const gaze::StereoView views{view, view};
    value_or_throw(method.prepare(views));
    EyePlan plan;
    method.plan(gaze::Eye::Left, view, looking(60.0, 60.0), hidden, {}, plan);
    const std::size_t first = tests::allocations_of_this_thread();
    std::uint64_t most = 0;
    for (int x = -6; x <= 6; ++x) {
        for (int y = -6; y <= 6; ++y) {
            method.plan(gaze::Eye::Left, view, looking(0.25 * x, 0.25 * y), hidden, {}, plan);
            most = std::max(most, plan.grids[0].counts.shaded);
        }
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), first);
    EXPECT_GT(most, 0U);
}

void expect_memory_of_the_first_plan(MethodPlan& method) {
    const HiddenArea hidden(tests::cut_corners(0.2), tests::square_view(kWidth, kHeight));
    expect_memory_of_the_first_plan(method, nullptr);
    expect_memory_of_the_first_plan(method, &hidden);
}

TEST(PlanMemory, OfFullDoesNotGrowWithTheGaze) {
    FullPlan method;
    expect_memory_of_the_first_plan(method);
}

TEST(PlanMemory, OfKfrDoesNotGrowWithTheGaze) {
    for (const bool disc : {true, false}) {
        KfrPlan method({.disc = disc, .close_hole = true});
        expect_memory_of_the_first_plan(method);
    }
}

TEST(PlanMemory, OfTexelsThatTakeTurnsDoesNotGrowWithTheGaze) {
    for (const std::uint32_t every : {1U, 8U}) {
        InterleavedPlan method(std::make_unique<KfrPlan>(KfrParameters{.aspect = 0.35}), {every},
                               {every});
        expect_memory_of_the_first_plan(method);
    }
}

TEST(PlanMemory, Of3dKfrDoesNotGrowWithTheGaze) {
    for (const double aperture_m : {0.01, 1.0}) {
        Kfr3dPlan method({.kfr = {}, .regions = 4}, {.cameras = {.columns = 25, .rows = 25},
                                                     .lens = {.aperture_m = aperture_m}});
        expect_memory_of_the_first_plan(method);
    }
}

TEST(PlanMemory, OfTheAcuityMapDoesNotGrowWithTheGaze) {
    for (const bool disc : {true, false}) {
        AcuityPlan method({.disc = disc});
        expect_memory_of_the_first_plan(method);
    }
}

TEST(PlanMemory, OfRingsDoesNotGrowWithTheGaze) {
    RingsPlan method([](const gaze::EyeView&) { return RingParameters{8.0, 20.0, 16}; });
    expect_memory_of_the_first_plan(method);
}

TEST(PlanMemory, OfSparseSamplesDoesNotGrowWithTheGaze) {
    for (const bool turn : {false, true}) {
        SparsePlan method({.pattern = {.share = 0.02}, .neighbours = 1, .turn = turn});
        expect_memory_of_the_first_plan(method);
    }
}

TEST(PlanMemory, OfLayersDoesNotGrowWithTheGaze) {
    for (const bool half_rate : {false, true}) {
        LayeredPlan method({.half_rate = half_rate}, [](const gaze::EyeView& view) {
            return optimised_layers(view, {}, {.layers = 3, .weights = {}});
        });
        expect_memory_of_the_first_plan(method);
    }
}

}  // namespace
}  // namespace gazeloop::foveation
