// What is read back around the foveae, against the depth images of the same frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <vector>

#include "runtime/gaze/fixation.h"
#include "runtime/render/depth.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/method_by_settings.h"

namespace gazeloop::render {
namespace {

constexpr double kFloor_m = -1.4;  // of the scene, below the world's origin

class SeenDepth : public FrameRendererTest {
  protected:
    static MethodConfig with_seen_depth(Method method, std::uint32_t width = 320,
                                        std::uint32_t height = 280) {
        MethodConfig made = config(method, width, height);
        made.depth_format = vk::Format::eD32Sfloat;
        made.seen_depth = true;
        return made;
    }

    /// 1 / z of a patch's sample as the depth image has it.
    static double depth_of(const gaze::DepthPatch& patch, std::size_t column, std::size_t row) {
        const double nearness = glm::unpackHalf1x16(patch.nearness[row * patch.columns + column]);
        const glm::dvec3 ray =
            gaze::unproject({patch.x0_px + static_cast<double>(column * patch.step_x_px) + 0.5,
                             patch.y0_px + static_cast<double>(row * patch.step_y_px) + 0.5},
                            patch.view);
        return std::min(kDepthNear_m * nearness / -ray.z, 1.0);
    }
};

TEST_F(SeenDepth, IsWhatTheDepthImagesHold) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{150.0, 160.0}, {90.3, 140.8}, {2.0, 270.0}}) {
            const MethodConfig with = with_seen_depth(method);
            const Rendered rendered = render(with, request(with, fovea));
            const MethodConfig full = [] {
                MethodConfig made = config(Method::Full, 320, 280);
                made.depth_format = vk::Format::eD32Sfloat;
                return made;
            }();
            const Rendered exact = render(full, request(full, fovea));
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                const gaze::DepthPatch& patch = rendered.seen_depth[e];
                ASSERT_GT(patch.columns, 2U);
                ASSERT_GT(patch.rows, 2U);
                ASSERT_EQ(patch.nearness.size(), std::size_t{patch.columns} * patch.rows);
                EXPECT_LE(patch.x0_px, fovea.x_px);
                EXPECT_LE(patch.y0_px, fovea.y_px);
                EXPECT_GT(patch.x0_px + patch.columns * patch.step_x_px, fovea.x_px);
                EXPECT_GT(patch.y0_px + patch.rows * patch.step_y_px, fovea.y_px);
                for (std::size_t row = 0; row < patch.rows; ++row) {
                    for (std::size_t column = 0; column < patch.columns; ++column) {
                        const std::size_t pixel = (patch.y0_px + row * patch.step_y_px) * 320 +
                                                  patch.x0_px + column * patch.step_x_px;
                        const double wanted = exact.depths[e][pixel];
                        EXPECT_NEAR(depth_of(patch, column, row), wanted, wanted / 1024.0 + 1e-6)
                            << "pixel " << pixel;
                    }
                }
            }
        }
    }
}

// Of layers, the inner one's cells are pixels; they begin anywhere in the picture.
TEST_F(SeenDepth, IsKeptByEveryMethodThatShadesPixelsAroundTheFovea) {
    const MethodConfig full = [] {
        MethodConfig made = config(Method::Full, 320, 280);
        made.depth_format = vk::Format::eD32Sfloat;
        return made;
    }();
    const MethodConfig with = with_seen_depth(Method::Full);
    using Settings = std::vector<NamedValue>;
    for (const auto& [method, set] :
         {std::pair<const char*, Settings>{"layers",
                                           {{"layers.temporal", "false"}, {"acuity.mar", "0.1"}}},
          {"layers", {{"acuity.mar", "0.1"}}},
          {"quad", {}},
          {"kfr3d", {}},
          {"rings", {}},
          {"fixed", {{"fixed.method", "quad"}}}}) {
        // Of samples that move in their cells, edges lie elsewhere.
        const bool moves = std::string_view(method) == "layers" && set.size() == 1;
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{150.0, 160.0}, {91.3, 142.8}, {2.0, 270.0}}) {
            if (std::string_view(method) == "fixed" && fovea.x_px < 100.0) {
                continue;  // what is shaded is ahead
            }
            const FrameRequest frame = request(with, fovea);
            const Rendered exact = render(full, frame);
            OffScreen off_screen(context(), scene(), tests::passes_by(method, set), with);
            off_screen.render(frame.frame_view(), frame.fovea());
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                const gaze::DepthPatch& patch = off_screen.renderer().seen_depth()[e];
                ASSERT_GT(patch.nearness.size(), 8U) << method << ' ' << fovea.x_px;
                ASSERT_LE(patch.x0_px, fovea.x_px);
                ASSERT_LE(patch.y0_px, fovea.y_px);
                ASSERT_GT(patch.x0_px + patch.columns * patch.step_x_px, fovea.x_px);
                ASSERT_GT(patch.y0_px + patch.rows * patch.step_y_px, fovea.y_px);
                std::size_t wrong = 0;
                for (std::size_t row = 0; row < patch.rows; ++row) {
                    for (std::size_t column = 0; column < patch.columns; ++column) {
                        const double wanted =
                            exact.depths[e].at((patch.y0_px + row * patch.step_y_px) * 320 +
                                               patch.x0_px + column * patch.step_x_px);
                        const double share = moves ? 0.03 : 1.0 / 1024.0;
                        wrong +=
                            std::abs(depth_of(patch, column, row) - wanted) > share * wanted + 1e-6
                                ? 1
                                : 0;
                    }
                }
                EXPECT_LE(wrong, moves ? patch.nearness.size() / 5 : 0) << method;
            }
        }
    }
}

// Everything together: where a gaze meets the floor, from the middle between the eyes.
TEST_F(SeenDepth, SaysHowFarTheFloorIs) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        const MethodConfig with = with_seen_depth(method, 640, 560);
        std::size_t on_floor = 0;
        std::size_t found = 0;
        for (double right = -0.5; right <= 0.5; right += 0.1) {
            FrameRequest frame = request(with, {});
            const glm::dvec3 direction = glm::normalize(glm::dvec3{right, -0.45, -1.0});
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                // The foveae are set to one and a half metres; the floor is about 3.4 m away.
                const glm::dvec3 to = 1.5 * direction - frame.views[e].pose.position_m;
                frame.gaze_directions[e] = glm::normalize(to);
                frame.foveae[e] = gaze::project(to, frame.views[e]);
            }
            const Rendered rendered = render(with, frame);
            const auto fixation =
                gaze::find_fixation({glm::dvec3{0.0}, direction}, rendered.seen_depth);
            const double floor = direction.y / kFloor_m;
            found += fixation ? 1 : 0;
            if (fixation) {
                EXPECT_GT(fixation->nearness, 0.98 * floor) << "nothing is below the floor";
                on_floor += fixation->nearness < 1.02 * floor ? 1 : 0;
            }
        }
        EXPECT_GE(found, 10U);
        EXPECT_GE(on_floor, 4U);
    }
}

TEST_F(SeenDepth, IsNoneWhereTheFoveaHasNoDisc) {
    const auto expect_none = [&](const MethodConfig& with, gaze::PixelPosition fovea) {
        const Rendered rendered = render(with, request(with, fovea));
        for (const gaze::DepthPatch& patch : rendered.seen_depth) {
            EXPECT_TRUE(patch.nearness.empty());
        }
    };
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        for (const gaze::PixelPosition off_screen :
             {gaze::PixelPosition{-3.0, 140.0}, {320.0, 140.0}, {100.0, 900.0}}) {
            expect_none(with_seen_depth(method), off_screen);
        }
    }
    expect_none(with_seen_depth(Method::Full), {150.0, 160.0});
    MethodConfig no_disc = with_seen_depth(Method::Kfr);
    no_disc.kfr.disc = false;
    expect_none(no_disc, {150.0, 160.0});
    no_disc = with_seen_depth(Method::Acuity);
    no_disc.acuity.disc = false;
    expect_none(no_disc, {150.0, 160.0});
    MethodConfig unasked = with_seen_depth(Method::Kfr);
    unasked.seen_depth = false;
    expect_none(unasked, {150.0, 160.0});
}

TEST_F(SeenDepth, WorksForTheSmallestPicturesAndBesideHiddenOnes) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        MethodConfig with = with_seen_depth(method, 2, 2);
        with.kfr.sigma = 0.5;
        const Rendered rendered = render(with, request(with, {0.5, 1.5}));
        for (const gaze::DepthPatch& patch : rendered.seen_depth) {
            EXPECT_LE(patch.nearness.size(), 4U);
            if (rendered.counts.grids[1].shaded == 8) {
                EXPECT_EQ(patch.nearness.size(), 4U);
            }
        }
        const MethodConfig masked = with_seen_depth(method);
        FrameRequest frame = request(masked, {10.0, 275.0});
        const double left = std::tan(frame.views[0].fov.left_rad);
        const double down = std::tan(frame.views[0].fov.down_rad);
        const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
        (*meshes)[0].push_back(
            {{glm::dvec2{left, down}, glm::dvec2{0.0, down}, glm::dvec2{left, 0.0}}});
        frame.hidden = foveation::hidden_areas(meshes, frame.views);
        const Rendered beside = render(masked, frame);
        EXPECT_TRUE(beside.seen_depth[0].nearness.empty()) << "hidden from the left eye";
        EXPECT_FALSE(beside.seen_depth[1].nearness.empty());
    }
}

// Reading back changes neither pictures, hashes, counts nor which passes are timed, in one submit
// or in several.
TEST_F(SeenDepth, LeavesTheRestAlone) {
    for (const bool profile : {true, false}) {
        for (const Method method : {Method::Full, Method::Kfr, Method::Acuity}) {
            MethodConfig with = with_seen_depth(method);
            with.hash = true;
            with.profile = profile;
            MethodConfig without = with;
            without.seen_depth = false;
            const FrameRequest frame = request(with, {100.0, 90.0});
            const Rendered a = render(with, frame);
            const Rendered b = render(without, frame);
            EXPECT_EQ(a.gpu.pixel_hash, b.gpu.pixel_hash);
            EXPECT_EQ(a.counts, b.counts);
            for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
                EXPECT_EQ(a.gpu.passes[pass].has_value(), b.gpu.passes[pass].has_value());
            }
        }
    }
}

// Frames in flight: each one's depth is that of its own view and fovea.
TEST_F(SeenDepth, BelongsToTheFrameThatIsFinished) {
    const MethodConfig with = with_seen_depth(Method::Kfr);
    FrameRenderer renderer(context(), scene(), passes_of(with), with);
    gaze::PerEye<vulkan::ColorImage> images;
    gaze::PerEye<vulkan::DepthImage> depths;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        images[e] = vulkan::ColorImage(context(), with.extents[e], with.format,
                                       vk::ImageUsageFlagBits::eColorAttachment);
        depths[e] = vulkan::DepthImage(context(), with.extents[e], with.depth_format);
    }
    std::vector<double> middles_px;
    const auto take_finished = [&] {
        while (renderer.next_finished()) {
            const gaze::DepthPatch& patch = renderer.seen_depth()[0];
            middles_px.push_back(patch.x0_px + patch.columns * patch.step_x_px / 2.0);
        }
    };
    for (int i = 0; i < 8; ++i) {
        FrameRequest frame = request(with, {120.0 + 10.0 * i, 140.0});
        frame.index = static_cast<std::uint64_t>(i);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            frame.targets[e] = {images[e].image(), images[e].view(), depths[e].image(),
                                depths[e].view()};
        }
        renderer.wait_for_slot();
        take_finished();
        renderer.begin(frame);
        renderer.finish(frame.fovea());
    }
    renderer.wait_idle();
    take_finished();
    ASSERT_EQ(middles_px.size(), 8U);
    for (std::size_t i = 0; i < middles_px.size(); ++i) {
        EXPECT_NEAR(middles_px[i], 120.0 + 10.0 * static_cast<double>(i), 2.0);
    }
}

}  // namespace
}  // namespace gazeloop::render
