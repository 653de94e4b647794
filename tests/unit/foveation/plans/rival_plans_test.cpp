// What rings, sparse samples and layers plan for a frame, against counting by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "runtime/foveation/plans/fixed_plan.h"
#include "runtime/foveation/plans/layered_plan.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/foveation/plans/sparse_plan.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

constexpr std::uint32_t kWidth = 131;  // no whole number of blocks or tiles
constexpr std::uint32_t kHeight = 99;

/// A gaze in tests::square_view, by its tangents to the right and down.
gaze::FoveaPoint looking(double right, double down) {
    gaze::FoveaPoint fovea;
    fovea.position = {0.5 * (right + 1.0) * kWidth, 0.5 * (down + 1.0) * kHeight};
    fovea.direction = glm::normalize(glm::dvec3{right, -down, -1.0});
    return fovea;
}

gaze::EyeView view() { return tests::square_view(kWidth, kHeight); }

EyePlan plan_of(MethodPlan& method, const gaze::FoveaPoint& fovea,
                const HiddenArea* hidden = nullptr, const FrameInRun& frame = {}) {
    value_or_throw(method.prepare({view(), view()}));
    EyePlan plan;
    method.plan(gaze::Eye::Left, view(), fovea, hidden, frame, plan);
    for (const ShadedGrid& grid : plan.grids) {
        const frame::GridCounts& counts = grid.counts;
        EXPECT_EQ(counts.planned,
                  counts.shaded + counts.off_screen + counts.covered + counts.hidden);
    }
    return plan;
}

const std::array kGazes{looking(0.0, 0.0), looking(0.9, -0.4), looking(-1.0, 1.0),
                        looking(3.0, 0.2), looking(-60.0, 60.0)};

/// The rate that the table states for a pixel, 3 where it is hidden: as the shader reads it.
unsigned rate_in_table(const EyePlan& plan, std::uint32_t x, std::uint32_t y) {
    const auto in = [&](std::size_t pair) {
        const std::size_t at = 2 * (std::size_t{3} * (y / kBandRows) + pair);
        return x >= plan.table[at] && x < plan.table[at + 1];
    };
    return !in(2) ? 3U : in(0) ? 0U : in(1) ? 1U : 2U;
}

TEST(RingsPlan, CountsTheCellsOfEachRate) {
    const HiddenArea corners(tests::cut_corners(0.3), view());
    const auto visible = tests::visible_pixels(corners, {kWidth, kHeight});
    for (const RingParameters& rings :
         {RingParameters{10.0, 25.0, 16}, RingParameters{0.0, 180.0, 4},
          RingParameters{12.0, 12.0, 12}, RingParameters{180.0, 180.0, 64}}) {
        RingsPlan method([&](const gaze::EyeView&) { return rings; });
        for (const gaze::FoveaPoint& fovea : kGazes) {
            const RingRates rates =
                plan_rings(GazeField::create(view(), fovea.direction).value(), rings).value();
            for (const HiddenArea* const hidden :
                 {static_cast<const HiddenArea*>(nullptr), &corners}) {
                const EyePlan plan = plan_of(method, fovea, hidden);
                ASSERT_EQ(plan.table.size(), RingsPlan::table_words(kHeight));
                std::array<std::uint64_t, 3> cells{};
                for (std::uint32_t y = 0; y < kHeight; ++y) {
                    for (std::uint32_t x = 0; x < kWidth; ++x) {
                        const unsigned rate = rate_in_table(plan, x, y);
                        const bool shown = hidden == nullptr || visible[y * kWidth + x];
                        // Masks end in blocks: some hidden pixels may count as visible.
                        ASSERT_TRUE(rate < 3 || !shown) << x << ' ' << y;
                        if (rate == 3) {
                            continue;
                        }
                        ASSERT_EQ(rate, rates.log2_rate(x, y)) << x << ' ' << y;
                        const std::uint32_t block = 1U << rate;
                        if (x % block == 0 && y % block == 0) {
                            ++cells.at(rate);
                            const Columns& band = plan.grids[rate].bands[(y >> rate) / kBandRows];
                            ASSERT_TRUE((x >> rate) >= band.first && (x >> rate) < band.end);
                        }
                    }
                }
                for (unsigned rate = 0; rate < 3; ++rate) {
                    EXPECT_EQ(plan.grids[rate].counts.shaded, cells.at(rate)) << rate;
                    EXPECT_EQ(plan.grids[rate].tiles.empty(), cells.at(rate) == 0) << rate;
                }
            }
        }
    }
}

/// The samples that a plan lists, as the shaders find them.
std::set<std::uint32_t> listed(const EyePlan& plan) {
    std::set<std::uint32_t> samples;
    for (std::uint32_t row = 0; row < plan.table[1]; ++row) {
        const std::size_t at = SparsePlan::kHeader + 2 * std::size_t{row};
        for (std::uint32_t i = plan.table[at]; i < plan.table[at + 2]; ++i) {
            samples.insert(plan.table[at + 1] + i - plan.table[at]);
        }
    }
    EXPECT_EQ(samples.size(), plan.table[0]);
    return samples;
}

// Every neighbour of every visible pixel is in the list, where the shader looks for it.
TEST(SparsePlan, ListsWhateverAPixelIsFilledFrom) {
    const HiddenArea corners(tests::cut_corners(0.4), view());
    const auto visible = tests::visible_pixels(corners, {kWidth, kHeight});
    for (const std::uint32_t k : {1U, 4U}) {
        SparsePlan method({.pattern = {.share = 0.03}, .neighbours = k, .turn = true});
        for (const gaze::FoveaPoint& fovea : kGazes) {
            for (const HiddenArea* const hidden :
                 {static_cast<const HiddenArea*>(nullptr), &corners}) {
                for (std::uint64_t frame = 0; frame < 5; ++frame) {
                    const EyePlan plan = plan_of(method, fovea, hidden, {frame, frame > 0});
                    const std::set<std::uint32_t> samples = listed(plan);
                    const auto& prepared = *method.prepared(gaze::Eye::Left);
                    const auto word = [&](std::size_t at) {
                        return static_cast<int>(plan.table[at]);
                    };
                    for (int y = 0; y < static_cast<int>(kHeight); ++y) {
                        for (int x = 0; x < static_cast<int>(kWidth); ++x) {
                            if (hidden != nullptr && !visible[static_cast<std::size_t>(y) * kWidth +
                                                              static_cast<std::size_t>(x)]) {
                                continue;
                            }
                            const int place_x = word(3) + word(5) * x;
                            const int place_y = word(4) + word(6) * y;
                            ASSERT_TRUE(place_x >= 0 && place_x < 2 * static_cast<int>(kWidth));
                            ASSERT_TRUE(place_y >= 0 && place_y < 2 * static_cast<int>(kHeight));
                            for (const std::uint32_t index :
                                 prepared.nearest.of(static_cast<std::uint32_t>(place_x),
                                                     static_cast<std::uint32_t>(place_y))) {
                                ASSERT_TRUE(samples.contains(index)) << x << ' ' << y;
                            }
                        }
                    }
                    EXPECT_EQ(plan.grids[0].counts.planned, prepared.pattern.samples.size());
                    EXPECT_EQ(plan.grids[0].counts.shaded, samples.size());
                }
            }
        }
    }
}

// The gaze stays where it is, whichever way the pattern is turned.
TEST(SparsePlan, TurnsThePatternAboutTheGaze) {
    SparsePlan method({.pattern = {.share = 0.05}, .neighbours = 1, .turn = true});
    const gaze::FoveaPoint fovea = looking(0.2, 0.3);
    std::set<std::pair<int, int>> signs;
    std::set<std::set<std::uint32_t>> lists;
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
        const EyePlan plan = plan_of(method, fovea, nullptr, {frame, true});
        const auto word = [&](std::size_t at) { return static_cast<int>(plan.table[at]); };
        // The corner between pixels that is nearest to the gaze is the field's middle.
        const int corner_x = static_cast<int>(std::round(fovea.position.x_px));
        const int corner_y = static_cast<int>(std::round(fovea.position.y_px));
        const auto middle = [&](int origin, int sign, int corner) {
            return origin + sign * corner + (sign < 0 ? 1 : 0);
        };
        EXPECT_EQ(middle(word(3), word(5), corner_x), static_cast<int>(kWidth));
        EXPECT_EQ(middle(word(4), word(6), corner_y), static_cast<int>(kHeight));
        signs.emplace(word(5), word(6));
        lists.insert(listed(plan));
    }
    EXPECT_EQ(signs.size(), 4U);
    EXPECT_EQ(lists.size(), 4U);
}

TEST(SparsePlan, OfEveryPixelHasThemAll) {
    SparsePlan method({.pattern = {.share = 1.0}, .neighbours = 1});
    for (const gaze::FoveaPoint& fovea : kGazes) {
        EXPECT_GE(plan_of(method, fovea).grids[0].counts.shaded, std::uint64_t{kWidth} * kHeight);
    }
}

LayeredPlan three_layers(bool half_rate) {
    return LayeredPlan({.layers = 4, .half_rate = half_rate}, [](const gaze::EyeView& view) {
        return optimised_layers(view, {.slope = 0.3}, {.layers = 3, .weights = {}});
    });
}

TEST(LayeredPlan, PlansWhatTheOptimiserFinds) {
    LayeredPlan method = three_layers(false);
    for (const gaze::FoveaPoint& fovea : kGazes) {
        const EyePlan plan = plan_of(method, fovea);
        ASSERT_EQ(plan.grids.size(), 4U);
        const LayerPlan expected = plan_layers(GazeField::create(view(), fovea.direction).value(),
                                               {.slope = 0.3}, {.layers = 3, .weights = {}})
                                       .value();
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint64_t cells =
                i < expected.layers.size()
                    ? std::uint64_t{expected.layers[i].width} * expected.layers[i].height
                    : 0;
            EXPECT_EQ(plan.grids[i].counts.shaded, cells) << i;
        }
    }
}

TEST(LayeredPlan, TakesTurnsOnceThereIsALastFrame) {
    LayeredPlan method = three_layers(true);
    for (std::uint64_t frame = 0; frame < 6; ++frame) {
        for (const bool follows : {false, true}) {
            const EyePlan plan = plan_of(method, kGazes[0], nullptr, {frame, follows});
            for (std::size_t i = 0; i < 3; ++i) {
                const bool shaded = i == 0 || !follows || (frame + i) % 2 == 0;
                EXPECT_EQ(plan.grids[i].counts.shaded > 0, shaded) << frame << ' ' << i;
                EXPECT_EQ(LayeredPlan::layer_of(plan, i).cells.w > 0.0F, shaded);
            }
        }
    }
}

// Whatever cell a visible pixel's interpolation reads is planned.
TEST(LayeredPlan, ShadesWhateverAVisiblePixelReads) {
    const HiddenArea corners(tests::cut_corners(0.4), view());
    const auto visible = tests::visible_pixels(corners, {kWidth, kHeight});
    LayeredPlan method = three_layers(false);
    for (const gaze::FoveaPoint& fovea : kGazes) {
        const EyePlan plan = plan_of(method, fovea, &corners);
        std::uint64_t hidden = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const LayeredPlan::Layer layer = LayeredPlan::layer_of(plan, i);
            hidden += plan.grids[i].counts.hidden;
            for (std::uint32_t y = 0; y < kHeight; ++y) {
                for (std::uint32_t x = 0; x < kWidth; ++x) {
                    const double in_x = x + 0.5 - layer.covers.x;
                    const double in_y = y + 0.5 - layer.covers.y;
                    if (!visible[y * kWidth + x] || in_x < 0.0 || in_y < 0.0 ||
                        in_x > layer.covers.z || in_y > layer.covers.w) {
                        continue;
                    }
                    const double cell_x = in_x / layer.covers.z * layer.cells.x - 0.5;
                    const double cell_y = in_y / layer.covers.w * layer.cells.y - 0.5;
                    for (const double dx : {0.0, 1.0}) {
                        for (const double dy : {0.0, 1.0}) {
                            const double column =
                                std::clamp(std::floor(cell_x) + dx, 0.0, layer.cells.x - 1.0);
                            const double row =
                                std::clamp(std::floor(cell_y) + dy, 0.0, layer.cells.y - 1.0);
                            const Columns& band =
                                plan.grids[i].bands[static_cast<std::size_t>(row) / kBandRows];
                            ASSERT_TRUE(column >= band.first && column < band.end)
                                << i << ' ' << x << ' ' << y;
                        }
                    }
                }
            }
        }
        EXPECT_GT(hidden, 0U);
    }
}

TEST(LayeredPlan, PushesAnInsetBackIntoThePicture) {
    const LayerShape inset{.share = 0.25};
    for (const gaze::FoveaPoint& fovea : kGazes) {
        const PlannedLayer layer =
            plan_layer(GazeField::create(view(), fovea.direction).value(), inset);
        EXPECT_EQ(layer.covers.x1 - layer.covers.x0, 33U);  // .25 * 131
        EXPECT_EQ(layer.covers.y1 - layer.covers.y0, 25U);
        EXPECT_LE(layer.covers.x1, kWidth);
        EXPECT_LE(layer.covers.y1, kHeight);
    }
}

TEST(FixedPlan, IsThePlanStraightAhead) {
    RingsPlan rings([](const gaze::EyeView&) { return RingParameters{5.0, 15.0, 16}; });
    const EyePlan ahead = plan_of(rings, looking(0.0, 0.0));
    FixedPlan method(rings);
    for (const gaze::FoveaPoint& fovea : kGazes) {
        EXPECT_EQ(plan_of(method, fovea).table, ahead.table);
    }
}

// What a method offers is a property of the picture, wherever the eye looks.
TEST(FixedDensity, OffersWhatIsThereWhereverTheEyeLooks) {
    const GazeField ahead = GazeField::create(view(), kStraightAhead).value();
    const GazeField aside = GazeField::create(view(), looking(0.7, -0.3).direction).value();
    const FixedDensity fixed(std::make_unique<FullDensity>(), ahead);
    for (const gaze::PixelPosition& pixel : {gaze::PixelPosition{3, 4}, {65, 50}, {120, 90}}) {
        const FieldPoint at = aside.at(pixel);
        EXPECT_NEAR(fixed.at(at).worst_density(), FullDensity().at(at).worst_density(), 1e-9);
    }
}

}  // namespace
}  // namespace gazeloop::foveation
