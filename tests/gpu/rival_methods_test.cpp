// What the rivals of the log-polar methods promise: exact where the fovea is, no seams, and over
// frames no flicker.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/foveation/plans/sparse_plan.h"
#include "runtime/render/depth.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/method_by_settings.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::render {
namespace {

using Settings = std::vector<NamedValue>;

class RivalMethods : public FrameRendererTest {
  protected:
    static RendererConfig pictures(std::uint32_t width, std::uint32_t height) {
        RendererConfig config;
        config.extents = {vk::Extent2D(width, height), vk::Extent2D(width, height)};
        return config;
    }

    static FrameRequest request_for(const RendererConfig& config, gaze::PixelPosition fovea) {
        MethodConfig sized;
        sized.extents = config.extents;
        return request(sized, fovea);
    }

    /// Several frames by one renderer, one after the other.
    class Run {
      public:
        Run(std::string_view method, const Settings& set, const RendererConfig& config)
            : off_screen_(context(), scene(), tests::passes_by(method, set), config) {}

        OffScreen::Rendered next(FrameRequest request) {
            request.index = frame_++;
            return off_screen_.render(request.frame_view(), request.fovea());
        }
        Picture left(const FrameRequest& request) {
            next(request);
            return off_screen_.picture(gaze::Eye::Left);
        }
        LinearPicture left_linear(const FrameRequest& request) {
            next(request);
            return off_screen_.linear_picture(gaze::Eye::Left);
        }

      private:
        OffScreen off_screen_;
        std::uint64_t frame_ = 0;
    };

    static Picture left(std::string_view method, const Settings& set, const RendererConfig& config,
                        const FrameRequest& request) {
        return Run(method, set, config).left(request);
    }

    static int difference(const std::array<std::uint8_t, 3>& a,
                          const std::array<std::uint8_t, 3>& b) {
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(a[c] - b[c]));
        }
        return largest;
    }

    static double mean_difference(const Picture& a, const Picture& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum += std::abs(a.pixels[i][c] - b.pixels[i][c]);
            }
        }
        return sum / (3.0 * static_cast<double>(a.pixels.size()));
    }

    /// Pixels that are as at full resolution within a radius of a position.
    static void expect_exact_within(double radius_px, const gaze::PixelPosition& fovea,
                                    const Picture& picture, const Picture& full) {
        int inside = 0;
        for (std::uint32_t y = 0; y < picture.height; ++y) {
            for (std::uint32_t x = 0; x < picture.width; ++x) {
                if (std::hypot(x + 0.5 - fovea.x_px, y + 0.5 - fovea.y_px) < radius_px) {
                    const std::size_t i = std::size_t{y} * picture.width + x;
                    ++inside;
                    // 16-bit floats in between may round the other way.
                    ASSERT_LE(difference(picture.pixels[i], full.pixels[i]), 1) << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(inside, 100);
    }

    /// A picture of the sky overhead, which is smooth.
    static FrameRequest smooth(const RendererConfig& config, gaze::PixelPosition fovea) {
        FrameRequest at = request_for(config, fovea);
        for (gaze::EyeView& view : at.views) {
            view.pose.orientation = glm::angleAxis(1.3, glm::dvec3(1, 0, 0));
            view.fov = {-0.1, 0.1, 0.1, -0.1};
        }
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            at.gaze_directions[e] = gaze::unproject(fovea, at.views[e]);
        }
        return at;
    }

    /// The head turned to the left by so much.
    static FrameRequest turned(FrameRequest at, double yaw_deg) {
        for (gaze::EyeView& view : at.views) {
            view.pose.orientation = glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0, 1, 0));
        }
        return at;
    }
};

// A block's sample lies in its middle: blocks of 2 x 2 are the picture at half the size.
TEST_F(RivalMethods, RingsShowThePictureAtThreeSizes) {
    const RendererConfig config = pictures(192, 128);
    const gaze::PixelPosition fovea{100, 60};
    const FrameRequest at = request_for(config, fovea);
    const Settings rings{{"rings.inner_deg", "8"}, {"rings.outer_deg", "20"}};
    const Picture shown = left("rings", rings, config, at);
    const auto field = foveation::GazeField::create(at.views[0], at.gaze_directions[0]).value();
    const auto rates = foveation::plan_rings(field, {8.0, 20.0, 16}).value();
    std::array<int, 3> seen{};
    std::array<Picture, 3> sizes;
    for (unsigned rate = 0; rate < 3; ++rate) {
        const RendererConfig smaller = pictures(192U >> rate, 128U >> rate);
        sizes.at(rate) = left("full", {}, smaller, request_for(smaller, {10, 10}));
    }
    for (std::uint32_t y = 0; y < 128; ++y) {
        for (std::uint32_t x = 0; x < 192; ++x) {
            const unsigned rate = rates.log2_rate(x, y);
            ++seen.at(rate);
            const Picture& of_size = sizes.at(rate);
            ASSERT_LE(
                difference(shown.pixels[y * 192 + x],
                           of_size.pixels[std::size_t{y >> rate} * of_size.width + (x >> rate)]),
                1)
                << x << ' ' << y;
        }
    }
    for (const int pixels : seen) {
        EXPECT_GT(pixels, 500);
    }
}

// From one neighbour, every pixel shows its nearest sample, if that lies in the picture.
TEST_F(RivalMethods, SparseShowsTheNearestSample) {
    const RendererConfig config = pictures(96, 72);
    for (const gaze::PixelPosition fovea : {gaze::PixelPosition{48, 36}, {0, 72}, {80.4, 10.2}}) {
        const FrameRequest at = request_for(config, fovea);
        const Picture shown = left("sparse", {{"sparse.k", "1"}}, config, at);
        const Picture full = left("full", {}, config, at);
        const auto pattern = foveation::make_sparse_pattern({}, {96, 72}).value();
        const auto nearest = foveation::find_nearest_samples(pattern, 1).value();
        const foveation::FieldPixel window = pattern.window(fovea);
        int checked = 0;
        for (int y = 0; y < 72; ++y) {
            for (int x = 0; x < 96; ++x) {
                const auto& sample =
                    pattern.samples[nearest.of(static_cast<std::uint32_t>(x + window.x),
                                               static_cast<std::uint32_t>(y + window.y))[0]];
                const int from_x = sample.x - window.x;
                const int from_y = sample.y - window.y;
                if (from_x >= 0 && from_x < 96 && from_y >= 0 && from_y < 72) {
                    ++checked;
                    ASSERT_LE(
                        difference(shown.pixels[static_cast<std::size_t>(y * 96 + x)],
                                   full.pixels[static_cast<std::size_t>(from_y * 96 + from_x)]),
                        1)
                        << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(checked, 96 * 72 / 2);
    }
}

// Four neighbours by inverse distance, against the same sum by hand.
TEST_F(RivalMethods, SparseWeighsNeighboursByInverseDistance) {
    const RendererConfig config = pictures(96, 72);
    const FrameRequest at = request_for(config, {48, 36});
    const LinearPicture shown = Run("sparse", {}, config).left_linear(at);
    const LinearPicture full = Run("full", {}, config).left_linear(at);
    const auto pattern = foveation::make_sparse_pattern({}, {96, 72}).value();
    const auto nearest = foveation::find_nearest_samples(pattern, 4).value();
    const foveation::FieldPixel window = pattern.window({48, 36});
    int checked = 0;
    for (int y = 0; y < 72; ++y) {
        for (int x = 0; x < 96; ++x) {
            glm::dvec3 sum(0.0);
            double weights = 0.0;
            bool inside = true;
            for (const std::uint32_t index : nearest.of(static_cast<std::uint32_t>(x + window.x),
                                                        static_cast<std::uint32_t>(y + window.y))) {
                const int from_x = pattern.samples[index].x - window.x;
                const int from_y = pattern.samples[index].y - window.y;
                inside = inside && from_x >= 0 && from_x < 96 && from_y >= 0 && from_y < 72;
                // What is brighter than 8 bits hold was cut before it could be summed here.
                inside = inside && glm::all(glm::lessThan(
                                       full.pixels[static_cast<std::size_t>(from_y * 96 + from_x)],
                                       glm::vec3(0.95F)));
                if (inside) {
                    const double weight = 1.0 / std::max(1e-9, std::hypot(from_x - x, from_y - y));
                    sum += weight *
                           glm::dvec3(full.pixels[static_cast<std::size_t>(from_y * 96 + from_x)]);
                    weights += weight;
                }
            }
            if (inside) {
                ++checked;
                const glm::dvec3 expected = sum / weights;
                const glm::dvec3 got(shown.pixels[static_cast<std::size_t>(y * 96 + x)]);
                // Both were rounded to 8 bits.
                ASSERT_LE(glm::length(got - expected), 0.015 * (0.15 + glm::length(expected)))
                    << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(checked, 96 * 72 / 2);
}

/// What full resolution says of a picture's distances: 1 / distance of each pixel of the left eye.
std::vector<double> nearness_of(const FrameRequest& at, const std::vector<float>& depths) {
    std::vector<double> nearness;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const gaze::EyeView& view = at.views[0];
        const glm::dvec3 ray = gaze::unproject({static_cast<double>(i % view.width_px) + 0.5,
                                                static_cast<double>(i / view.width_px) + 0.5},
                                               view);
        nearness.push_back(depths[i] / kDepthNear_m * -ray.z);
    }
    return nearness;
}

// With depth, a neighbour weighs less the farther its distance is from the nearest sample's: over
// an edge of depth the picture is nearer to full resolution, elsewhere hardly another.
TEST_F(RivalMethods, SparseGuidedByDepthKeepsEdges) {
    RendererConfig config = pictures(160, 120);
    config.depth_format = vk::Format::eD32Sfloat;
    const FrameRequest at = request_for(config, {80, 60});
    OffScreen full(context(), scene(), tests::passes_by("full"), config);
    full.render(at.frame_view(), at.fovea());
    const LinearPicture exact = full.linear_picture(gaze::Eye::Left);
    const std::vector<double> nearness = nearness_of(at, full.depth(gaze::Eye::Left));
    const LinearPicture plain = Run("sparse", {}, config).left_linear(at);
    const LinearPicture guided =
        Run("sparse", {{"sparse.depth_guided", "true"}}, config).left_linear(at);
    const auto pattern = foveation::make_sparse_pattern({}, {160, 120}).value();
    const auto nearest = foveation::find_nearest_samples(pattern, 4).value();
    const foveation::FieldPixel window = pattern.window({80, 60});
    double plain_error = 0.0;
    double guided_error = 0.0;
    int over_edges = 0;
    int on_surfaces = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const auto pixel = static_cast<std::size_t>(y * 160 + x);
            glm::dvec3 sum(0.0);
            double weights = 0.0;
            double first = -1.0;
            double apart = 0.0;
            bool inside = true;
            for (const std::uint32_t index : nearest.of(static_cast<std::uint32_t>(x + window.x),
                                                        static_cast<std::uint32_t>(y + window.y))) {
                const int from_x = pattern.samples[index].x - window.x;
                const int from_y = pattern.samples[index].y - window.y;
                inside = inside && from_x >= 0 && from_x < 160 && from_y >= 0 && from_y < 120;
                if (!inside) {
                    break;
                }
                const auto from = static_cast<std::size_t>(from_y * 160 + from_x);
                inside = glm::all(glm::lessThan(exact.pixels[from], glm::vec3(0.95F)));
                first = first < 0.0 ? nearness[from] : first;
                const double between = std::abs(nearness[from] - first) /
                                       (0.05 * std::max(nearness[from], first) + 1e-4);
                apart = std::max(apart, between);
                const double weight = 1.0 / std::max(1e-9, std::hypot(from_x - x, from_y - y)) /
                                      (1.0 + between * between);
                sum += weight * glm::dvec3(exact.pixels[from]);
                weights += weight;
            }
            if (!inside) {
                continue;
            }
            const glm::dvec3 expected = sum / weights;
            const glm::dvec3 got(guided.pixels[pixel]);
            // Both were rounded to 8 bits, and distances to halves.
            ASSERT_LE(glm::length(got - expected), 0.02 * (0.2 + glm::length(expected)))
                << x << ' ' << y;
            if (apart > 3.0) {
                ++over_edges;
                plain_error += glm::length(glm::dvec3(plain.pixels[pixel] - exact.pixels[pixel]));
                guided_error += glm::length(glm::dvec3(guided.pixels[pixel] - exact.pixels[pixel]));
            } else if (apart == 0.0) {
                ++on_surfaces;
                EXPECT_EQ(guided.pixels[pixel], plain.pixels[pixel]) << "one distance";
            }
        }
    }
    EXPECT_GT(over_edges, 200);
    EXPECT_GT(on_surfaces, 200);
    EXPECT_LT(guided_error, 0.95 * plain_error);
}

TEST_F(RivalMethods, SparseShadesThePixelsOfItsDisc) {
    const RendererConfig config = pictures(160, 120);
    const gaze::PixelPosition fovea{90, 50};
    const FrameRequest at = request_for(config, fovea);
    const auto pattern = foveation::make_sparse_pattern({.share = 0.2}, {160, 120}).value();
    for (const char* const turn : {"false", "true"}) {
        Run sparse("sparse",
                   {{"sparse.share", "0.2"}, {"sparse.turn", turn}, {"sparse.accumulate", turn}},
                   config);
        const Picture full = left("full", {}, config, at);
        for (int frame = 0; frame < 5; ++frame) {
            expect_exact_within(pattern.profile.disc_radius_px - 1.5, fovea, sparse.left(at), full);
        }
    }
}

// Samples that turn from frame to frame, accumulated, show more of a still scene than one frame
// does, and the picture comes to rest.
TEST_F(RivalMethods, SparseAccumulatesAStillScene) {
    const RendererConfig config = pictures(160, 120);
    const FrameRequest at = request_for(config, {80, 60});
    const Picture full = left("full", {}, config, at);
    Run run("sparse", {{"sparse.turn", "true"}, {"sparse.accumulate", "true"}}, config);
    const double first = mean_difference(run.left(at), full);
    Picture last;
    Picture before;
    for (int frame = 0; frame < 32; ++frame) {
        before = std::exchange(last, run.left(at));
    }
    EXPECT_LT(mean_difference(last, full), 0.8 * first);
    EXPECT_LT(mean_difference(last, before), 0.35 * first);
}

// Where the scene is smooth, neither a border nor an interpolation may show.
TEST_F(RivalMethods, LayersAndQuadShowNoSeamInASmoothPicture) {
    const RendererConfig config = pictures(256, 256);
    const FrameRequest at = smooth(config, {128.5, 120.5});
    const Picture full = left("full", {}, config, at);
    for (const char* const n : {"2", "3", "4"}) {
        const Settings set{{"layers.n", n}, {"layers.temporal", "false"}};
        EXPECT_LE(largest_difference(left("layers", set, config, at), full), 1) << n;
    }
    EXPECT_LE(largest_difference(left("quad", {}, config, at), full), 1);
}

/// A display on which three layers are worth it: 512 px over 90 degrees, seen by a coarse eye.
const Settings kCoarseEye{{"acuity.mar", "0.1"}};

Settings coarse(Settings set) {
    set.insert(set.end(), kCoarseEye.begin(), kCoarseEye.end());
    return set;
}

TEST_F(RivalMethods, LayersAreExactWhereTheInnerOneIsAlone) {
    const RendererConfig config = pictures(320, 240);
    for (const gaze::PixelPosition fovea : {gaze::PixelPosition{160, 120}, {250, 60}}) {
        const FrameRequest at = request_for(config, fovea);
        const auto layers = foveation::optimised_layers(at.views[0], {.slope = 0.1},
                                                        {.layers = 3, .weights = {1, 0.5, 0.5}})
                                .value();
        ASSERT_EQ(layers.size(), 3U);
        // Degrees are fewest pixels on the axis.
        const double px_per_rad = 320.0 / (2.0 * std::tan(0.8));
        const double core_px =
            px_per_rad * std::tan(glm::radians(0.6 * layers[0].radius_deg)) - 1.0;
        expect_exact_within(core_px, fovea,
                            left("layers", coarse({{"layers.temporal", "false"}}), config, at),
                            left("full", {}, config, at));
    }
}

TEST_F(RivalMethods, QuadIsExactInsideItsInset) {
    const RendererConfig config = pictures(160, 120);
    const gaze::PixelPosition fovea{100, 50};
    const FrameRequest at = request_for(config, fovea);
    const Settings set{{"quad.section", "0.4"}, {"quad.blend", "0.2"}};
    // Sides of 48 px, a tenth of them blended on each side.
    expect_exact_within(0.5 * 48 - 0.1 * 48 - 1.0, fovea, left("quad", set, config, at),
                        left("full", {}, config, at));
}

TEST_F(RivalMethods, FixedLooksAheadWhereverTheGazeIs) {
    const RendererConfig config = pictures(96, 72);
    for (const char* const held : {"kfr", "acuity", "layers", "rings", "sparse", "quad", "kfr3d"}) {
        const Picture ahead = left(held, {}, config, request_for(config, {48, 36}));
        const Picture fixed =
            left("fixed", {{"fixed.method", held}}, config, request_for(config, {5, 60}));
        EXPECT_EQ(largest_difference(ahead, fixed), 0) << held;
    }
}

// In turns, the outer layers are shaded in every second frame, and all of them in the first.
TEST_F(RivalMethods, LayersTakeTurnsAtHalfRate) {
    const RendererConfig config = pictures(320, 240);
    const FrameRequest at = request_for(config, {160, 120});
    Run run("layers", kCoarseEye, config);
    for (int frame = 0; frame < 6; ++frame) {
        const frame::SampleCounts counts = run.next(at).counts;
        EXPECT_GT(counts.grids[0].shaded, 0U) << frame;
        EXPECT_EQ(counts.grids[1].shaded > 0, frame == 0 || frame % 2 == 1) << frame;
        EXPECT_EQ(counts.grids[2].shaded > 0, frame == 0 || frame % 2 == 0) << frame;
    }
}

TEST_F(RivalMethods, LayersKeptFromTheLastFrameAreStill) {
    const RendererConfig config = pictures(320, 240);
    const FrameRequest at = request_for(config, {150, 130});
    Run run("layers", coarse({{"layers.temporal", "false"}}), config);
    const Picture first = run.left(at);
    for (int frame = 0; frame < 5; ++frame) {
        EXPECT_LE(largest_difference(run.left(at), first), 1) << frame;
    }
}

// While the head turns by 100 deg/s at 90 Hz, a kept layer goes along with the world: what is kept
// differs from what is shaded anew by less than a third of what it would if it stood still.
TEST_F(RivalMethods, LayersKeptFromTheLastFrameFollowTheHead) {
    RendererConfig config = pictures(192, 144);
    config.samples = 16;  // else aliasing is most of what changes
    const FrameRequest at = request_for(config, {96, 72});
    Run kept("layers", coarse({{"layers.temporal", "false"}}), config);
    Run anew("layers", coarse({{"layers.temporal", "false"}, {"layers.half_rate", "false"}}),
             config);
    Picture before;
    double wrong = 0.0;
    double still = 0.0;
    for (int frame = 0; frame < 8; ++frame) {
        const FrameRequest now = turned(at, frame * 100.0 / 90.0);
        const Picture shown = kept.left(now);
        const Picture right = anew.left(now);
        if (frame > 0) {
            wrong += mean_difference(shown, right);
            still += mean_difference(before, right);
        }
        before = right;
    }
    EXPECT_LT(wrong, still / 3.0);
    EXPECT_GT(still, 1.0);
}

// Samples move in their cells, and the picture comes to rest near what many samples show.
TEST_F(RivalMethods, LayersAntialiasOverFrames) {
    const RendererConfig config = pictures(160, 120);
    const FrameRequest at = request_for(config, {80, 60});
    RendererConfig clean = config;
    clean.samples = 16;
    const Settings anew{{"layers.half_rate", "false"}, {"acuity.mar", "0.001"}};
    const Picture reference = left("full", {}, clean, at);
    const double once = mean_difference(left("full", {}, config, at), reference);
    Run run("layers", anew, config);
    Picture last;
    Picture before;
    for (int frame = 0; frame < 40; ++frame) {
        before = std::exchange(last, run.left(at));
    }
    EXPECT_LT(mean_difference(last, reference), 0.5 * once);
    EXPECT_LT(mean_difference(last, before), 0.25 * once);
}

// Over frames too, with the head turning, the gaze jumping, and parts that no eye sees: nothing is
// read that was not shaded, and the same frames give the same pictures.
TEST_F(RivalMethods, ReadOverFramesNothingThatWasNotShaded) {
    RendererConfig config = pictures(96, 72);
    config.hash = true;
    const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
    (*meshes)[0] = tests::cut_corners(0.5);
    (*meshes)[1] = tests::cut_corners(0.5);
    const std::array<gaze::PixelPosition, 6> gazes{
        {{48, 36}, {0, 36}, {200, 36}, {96, 72}, {30, -200}, {60, 20}}};
    const auto hashes = [&](std::string_view method, const Settings& set, bool hidden) {
        Run run(method, set, config);
        std::vector<std::uint64_t> all;
        for (int frame = 0; frame < 6; ++frame) {
            FrameRequest at =
                turned(request_for(config, gazes.at(static_cast<std::size_t>(frame))), 5.0 * frame);
            if (hidden) {
                at.hidden = foveation::hidden_areas(meshes, at.views);
            }
            all.push_back(run.next(at).gpu.pixel_hash.value());
        }
        return all;
    };
    for (const auto& [method, set] :
         {std::pair<const char*, Settings>{"layers", kCoarseEye},
          {"layers", coarse({{"layers.half_rate", "false"}})},
          {"layers", coarse({{"layers.temporal", "false"}})},
          {"layers", coarse({{"layers.half_rate", "false"}, {"layers.temporal", "false"}})},
          {"sparse", {{"sparse.turn", "true"}}},
          {"sparse", {{"sparse.turn", "true"}, {"sparse.accumulate", "true"}}},
          {"quad", {}}}) {
        for (const bool hidden : {false, true}) {
            config.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
            const auto on_black = hashes(method, set, hidden);
            EXPECT_EQ(hashes(method, set, hidden), on_black) << method;
            config.unshaded = {5e4F, 0.0F, 5e4F, 1.0F};
            EXPECT_EQ(hashes(method, set, hidden), on_black) << method << ' ' << hidden;
        }
    }
}

}  // namespace
}  // namespace gazeloop::render
