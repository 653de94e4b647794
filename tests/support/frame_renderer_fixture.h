#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "runtime/render/off_screen.h"
#include "runtime/render/picture.h"
#include "runtime/scene/scenes.h"
#include "tests/support/rendered_method.h"

namespace gazeloop::render {

using Pictures = gaze::PerEye<Picture>;

/// Renders single frames off screen on one validated device; every test ends with no message.
class FrameRendererTest : public testing::Test {
  protected:
    static vulkan::Context& context() {
        static vulkan::Context context({.validation = true, .device = ""}, nullptr);
        return context;
    }
    static scene::Scene& scene() {
        static const std::unique_ptr<scene::Scene> made = scene::make_scene(context(), "raymarch");
        return *made;
    }

    void TearDown() override { EXPECT_EQ(context().validation_messages(), 0U); }

    static MethodConfig config(Method method, std::uint32_t width = 160,
                               std::uint32_t height = 120) {
        MethodConfig config;
        config.method = method;
        config.extents = {vk::Extent2D(width, height), vk::Extent2D(width, height)};
        return config;
    }

    /// Both eyes from where a head at the origin has them; both foveae at the same position.
    static FrameRequest request(const MethodConfig& config, gaze::PixelPosition fovea) {
        FrameRequest request;
        request.scene_time_s = 2.5;
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            request.views[e] = {
                .pose = {.position_m = {eye == gaze::Eye::Left ? -0.0315 : 0.0315, 0, 0}},
                .fov = {-0.8, 0.8, 0.7, -0.7},
                .width_px = config.extents[e].width,
                .height_px = config.extents[e].height};
            request.foveae[e] = fovea;
            request.gaze_directions[e] = gaze::unproject(fovea, request.views[e]);
        }
        return request;
    }

    struct Rendered {
        Pictures pictures;
        gaze::PerEye<std::vector<float>> depths;  ///< where the configuration has a depth format
        frame::SampleCounts counts;
        frame::FrameGpuRecord gpu;
        frame::PassList passes;  ///< as they name those of gpu
        gaze::SeenDepth seen_depth;
        gaze::PerEye<foveation::LogPolarPlan> plans;  ///< of log-polar methods
    };

    static Rendered render(const MethodConfig& config, const FrameRequest& request) {
        OffScreen off_screen(context(), scene(), passes_of(config), config);
        const OffScreen::Rendered done = off_screen.render(request.frame_view(), request.fovea());
        Rendered rendered;
        rendered.passes = off_screen.renderer().passes();
        rendered.counts = done.counts;
        rendered.gpu = done.gpu;
        rendered.seen_depth = off_screen.renderer().seen_depth();
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            rendered.pictures[e] = off_screen.picture(eye);
            if (config.depth_format != vk::Format::eUndefined) {
                rendered.depths[e] = off_screen.depth(eye);
            }
            rendered.plans[e] = plan_of(config, request, eye);
        }
        return rendered;
    }

    static int largest_difference(const Picture& a, const Picture& b) {
        int largest = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
            }
        }
        return largest;
    }
};

}  // namespace gazeloop::render
