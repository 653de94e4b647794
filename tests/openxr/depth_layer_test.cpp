// Depth images on their way to a real runtime, filled by a clear, validation on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "runtime/error.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/session/session_file.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/run_once.h"
#include "runtime/vulkan/tracked_image.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::present {
namespace {

using Layout = vk::ImageLayout;

void clear(const vulkan::Context& context, const render::EyeTarget& target, vk::Extent2D extent) {
    vulkan::run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        vulkan::TrackedImage::of_earlier_frames(target.image, vk::ImageAspectFlagBits::eColor)
            .use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        vulkan::TrackedImage::of_earlier_frames(target.depth_image, vk::ImageAspectFlagBits::eDepth)
            .use(commands, vulkan::Use::DepthTarget, vulkan::Keep::Nothing);
        const vk::RenderingAttachmentInfo color(target.view, Layout::eColorAttachmentOptimal, {},
                                                {}, {}, vk::AttachmentLoadOp::eClear,
                                                vk::AttachmentStoreOp::eStore);
        const vk::RenderingAttachmentInfo depth(
            target.depth_view, Layout::eDepthStencilAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
            vk::ClearValue(vk::ClearDepthStencilValue(0.5F, 0)));
        commands.beginRendering(
            vk::RenderingInfo({}, vk::Rect2D({0, 0}, extent), 1, 0, color, &depth));
        commands.endRendering();
    });
}

/// Frames until `rendered` of them were asked for and drawn.
void present_frames(FrameTarget& target, const vulkan::Context& context, int rendered,
                    std::optional<DepthRange> depth) {
    TargetFrame frame;
    int left = rendered;
    for (;;) {
        const TargetState state = target.poll();
        if (state == TargetState::Ended) {
            return;
        }
        if (state == TargetState::Idle) {
            continue;
        }
        frame.depth = depth;
        target.wait_frame(frame);
        target.begin_frame();
        target.locate(frame);
        const bool draw = frame.should_render && left > 0;
        if (draw) {
            const gaze::PerEye<render::EyeTarget> images = target.acquire();
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                clear(context, images[e], target.extents()[e]);
            }
            --left;
        }
        target.end_frame(frame, draw);
        if (left == 0) {
            target.request_exit();
        }
    }
}

class DepthLayer : public testing::Test {
  protected:
    void run(std::optional<DepthRange> depth) {
        const std::string log = scratch_.file("validation.txt");
        setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
        setenv("XR_CORE_VALIDATION_FILE_NAME", log.c_str(), 1);
        display::DisplayProfile display;
        display.fov = {gaze::FieldOfView{-0.8, 0.7, 0.7, -0.7}, {-0.7, 0.8, 0.7, -0.7}};
        display.width_px = 64;
        display.height_px = 48;
        display.refresh_hz = 200.0;
        {
            std::optional<vulkan::Context> context;  // outlives the target
            const auto target =
                make_openxr_target({.display = display, .validation = true, .depth = true});
            context.emplace(vulkan::ContextOptions{.validation = true, .device = ""},
                            target->vulkan_factory());
            target->start(*context);
            ASSERT_EQ(target->depth_format(), vk::Format::eD32Sfloat);
            present_frames(*target, *context, 3, depth);
            EXPECT_EQ(context->validation_messages(), 0U);
        }
        std::ifstream file(log);
        for (std::string line; std::getline(file, line);) {
            EXPECT_EQ(line.find("VUID"), std::string::npos) << line;
        }
    }

    tests::ScratchFolder scratch_;
};

TEST_F(DepthLayer, IsTakenByTheRuntime) { run(DepthRange{0.1F, 100.0F}); }

TEST_F(DepthLayer, MayBeReversedAndEndless) {
    run(DepthRange{std::numeric_limits<float>::infinity(), 0.1F});
}

// The runtime looks at it: a range that is none is refused.
TEST_F(DepthLayer, ReachesTheRuntime) { EXPECT_THROW(run(DepthRange{1.0F, 1.0F}), SetupError); }

TEST_F(DepthLayer, IsLeftOutWhereNobodyFilledIt) { run(std::nullopt); }

TEST_F(DepthLayer, GoesAlongWithTheProgramsPicturesUnlessSwitchedOff) {
    const std::string session = scratch_.file("session.gaze");
    for (const auto& [setting, taken] :
         {std::pair{"render.depth=true", "D32Sfloat"}, {"render.depth=false", "none"}}) {
        const tests::ProgramResult result =
            tests::run_gazeloop({"run", "--frames", "10", "--record", session, "--set", setting,
                                 "--set", "render.scale=0.1", "--set", "vulkan.validation=true"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
        const auto recorded = value_or_throw(session::read_session(session));
        const auto row =
            std::ranges::find(recorded.header.device, "depth layer", &NamedValue::name);
        ASSERT_NE(row, recorded.header.device.end());
        EXPECT_EQ(row->value, taken);
        std::filesystem::remove(session);
    }
}

TEST_F(DepthLayer, IsGoneWithoutWhereItsImagesCannotBeMade) {
    // The colour images come first; then neither eye has depth, whichever's could not be made.
    for (const char* fault : {"xrCreateSwapchain@3=XR_ERROR_OUT_OF_MEMORY",
                              "xrCreateSwapchain@4=XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED"}) {
        const std::string session = scratch_.file("session.gaze");
        const tests::ProgramResult result =
            tests::run_gazeloop({"run", "--frames", "5", "--record", session, "--set",
                                 "render.scale=0.1", "--set", "vulkan.validation=true"},
                                {.environment = tests::openxr_faults(fault)});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_NE(result.err.find("the runtime gets no depth (render.depth=false"),
                  std::string::npos)
            << result.err;
        EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
        const auto recorded = value_or_throw(session::read_session(session));
        EXPECT_EQ(recorded.frames.size(), 5U);
        const auto row =
            std::ranges::find(recorded.header.device, "depth layer", &NamedValue::name);
        ASSERT_NE(row, recorded.header.device.end());
        EXPECT_EQ(row->value, "none");
        std::filesystem::remove(session);
    }
    // A runtime that is gone is another matter.
    const tests::ProgramResult lost = tests::run_gazeloop(
        {"run", "--frames", "5"},
        {.environment = tests::openxr_faults("xrCreateSwapchain@3=XR_ERROR_INSTANCE_LOST")});
    EXPECT_EQ(lost.exit_code, 5) << lost.err;
}

}  // namespace
}  // namespace gazeloop::present
