// When the loop reads the gaze: once the G-buffer is finished, or as soon as that is submitted.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/fixed/fixed_source.h"
#include "runtime/frame_loop.h"
#include "runtime/methods/registry.h"
#include "runtime/present/headless_target.h"
#include "runtime/profiles/profiles.h"
#include "runtime/run/program_settings.h"
#include "runtime/scene/scenes.h"
#include "runtime/time/clock.h"

namespace gazeloop {
namespace {

constexpr std::uint64_t kFrames = 10;
constexpr vk::Extent2D kExtent(96, 96);

/// Of each frame, in their order.
class Frames final : public frame::FrameObserver {
  public:
    void on_frame(const frame::FrameRecord& record) override { records.push_back(record); }
    void on_gpu(const frame::FrameGpuRecord& record) override { gpu.push_back(record); }

    std::vector<frame::FrameRecord> records;
    std::vector<frame::FrameGpuRecord> gpu;
};

struct Ran {
    std::vector<frame::FrameRecord> records;
    std::vector<frame::FrameGpuRecord> gpu;
    frame::PassList passes;

    /// When the last pass that needs no gaze ended; none: the driver relates no clocks.
    [[nodiscard]] std::optional<std::int64_t> geometry_end_ns(std::size_t frame) const {
        const frame::FrameGpuRecord& at = gpu.at(frame);
        const std::size_t sky = passes.find("sky").value();
        if (!at.gpu_begin.known()) {
            return std::nullopt;
        }
        return at.gpu_begin.ns + at.pass_starts[sky].value() + at.passes[sky].value();
    }
    [[nodiscard]] std::vector<std::optional<std::uint64_t>> hashes() const {
        std::vector<std::optional<std::uint64_t>> all;
        for (const frame::FrameGpuRecord& at : gpu) {
            all.push_back(at.pixel_hash);
        }
        return all;
    }
};

/// The loop over a scene by KFR, of a head and eyes that do not move.
Ran run(vulkan::Context& context, const std::string& scene_name, bool wait_before_latch) {
    const display::DisplayProfile display = value_or_throw(profiles::load_display("fove0"));
    present::HeadlessTarget target(
        {.display = display, .extents = {kExtent, kExtent}, .paced = false});
    target.start(context);
    const run::ProgramSettings settings;
    const auto scene = scene::make_scene(context, scene_name);
    render::RendererConfig config;
    config.extents = target.extents();
    config.format = target.format();
    config.hash = true;
    render::FrameRenderer renderer(
        context, *scene,
        value_or_throw(methods::find_method("kfr")->passes(settings.values().methods, settings)),
        config);
    gaze::GazeToFovea gaze{gaze::FoveaPolicy{}};
    Frames frames;
    const LoopParts parts{
        .target = target,
        .renderer = renderer,
        .gaze = gaze,
        .make_timeline = [] { return std::make_unique<LiveTimeline>(time::measured_now().ns); },
        .make_source =
            [](std::int64_t) {
                return std::make_unique<drivers::FixedSource>(drivers::FixedGaze{4.0, -2.0});
            },
        .observers = {&frames}};
    LoopOptions options;
    options.frames = kFrames;
    options.wait_before_latch = wait_before_latch;
    run_frame_loop(parts, options);
    return {.records = std::move(frames.records),
            .gpu = std::move(frames.gpu),
            .passes = renderer.passes()};
}

constexpr const char* kNoClock =
    "the driver does not relate its clock to the host's (VK_EXT_calibrated_timestamps)";

TEST(LateLatch, ReadsTheGazeOnceTheGBufferIsFinished) {
    vulkan::Context context({}, nullptr);
    if (!context.has_calibrated_timestamps()) {
        GTEST_SKIP() << kNoClock;
    }
    const Ran early = run(context, "gallery", false);
    const Ran late = run(context, "gallery", true);
    ASSERT_EQ(early.gpu.size(), kFrames);
    ASSERT_EQ(late.gpu.size(), kFrames);
    std::size_t before_its_end = 0;
    for (std::size_t i = 0; i < kFrames; ++i) {
        const auto end_ns = late.geometry_end_ns(i);
        const auto early_end_ns = early.geometry_end_ns(i);
        ASSERT_TRUE(end_ns && early_end_ns) << "frame " << i;
        const frame::FrameGpuRecord& gpu = late.gpu[i];
        const std::int64_t latch_ns = late.records[i].stamps.latch.ns;
        EXPECT_GE(latch_ns, *end_ns - gpu.clock_deviation_ns.value_or(0)) << "frame " << i;
        // What needs the gaze cannot have begun.
        const std::size_t pass_i = late.passes.find("pass_i").value();
        EXPECT_LE(latch_ns, gpu.gpu_begin.ns + gpu.pass_starts[pass_i].value() +
                                gpu.clock_deviation_ns.value_or(0))
            << "frame " << i;
        before_its_end += early.records[i].stamps.latch.ns < *early_end_ns ? 1 : 0;
    }
    EXPECT_GT(before_its_end, 0U) << "without, it is read while the G-buffer is drawn";
}

// As long as it is the same gaze, when it is read moves no pixel.
TEST(LateLatch, DrawsTheSamePictures) {
    vulkan::Context context({}, nullptr);
    const auto early = run(context, "gallery", false).hashes();
    ASSERT_EQ(early.size(), kFrames);
    EXPECT_TRUE(early.front().has_value());
    EXPECT_EQ(run(context, "gallery", true).hashes(), early);
}

// Where nothing is drawn before the gaze, there is nothing to wait for.
TEST(LateLatch, WaitsForNothingWhereNothingIsDrawnBefore) {
    vulkan::Context context({}, nullptr);
    if (!context.has_calibrated_timestamps()) {
        GTEST_SKIP() << kNoClock;
    }
    const Ran late = run(context, "raymarch", true);
    ASSERT_EQ(late.gpu.size(), kFrames);
    for (std::size_t i = 0; i < kFrames; ++i) {
        const frame::FrameGpuRecord& gpu = late.gpu[i];
        ASSERT_TRUE(gpu.gpu_begin.known()) << "frame " << i;
        EXPECT_LE(late.records[i].stamps.latch.ns,
                  gpu.gpu_begin.ns + gpu.clock_deviation_ns.value_or(0))
            << "frame " << i << ": something was drawn before the gaze was read";
    }
}

}  // namespace
}  // namespace gazeloop
