#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "runtime/error.h"
#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

TEST_F(FrameRendererTest, DiscIsFullResolution) {
    const MethodConfig kfr = config(Method::Kfr, 320, 240);
    const FrameRequest at = request(kfr, {140, 120});
    const Rendered foveated = render(kfr, at);
    const Rendered full = render(config(Method::Full, 320, 240), at);
    int inside = 0;
    double outside_error = 0.0;
    const foveation::LogPolarPlan& plan = foveated.plans[0];
    const double core = plan.disc_radius_px - plan.disc_border_px;
    ASSERT_GT(core, 5.0);
    for (std::uint32_t y = 0; y < 240; ++y) {
        for (std::uint32_t x = 0; x < 320; ++x) {
            const std::size_t i = std::size_t{y} * 320 + x;
            if (std::hypot(x + 0.5 - 140, y + 0.5 - 120) < core) {
                ++inside;
                for (std::size_t c = 0; c < 3; ++c) {
                    // 16-bit floats in between may round the other way.
                    EXPECT_NEAR(foveated.pictures[0].pixels[i][c], full.pictures[0].pixels[i][c], 1)
                        << x << ' ' << y;
                }
            } else {
                outside_error +=
                    std::abs(foveated.pictures[0].pixels[i][1] - full.pictures[0].pixels[i][1]);
            }
        }
    }
    EXPECT_GT(inside, 100);
    // The periphery is a filtered picture of the same scene, not another one and not the same.
    const double mean_error = outside_error / (320 * 240 - inside);
    EXPECT_GT(mean_error, 0.1);
    EXPECT_LT(mean_error, 12.0);
}

TEST_F(FrameRendererTest, ReadsNoTexelThatWasLeftOut) {
    MethodConfig kfr = config(Method::Kfr);
    for (const bool disc : {true, false}) {
        kfr.kfr.disc = disc;
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{80, 60}, gaze::PixelPosition{0, 60},
              gaze::PixelPosition{160, 120}, gaze::PixelPosition{-40, 30},
              gaze::PixelPosition{100, 300}, gaze::PixelPosition{80.5, 60.5}}) {
            const FrameRequest at = request(kfr, fovea);
            kfr.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
            const Rendered on_black = render(kfr, at);
            kfr.unshaded = {5e4F, 0.0F, 5e4F, 1.0F};
            const Rendered on_poison = render(kfr, at);
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                EXPECT_EQ(largest_difference(on_black.pictures[e], on_poison.pictures[e]), 0)
                    << fovea.x_px << ' ' << fovea.y_px << " disc " << disc;
            }
        }
    }
}

// Where the scene is smooth (the sky overhead), sampling it less must not show: neither where the
// angle wraps, nor along the disc's border, nor at the fovea.
TEST_F(FrameRendererTest, ShowsNoSeamInASmoothPicture) {
    MethodConfig kfr = config(Method::Kfr, 256, 256);
    FrameRequest at = request(kfr, {128.5, 128.5});
    for (gaze::EyeView& view : at.views) {
        view.pose.orientation = glm::angleAxis(1.3, glm::dvec3(1, 0, 0));
        view.fov = {-0.1, 0.1, 0.1, -0.1};
    }
    const Rendered full = render(config(Method::Full, 256, 256), at);
    for (const bool disc : {true, false}) {
        kfr.kfr.disc = disc;
        const Rendered foveated = render(kfr, at);
        EXPECT_LE(largest_difference(foveated.pictures[0], full.pictures[0]), 1) << disc;
    }
}

// The angle wraps on a line from the fovea to the right. Rows of 45 degrees differ much, and
// wherever they meet, the picture goes on: there too, where the last row meets the first.
TEST_F(FrameRendererTest, JoinsTheLastRowToTheFirst) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        MethodConfig coarse = config(method, 256, 256);
        coarse.kfr.lp_height = 8;
        coarse.kfr.disc = false;
        coarse.acuity.lp_height = 8;
        coarse.acuity.disc = false;
        const Picture picture = render(coarse, request(coarse, {128.0, 128.0})).pictures[0];
        const auto step = [&](std::uint32_t y) {
            int largest = 0;
            for (std::uint32_t x = 200; x < 256; ++x) {
                for (std::size_t c = 0; c < 3; ++c) {
                    largest = std::max(largest, std::abs(picture.pixels[y * 256 + x][c] -
                                                         picture.pixels[(y - 1) * 256 + x][c]));
                }
            }
            return largest;
        };
        int elsewhere = 0;
        for (std::uint32_t y = 110; y < 127; ++y) {
            elsewhere = std::max(elsewhere, step(y));
        }
        EXPECT_GT(elsewhere, 0);
        EXPECT_LE(step(128), elsewhere + 1);
    }
}

TEST_F(FrameRendererTest, CountsAddUp) {
    const MethodConfig kfr = config(Method::Kfr);
    const Rendered foveated = render(kfr, request(kfr, {0, 60}));
    const frame::SampleCounts& counts = foveated.counts;
    const frame::GridCounts& lp = counts.grids[0];
    EXPECT_EQ(lp.planned, 2U * 89 * 67);
    EXPECT_EQ(lp.shaded + lp.off_screen + lp.covered, lp.planned);
    EXPECT_GT(lp.off_screen, lp.planned / 2);
    EXPECT_EQ(counts.pixels_output, 2U * 160 * 120);
    const Rendered full = render(config(Method::Full), request(kfr, {0, 60}));
    EXPECT_EQ(full.counts.grid_count, 1U);
    EXPECT_EQ(full.counts.shaded(), full.counts.pixels_output);
}

TEST_F(FrameRendererTest, TimesThePassesThatRan) {
    const MethodConfig kfr = config(Method::Kfr);
    const Rendered foveated = render(kfr, request(kfr, {80, 60}));
    const auto ns = [](const Rendered& rendered, std::string_view pass) {
        const auto at = rendered.passes.find(pass);
        return at ? rendered.gpu.passes[*at] : std::nullopt;
    };
    EXPECT_GT(ns(foveated, "pass_i"), 0);
    EXPECT_GT(ns(foveated, "resolve"), 0);
    EXPECT_GT(ns(foveated, "disc"), 0);
    for (std::size_t pass = foveated.passes.size(); pass < frame::kMostPasses; ++pass) {
        EXPECT_EQ(foveated.gpu.passes[pass], std::nullopt) << pass;
    }
    ASSERT_TRUE(foveated.gpu.gpu_end.known());
    EXPECT_GE(foveated.gpu.gpu_end.ns - foveated.gpu.gpu_begin.ns,
              *ns(foveated, "pass_i") + *ns(foveated, "disc"));

    MethodConfig unprofiled = kfr;
    unprofiled.profile = false;
    const Rendered plain = render(unprofiled, request(kfr, {80, 60}));
    EXPECT_EQ(ns(plain, "pass_i"), std::nullopt);
    EXPECT_TRUE(plain.gpu.gpu_end.known());
    EXPECT_EQ(largest_difference(plain.pictures[0], foveated.pictures[0]), 0);
}

TEST_F(FrameRendererTest, SkipsTheLpBufferWhereTheDiscCoversTheScreen) {
    MethodConfig kfr = config(Method::Kfr, 16, 16);
    kfr.kfr.sigma = 0.5;
    const FrameRequest at = request(kfr, {8, 8});
    const Rendered foveated = render(kfr, at);
    const Rendered full = render(config(Method::Full, 16, 16), at);
    EXPECT_EQ(foveated.counts.grids[0].shaded, 0U);
    EXPECT_EQ(foveated.gpu.passes[*foveated.passes.find("pass_i")], std::nullopt);
    EXPECT_LE(largest_difference(foveated.pictures[0], full.pictures[0]), 1);
}

TEST_F(FrameRendererTest, HashesWhatItRenders) {
    MethodConfig kfr = config(Method::Kfr);
    kfr.hash = true;
    const FrameRequest at = request(kfr, {80, 60});
    const auto first = render(kfr, at).gpu.pixel_hash;
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(render(kfr, at).gpu.pixel_hash, first);
    FrameRequest moved = at;
    moved.foveae[1].x_px += 1.0;
    EXPECT_NE(render(kfr, moved).gpu.pixel_hash, first);
    kfr.kfr.sigma = 2.0;
    EXPECT_NE(render(kfr, at).gpu.pixel_hash, first);
}

TEST_F(FrameRendererTest, EncodesByHandWhatTheFormatDoesNot) {
    MethodConfig srgb = config(Method::Full);
    MethodConfig unorm = srgb;
    unorm.format = vk::Format::eR8G8B8A8Unorm;
    MethodConfig bgra = srgb;
    bgra.format = vk::Format::eB8G8R8A8Srgb;
    const FrameRequest at = request(srgb, {80, 60});
    const Rendered reference = render(srgb, at);
    EXPECT_LE(largest_difference(render(unorm, at).pictures[0], reference.pictures[0]), 1);
    EXPECT_EQ(largest_difference(render(bgra, at).pictures[0], reference.pictures[0]), 0);
}

TEST_F(FrameRendererTest, MoreSamplesSmoothThePicture) {
    MethodConfig one = config(Method::Full);
    MethodConfig sixteen = one;
    sixteen.samples = 16;
    const auto roughness = [](const Picture& picture) {
        double sum = 0.0;
        for (std::uint32_t y = 0; y < picture.height; ++y) {
            for (std::uint32_t x = 1; x < picture.width; ++x) {
                const std::size_t i = std::size_t{y} * picture.width + x;
                sum += std::abs(picture.pixels[i][1] - picture.pixels[i - 1][1]);
            }
        }
        return sum;
    };
    const FrameRequest at = request(one, {80, 60});
    EXPECT_LT(roughness(render(sixteen, at).pictures[0]), roughness(render(one, at).pictures[0]));
}

// The left eye, being further left, sees near things further right.
TEST_F(FrameRendererTest, RendersEachEyeFromItsOwnPlace) {
    const MethodConfig full = config(Method::Full, 320, 240);
    const Rendered rendered = render(full, request(full, {}));
    const auto mismatch = [&](int shift) {
        double sum = 0.0;
        for (std::uint32_t y = 120; y < 240; ++y) {
            for (std::uint32_t x = 20; x < 300; ++x) {
                const std::size_t left = std::size_t{y} * 320 + x;
                const auto right = static_cast<std::size_t>(static_cast<int>(left) - shift);
                sum += std::abs(rendered.pictures[0].pixels[left][1] -
                                rendered.pictures[1].pixels[right][1]);
            }
        }
        return sum;
    };
    double crossed = 1e300;
    double uncrossed = 1e300;
    for (int shift = 1; shift <= 8; ++shift) {
        uncrossed = std::min(uncrossed, mismatch(shift));
        crossed = std::min(crossed, mismatch(-shift));
    }
    EXPECT_LT(uncrossed, crossed);
}

TEST_F(FrameRendererTest, KeepsFramesInFlightApart) {
    MethodConfig kfr = config(Method::Kfr);
    kfr.hash = true;
    FrameRequest at = request(kfr, {80, 60});
    FrameRenderer renderer(context(), scene(), passes_of(kfr), kfr);
    gaze::PerEye<vulkan::ColorImage> images;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        images[e] = vulkan::ColorImage(
            context(), kfr.extents[e], kfr.format,
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
        at.targets[e] = {images[e].image(), images[e].view()};
    }
    std::vector<frame::FrameGpuRecord> finished;
    const auto drain = [&] {
        while (auto record = renderer.next_finished()) {
            finished.push_back(*record);
        }
    };
    for (std::uint64_t i = 0; i < 12; ++i) {
        renderer.wait_for_slot();
        drain();
        at.index = i;
        for (gaze::PixelPosition& fovea : at.foveae) {
            fovea.x_px = i % 2 == 0 ? 40.0 : 120.0;
        }
        renderer.begin(at);
        renderer.finish(at.fovea());
    }
    renderer.wait_idle();
    drain();
    ASSERT_EQ(finished.size(), 12U);
    for (std::uint64_t i = 0; i < 12; ++i) {
        EXPECT_EQ(finished[i].index, i);
        EXPECT_EQ(finished[i].pixel_hash, finished[i % 2].pixel_hash) << i;
    }
    EXPECT_NE(finished[0].pixel_hash, finished[1].pixel_hash);
}

TEST_F(FrameRendererTest, TakesTheSmallestAndTheWidestPicture) {
    MethodConfig smallest = config(Method::Kfr, 2, 2);
    smallest.kfr.sigma = 0.5;
    EXPECT_EQ(render(smallest, request(smallest, {1, 1})).counts.pixels_output, 8U);
    MethodConfig widest = config(Method::Kfr, 16384, 8);
    widest.kfr.sigma = 2.0;
    const Rendered rendered = render(widest, request(widest, {8192, 4}));
    EXPECT_EQ(rendered.counts.grids[0].planned, 2U * 8192 * 4);
}

TEST_F(FrameRendererTest, RefusesWhatItCannotDo) {
    MethodConfig bad = config(Method::Kfr);
    bad.samples = 17;
    EXPECT_THROW(FrameRenderer(context(), scene(), passes_of(bad), bad), SetupError);
    EXPECT_THROW(scene::make_scene(context(), "nowhere"), SetupError);
    bad = config(Method::Kfr);
    bad.kfr.sigma = std::nan("");
    EXPECT_THROW(FrameRenderer(context(), scene(), passes_of(bad), bad), SetupError);
}

}  // namespace
}  // namespace gazeloop::render
