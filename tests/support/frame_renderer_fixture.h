#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "runtime/render/frame_renderer.h"
#include "runtime/render/picture.h"

namespace gazeloop::render {

using Pictures = gaze::PerEye<Picture>;

/// Renders single frames off screen on one validated device; every test ends with no message.
class FrameRendererTest : public testing::Test {
  protected:
    static vulkan::Context& context() {
        static vulkan::Context context({.validation = true, .device = ""}, nullptr);
        return context;
    }

    void TearDown() override { EXPECT_EQ(context().validation_messages(), 0U); }

    static RendererConfig config(Method method, std::uint32_t width = 160,
                                 std::uint32_t height = 120) {
        RendererConfig config;
        config.method = method;
        config.extents = {vk::Extent2D(width, height), vk::Extent2D(width, height)};
        return config;
    }

    /// Both eyes from where a head at the origin has them; both foveae at the same position.
    static FrameRequest request(const RendererConfig& config, gaze::PixelPosition fovea) {
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
        gaze::PerEye<foveation::SamplingPlan> plans;
    };

    static Rendered render(const RendererConfig& config, FrameRequest request) {
        FrameRenderer renderer(context(), config);
        const bool depth = config.depth_format != vk::Format::eUndefined;
        gaze::PerEye<vulkan::ColorImage> images;
        gaze::PerEye<vulkan::DepthImage> depths;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            images[e] = vulkan::ColorImage(
                context(), config.extents[e], config.format,
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
            request.targets[e] = {images[e].image(), images[e].view()};
            if (depth) {
                depths[e] = vulkan::DepthImage(context(), config.extents[e], config.depth_format);
                request.targets[e].depth_image = depths[e].image();
                request.targets[e].depth_view = depths[e].view();
            }
        }
        Rendered rendered;
        rendered.passes = renderer.passes();
        renderer.wait_for_slot();
        rendered.counts = renderer.render(request);
        renderer.wait_idle();
        const auto finished = renderer.next_finished();
        EXPECT_TRUE(finished.has_value());
        rendered.gpu = finished.value_or(frame::FrameGpuRecord{});
        rendered.seen_depth = renderer.seen_depth();
        EXPECT_FALSE(renderer.next_finished().has_value());
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            rendered.pictures[e] =
                read_back(context(), images[e].image(), config.extents[e], config.format,
                          vk::ImageLayout::eColorAttachmentOptimal);
            if (depth) {
                rendered.depths[e] = read_back_depth(context(), depths[e]);
            }
            rendered.plans[e] = renderer.last_plan(gaze::kEyes[e]);
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
