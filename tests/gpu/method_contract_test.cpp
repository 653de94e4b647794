// What every method that is rendered keeps, by the registry: a new one is tested by being listed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>

#include "runtime/methods/registry.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/method_by_settings.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::render {
namespace {

/// Settings by which a method is to give full resolution. A new method states its own here.
const std::map<std::string, std::vector<NamedValue>> kEverything{
    {"full", {}},
    {"kfr", {{"kfr.sigma", "0.5"}}},
    {"acuity", {{"acuity.mar", "0.0001"}}},
    {"rings", {{"rings.inner_deg", "180"}, {"rings.outer_deg", "180"}}},
    {"sparse", {{"sparse.share", "1"}}},
    {"layers", {{"acuity.mar", "0.0001"}, {"layers.temporal", "false"}}},
    {"quad", {{"quad.section", "1"}}},
    {"kfr3d", {{"kfr.sigma", "0.5"}}},
    {"interleaved",
     {{"kfr.sigma", "0.5"}, {"interleaved.every", "1"}, {"interleaved.disc_every", "1"}}},
    {"fixed", {{"kfr.sigma", "0.5"}}}};

struct Situation {
    const char* name;
    gaze::FieldOfView fov;
    double cant_deg;
    gaze::PixelPosition fovea;  ///< in shares of the picture
};

constexpr gaze::FieldOfView kEven{-0.8, 0.8, 0.7, -0.7};
constexpr gaze::FieldOfView kUneven{-0.9, 0.6, 0.55, -0.75};

const std::array kSituations{Situation{"middle", kEven, 0.0, {0.5, 0.5}},
                             Situation{"edge", kEven, 0.0, {0.0, 0.5}},
                             Situation{"corner", kEven, 0.0, {1.0, 1.0}},
                             Situation{"outside", kEven, 0.0, {-0.4, 0.3}},
                             Situation{"far_outside", kEven, 0.0, {30.0, -4.0}},
                             Situation{"uneven", kUneven, 0.0, {0.6, 0.4}},
                             Situation{"canted", kUneven, 10.0, {0.4, 0.6}}};

class MethodContract : public FrameRendererTest, public testing::WithParamInterface<std::string> {
  protected:
    [[nodiscard]] static const methods::Method& method() {
        return *methods::find_method(GetParam());
    }

    static RendererConfig pictures(std::uint32_t width, std::uint32_t height) {
        RendererConfig config;
        config.extents = {vk::Extent2D(width, height), vk::Extent2D(width, height)};
        config.hash = true;
        return config;
    }

    static FrameRequest frame(const Situation& at, const RendererConfig& config) {
        FrameRequest frame;
        frame.scene_time_s = 2.5;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const double cant_rad =
                (e == 0 ? 1.0 : -1.0) * at.cant_deg * (std::numbers::pi / 180.0);
            frame.views[e] = {
                .pose = {.orientation = glm::angleAxis(cant_rad, glm::dvec3(0.0, 1.0, 0.0)),
                         .position_m = {e == 0 ? -0.0315 : 0.0315, 0.0, 0.0}},
                .fov = at.fov,
                .width_px = config.extents[e].width,
                .height_px = config.extents[e].height};
            frame.foveae[e] = {at.fovea.x_px * config.extents[e].width,
                               at.fovea.y_px * config.extents[e].height};
            frame.gaze_directions[e] = gaze::unproject(frame.foveae[e], frame.views[e]);
        }
        return frame;
    }

    static OffScreen::Rendered draw(const RendererConfig& config, const FrameRequest& frame) {
        OffScreen off_screen(context(), scene(), tests::passes_by(GetParam()), config);
        return off_screen.render(frame.frame_view(), frame.fovea());
    }

    static void expect_counts_add_up(const frame::SampleCounts& counts, std::string_view where) {
        EXPECT_GT(counts.grid_count, 0U);
        for (const frame::GridCounts& grid : counts.used()) {
            EXPECT_EQ(grid.planned, grid.shaded + grid.off_screen + grid.covered + grid.hidden)
                << where;
        }
        EXPECT_LE(counts.pixels_hidden, counts.pixels_output) << where;
    }
};

TEST_P(MethodContract, GivesTheSamePictureEveryTimeAndCountsWhatItShades) {
    const RendererConfig config = pictures(96, 72);
    for (const Situation& at : kSituations) {
        const FrameRequest request = frame(at, config);
        const OffScreen::Rendered first = draw(config, request);
        ASSERT_TRUE(first.gpu.pixel_hash.has_value());
        EXPECT_EQ(draw(config, request).gpu.pixel_hash, first.gpu.pixel_hash) << at.name;
        expect_counts_add_up(first.counts, at.name);
        EXPECT_EQ(first.counts.pixels_output, 2U * 96 * 72);
    }
}

TEST_P(MethodContract, ReadsNoCellThatWasNotShaded) {
    RendererConfig config = pictures(96, 72);
    for (const Situation& at : kSituations) {
        const FrameRequest request = frame(at, config);
        config.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
        const auto on_black = draw(config, request).gpu.pixel_hash;
        config.unshaded = {5e4F, 0.0F, 5e4F, 1.0F};
        EXPECT_EQ(draw(config, request).gpu.pixel_hash, on_black) << at.name;
    }
}

TEST_P(MethodContract, KeepsItsColoursWithDepthAndWithoutProfiling) {
    const RendererConfig config = pictures(96, 72);
    RendererConfig with_depth = config;
    with_depth.depth_format = vk::Format::eD32Sfloat;
    RendererConfig unprofiled = config;
    unprofiled.profile = false;
    for (const Situation& at : kSituations) {
        const FrameRequest request = frame(at, config);
        const auto plain = draw(config, request).gpu.pixel_hash;
        EXPECT_EQ(draw(with_depth, request).gpu.pixel_hash, plain) << at.name;
        EXPECT_EQ(draw(unprofiled, request).gpu.pixel_hash, plain) << at.name;
    }
}

TEST_P(MethodContract, TakesWhatFollowsItsPicture) {
    RendererConfig config = pictures(96, 72);
    config.antialiasing = {.post_filter_px = 9, .footprint_taps = 2, .over_frames = true};
    for (const Situation& at : kSituations) {
        const auto third = [&](float poison) {
            config.unshaded = {poison, 0.0F, poison, 1.0F};
            OffScreen off_screen(context(), scene(), tests::passes_by(GetParam()), config);
            FrameRequest request = frame(at, config);
            std::optional<std::uint64_t> hash;
            for (request.index = 0; request.index < 3; ++request.index) {
                const OffScreen::Rendered done =
                    off_screen.render(request.frame_view(), request.fovea());
                expect_counts_add_up(done.counts, at.name);
                hash = done.gpu.pixel_hash;
            }
            return hash;
        };
        const auto on_black = third(0.0F);
        ASSERT_TRUE(on_black.has_value());
        EXPECT_EQ(third(0.0F), on_black) << at.name;
        EXPECT_EQ(third(5e4F), on_black) << at.name;
    }
}

TEST_P(MethodContract, LeavesOutWhatNoEyeSees) {
    const RendererConfig config = pictures(96, 72);
    constexpr double kEdge = std::numbers::pi / 4.0;  // the masks are those of such a view
    FrameRequest request =
        frame({"square", {-kEdge, kEdge, kEdge, -kEdge}, 0.0, {0.5, 0.5}}, config);
    const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
    (*meshes)[0] = tests::cut_corners(0.5);
    (*meshes)[1] = tests::cut_corners(0.5);
    request.hidden = foveation::hidden_areas(meshes, request.views);
    ASSERT_NE(request.hidden[0], nullptr);
    OffScreen off_screen(context(), scene(), tests::passes_by(GetParam()), config);
    const frame::SampleCounts counts =
        off_screen.render(request.frame_view(), request.fovea()).counts;
    expect_counts_add_up(counts, "hidden");
    EXPECT_GT(counts.pixels_hidden, 0U);
    const Picture masked = off_screen.picture(gaze::Eye::Left);
    request.hidden = {};
    off_screen.render(request.frame_view(), request.fovea());
    const Picture whole = off_screen.picture(gaze::Eye::Left);
    EXPECT_EQ(masked.pixels[0], (std::array<std::uint8_t, 3>{0, 0, 0})) << "a corner";
    const std::size_t middle = std::size_t{36} * 96 + 48;
    EXPECT_EQ(masked.pixels[middle], whole.pixels[middle]);
}

TEST_P(MethodContract, IsFullResolutionWhereItIsAskedForEverything) {
    ASSERT_TRUE(kEverything.contains(GetParam())) << "which settings ask it for everything?";
    const RendererConfig config = pictures(16, 16);
    const FrameRequest request = frame(kSituations[0], config);
    OffScreen all(context(), scene(), tests::passes_by(GetParam(), kEverything.at(GetParam())),
                  config);
    OffScreen full(context(), scene(), tests::passes_by("full"), config);
    all.render(request.frame_view(), request.fovea());
    full.render(request.frame_view(), request.fovea());
    for (const gaze::Eye eye : gaze::kEyes) {
        // 16-bit floats in between may round the other way.
        EXPECT_LE(largest_difference(all.picture(eye), full.picture(eye)), 1);
    }
}

TEST_P(MethodContract, TakesEverySize) {
    for (const auto& [width, height] :
         {std::pair{2U, 2U}, {3U, 2U}, {2U, 7U}, {33U, 17U}, {127U, 5U}, {1U, 1U}}) {
        const RendererConfig config = pictures(width, height);
        const FrameRequest request = frame(kSituations[0], config);
        try {
            expect_counts_add_up(draw(config, request).counts, "size");
        } catch (const SetupError& error) {
            // A picture may be too small for a map, which is said with the setting that would help.
            EXPECT_LT(std::min(width, height), 8U) << error.what();
            EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr(GetParam() + "."),
                                                     testing::HasSubstr(GetParam() + ": "),
                                                     testing::HasSubstr("must have 2 to"),
                                                     testing::HasSubstr("kfr.")));
            EXPECT_EQ(error.kind(), ErrorKind::Usage);
        }
    }
}

TEST_P(MethodContract, ListsItsPassesAndTimesThoseThatRan) {
    const RendererConfig config = pictures(96, 72);
    const FrameRequest request = frame(kSituations[0], config);
    OffScreen off_screen(context(), scene(), tests::passes_by(GetParam()), config);
    const frame::FrameGpuRecord gpu = off_screen.render(request.frame_view(), request.fovea()).gpu;
    const frame::PassList& listed = off_screen.renderer().passes();
    ASSERT_GT(listed.size(), 0U);
    EXPECT_GT(off_screen.renderer().grids().size(), 0U);
    bool any = false;
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        EXPECT_TRUE(pass < listed.size() || !gpu.passes[pass]) << pass;
        any = any || gpu.passes[pass].has_value();
    }
    EXPECT_TRUE(any);
    EXPECT_TRUE(gpu.gpu_end.known());
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodContract, testing::ValuesIn(methods::rendered_methods()),
                         [](const auto& instance) { return instance.param; });

/// As raymarch, with something to draw before it can be asked, as meshes have.
class SceneWithGeometry final : public scene::Scene {
  public:
    explicit SceneWithGeometry(const vulkan::Context& context)
        : image_(context, {64, 64}, vk::Format::eR8G8B8A8Unorm,
                 vk::ImageUsageFlagBits::eColorAttachment),
          tracked_(image_.image(), vk::ImageAspectFlagBits::eColor) {}
    [[nodiscard]] std::string_view shader() const override { return "raymarch"; }
    [[nodiscard]] frame::PassList passes() const override { return {"geometry"}; }
    void record_geometry(vulkan::PassRecorder& recorder, const gaze::StereoView& /*views*/,
                         double /*time_s*/, std::size_t /*slot*/) override {
        const vk::raii::CommandBuffer& commands = recorder.begin("geometry");
        tracked_.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        const vk::RenderingAttachmentInfo color(
            image_.view(), vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
        commands.beginRendering(
            vk::RenderingInfo({}, vk::Rect2D({0, 0}, image_.extent()), 1, 0, color));
        commands.endRendering();
        ++recorded;
    }
    int recorded = 0;

  private:
    vulkan::ColorImage image_;
    vulkan::TrackedImage tracked_;
};

// What needs no gaze is with the GPU before the gaze is read, and changes nothing of the picture.
TEST_P(MethodContract, LetsASceneDrawBeforeTheGazeIsRead) {
    for (const bool profile : {true, false}) {
        RendererConfig config = pictures(96, 72);
        config.profile = profile;
        const FrameRequest request = frame(kSituations[0], config);
        const auto plain = draw(config, request).gpu.pixel_hash;
        SceneWithGeometry with_geometry(context());
        OffScreen off_screen(context(), with_geometry, tests::passes_by(GetParam()), config);
        FrameRenderer& renderer = off_screen.renderer();
        EXPECT_EQ(renderer.passes()[0], "geometry");
        const OffScreenTargets targets(context(), config.extents, config.format);
        FrameView view = request;
        view.targets = targets.targets();
        renderer.wait_for_slot();
        renderer.begin(view);
        EXPECT_EQ(with_geometry.recorded, 1);
        renderer.wait_for_begun();
        EXPECT_FALSE(renderer.next_finished().has_value()) << "it is half a frame yet";
        renderer.finish(request.fovea());
        renderer.wait_idle();
        const auto finished = renderer.next_finished();
        ASSERT_TRUE(finished.has_value());
        EXPECT_EQ(finished->pixel_hash, plain);
        EXPECT_EQ(finished->passes[0].has_value(), profile);
        EXPECT_TRUE(finished->gpu_end.known());
    }
}

}  // namespace
}  // namespace gazeloop::render
