#include "runtime/render/passes/log_polar_passes.h"

#include <fmt/core.h>

#include <numbers>

#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/render/fovea_depth.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/passes/log_polar_sets.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using Type = vk::DescriptorType;

/// Set 2: the map, then LP-buffer and disc (shaders/resolve/log_polar.frag).
constexpr std::array kBindings{kMapBindings[0],
                               kMapBindings[1],
                               kMapBindings[2],
                               kMapBindings[3],
                               kMapBindings[4],
                               Type::eCombinedImageSampler,
                               Type::eCombinedImageSampler};

/// Constants of the resolve.
enum Constant : std::uint32_t { kFootprintTaps = kOfMethod };

/// Places of the grids in log_polar_grids().
constexpr std::size_t kTexels = 0;
constexpr std::size_t kDisc = 1;

class LogPolarPasses final : public PlannedPasses<foveation::LogPolarMethodPlan> {
  public:
    LogPolarPasses(const PassSetup& setup, std::unique_ptr<foveation::LogPolarMethodPlan> plan)
        : PlannedPasses(setup.lp_gaussian
                            ? frame::PassList{"pass_i", "disc", "lp_gaussian", "resolve"}
                            : frame::PassList{"pass_i", "disc", "resolve"},
                        std::move(plan)),
          setup_(setup) {
        const vk::raii::Device& device = setup.context.device();
        set_layout_ =
            vulkan::make_set_layout(device, kBindings, vk::ShaderStageFlagBits::eFragment);
        layout_ = vulkan::make_pipeline_layout(
            device, {setup.frame_layout, setup.scene.inputs(), *set_layout_}, setup.empty_layout);
        make_pipelines();
        sampler_ = make_lp_sampler(device);
        // With a filter, a second set for the resolve, which then reads what the filter wrote.
        const std::uint32_t sets =
            setup.slots * static_cast<std::uint32_t>(gaze::kEyeCount) * (setup.lp_gaussian ? 2 : 1);
        const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 2 * sets),
                               vk::DescriptorPoolSize(Type::eStorageBuffer, 3 * sets),
                               vk::DescriptorPoolSize(Type::eCombinedImageSampler, 2 * sets)};
        pool_ = vk::raii::DescriptorPool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes));
        if (setup.seen_depth) {
            depths_ = FoveaDepths(setup.context, setup.extents, setup.slots);
        }
        slots_.resize(setup.slots);
        for (auto& slot : slots_) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                EyeSlot& at = slot[e];
                at.uniforms = vulkan::HostBuffer(setup.context, sizeof(foveation::MapUniforms),
                                                 vk::BufferUsageFlagBits::eUniformBuffer);
                at.set = allocate_set();
                if (setup.lp_gaussian) {
                    at.resolve_set = allocate_set();
                }
            }
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            EyeSlot& at = slots_[frame.slot][e];
            at.uniforms.write(std::span(plans[e].uniforms).first(kUniformVectors));
            std::size_t bytes = 0;
            for (const foveation::ShadedGrid& grid : plans[e].grids) {
                at.bands.write(std::span<const foveation::Columns>(grid.bands), bytes);
                bytes += grid.bands.size() * sizeof(foveation::Columns);
            }
        }
        const auto any = [&](std::size_t grid) {
            return !plans[0].grids[grid].tiles.empty() || !plans[1].grids[grid].tiles.empty();
        };
        const auto shade = [&](const vk::raii::CommandBuffer& commands, std::size_t grid) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                shade_tiles(commands, frame, e, grid, plans[e].grids[grid].tiles);
            }
        };
        // A pass without any tile is not submitted for itself; what it has to prepare goes along
        // with the resolve.
        if (any(kTexels)) {
            shade(recorder.begin("pass_i"), kTexels);
        }
        if (any(kDisc)) {
            shade(recorder.begin("disc"), kDisc);
        }
        if (setup_.lp_gaussian && any(kTexels)) {
            const vk::raii::CommandBuffer& commands = recorder.begin("lp_gaussian");
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                smooth_tiles(commands, frame, e, plans[e].grids[kTexels].tiles);
            }
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("resolve");
        for (const std::size_t grid : {kTexels, kDisc}) {
            if (!any(grid)) {
                shade(commands, grid);
            }
        }
        if (setup_.lp_gaussian && !any(kTexels)) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                smooth_tiles(commands, frame, e, {});
            }
        }
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            const EyeSlot& at = slots_[frame.slot][e];
            bind_sets(commands, layout_, frame, e, setup_.lp_gaussian ? *at.resolve_set : *at.set);
            draw_resolve(commands, plans[e], frame.view.hidden[e].get());
        });
    }

    [[nodiscard]] double row_angle_rad(gaze::Eye eye) const override {
        return 2.0 * std::numbers::pi / plan().lp(eye).height;
    }

    [[nodiscard]] bool keeps_depth() const override { return setup_.seen_depth; }

    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            depths_.of(frame.slot, e)
                .record(commands, eyes_[e]->direct_buffer().tracked, frame.view.views[e],
                        fovea.eyes[e].position, plans[e].grids[kDisc].bands);
        }
    }

    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        depths_.collect(slot, seen);
    }

    [[nodiscard]] std::vector<BufferPicture> buffers(
        gaze::Eye eye, const foveation::EyePlan& plan) const override {
        const auto& at = eyes_[gaze::index(eye)];
        if (!at || plan.grids[kTexels].tiles.empty()) {
            return {};
        }
        return {{"lp", &at->lp_buffer().image, &plan.grids[kTexels]}};
    }

  private:
    static constexpr std::size_t kUniformVectors =
        sizeof(foveation::MapUniforms) / sizeof(glm::vec4);

    /// What a frame owns until the GPU has finished it.
    struct EyeSlot {
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer bands;
        vk::raii::DescriptorSet set{nullptr};
        vk::raii::DescriptorSet resolve_set{nullptr};  ///< only with a filter
    };

    [[nodiscard]] vk::raii::DescriptorSet allocate_set() const {
        return std::move(vk::raii::DescriptorSets(
            setup_.context.device(), vk::DescriptorSetAllocateInfo(*pool_, *set_layout_))[0]);
    }

    void attach() override {
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            eyes_[e].emplace(setup_.context, plan().tables(eye), plan().lp(eye), setup_.extents[e],
                             setup_.samples, setup_.lp_gaussian);
            attach_eye(e);
        }
    }

    void make_pipelines() {
        const vk::raii::Device& device = setup_.context.device();
        const std::uint32_t in_gaze_frame = plan().in_gaze_frame() ? 1 : 0;
        const std::uint32_t jittered = setup_.antialiasing.over_frames ? 1 : 0;
        const auto pass_constants = with_scene(
            setup_.scene,
            {{kSamples, setup_.samples}, {kInGazeFrame, in_gaze_frame}, {kJittered, jittered}});
        pass_i_ = vulkan::make_pipeline(
            device, layout_,
            {.vertex = "tiles.vert",
             .fragment = fmt::format("{}.log_polar.frag", setup_.scene.shader()),
             .format = kLpFormat,
             .constants = pass_constants});
        if (setup_.lp_gaussian) {
            lp_gaussian_ = vulkan::make_pipeline(device, layout_,
                                                 {.vertex = "full_screen.vert",
                                                  .fragment = "lp_gaussian.frag",
                                                  .format = kLpFormat});
        }
        const std::string resolve = resolve_shader("log_polar", setup_);
        for (const std::uint32_t disc : {0U, 1U}) {
            const std::array constants{
                vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup_.format) ? 0U : 1U},
                vulkan::ShaderConstant{kInGazeFrame, in_gaze_frame},
                vulkan::ShaderConstant{kWithDisc, disc},
                vulkan::ShaderConstant{kJittered, jittered},
                vulkan::ShaderConstant{kFootprintTaps, setup_.antialiasing.footprint_taps}};
            (disc == 1 ? resolve_disc_ : resolve_) =
                vulkan::make_pipeline(device, layout_,
                                      {.vertex = "full_screen.vert",
                                       .fragment = resolve,
                                       .format = setup_.format,
                                       .depth_format = setup_.depth_format,
                                       .constants = constants});
        }
    }

    /// Lets the sets of all slots read an eye's tables and buffers.
    void attach_eye(std::size_t e) {
        LogPolarEye& eye = *eyes_[e];
        for (auto& slot : slots_) {
            EyeSlot& at = slot[e];
            at.bands =
                vulkan::HostBuffer(setup_.context, eye.max_bands() * sizeof(foveation::Columns),
                                   vk::BufferUsageFlagBits::eStorageBuffer);
            write_set(*at.set, at, eye, eye.lp_buffer());
            if (setup_.lp_gaussian) {
                write_set(*at.resolve_set, at, eye, eye.smoothed_buffer());
            }
        }
    }

    void write_set(vk::DescriptorSet set, const EyeSlot& at, LogPolarEye& eye,
                   const LogPolarEye::Buffer& lp_buffer) const {
        const vk::raii::Device& device = setup_.context.device();
        write_map(device, set, at.uniforms.buffer(), eye.map_buffers(), at.bands.buffer());
        std::uint32_t binding = kMapBindings.size();
        for (const LogPolarEye::Buffer* image :
             {&lp_buffer, static_cast<const LogPolarEye::Buffer*>(&eye.direct_buffer())}) {
            write_image(device, set, binding++, *sampler_, image->image.view());
        }
    }

    /// Shades tiles of one eye into a buffer and makes it readable for the resolve. Tiles may be
    /// none: the resolve then reads nothing of it, but its layout must be right.
    void shade_tiles(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                     std::size_t e, std::size_t grid, std::span<const foveation::Tile> tiles) {
        LogPolarEye::Buffer& target =
            grid == kDisc ? eyes_[e]->direct_buffer() : eyes_[e]->lp_buffer();
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pass_i_);
        bind_sets(commands, layout_, frame, e, *slots_[frame.slot][e].set);
        shade_cells(commands, target, tiles, grid == kDisc ? 1 : 0, setup_.unshaded);
    }

    /// Smooths an eye's LP-buffer into its second one and makes that readable. As shade_tiles.
    void smooth_tiles(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                      std::size_t e, std::span<const foveation::Tile> tiles) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *lp_gaussian_);
        bind_sets(commands, layout_, frame, e, *slots_[frame.slot][e].set);
        shade_cells(commands, eyes_[e]->smoothed_buffer(), tiles, 0, setup_.unshaded);
    }

    /// The whole picture from the LP-buffer, then the disc over it.
    void draw_resolve(const vk::raii::CommandBuffer& commands, const foveation::EyePlan& plan,
                      const foveation::HiddenArea* hidden) const {
        if (!plan.grids[kTexels].tiles.empty()) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_);
            draw_visible(commands, hidden);
        }
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_disc_);
        // Hidden pixels of the disc were not shaded: what lies in their places must not show.
        draw_visible_tiles(commands, plan.grids[kDisc].tiles, hidden);
    }

    PassSetup setup_;
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::Pipeline pass_i_{nullptr};
    vk::raii::Pipeline lp_gaussian_{nullptr};  ///< null: without the filter
    vk::raii::Pipeline resolve_{nullptr};
    vk::raii::Pipeline resolve_disc_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    gaze::PerEye<std::optional<LogPolarEye>> eyes_;
    std::vector<gaze::PerEye<EyeSlot>> slots_;
    FoveaDepths depths_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_kfr_passes(const PassSetup& setup,
                                              const foveation::KfrParameters& parameters) {
    for (const vk::Extent2D extent : setup.extents) {
        // Checked now, not with the first frame, because it does not depend on the fields of view.
        (void)value_or_throw(foveation::lp_buffer_size(parameters, {extent.width, extent.height}));
    }
    return std::make_unique<LogPolarPasses>(setup,
                                            std::make_unique<foveation::KfrPlan>(parameters));
}

std::unique_ptr<MethodPasses> make_acuity_passes(const PassSetup& setup,
                                                 const foveation::AcuityParameters& parameters) {
    return std::make_unique<LogPolarPasses>(setup,
                                            std::make_unique<foveation::AcuityPlan>(parameters));
}

}  // namespace gazeloop::render
