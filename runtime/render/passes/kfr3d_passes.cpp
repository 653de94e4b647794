#include "runtime/render/passes/kfr3d_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <vector>

#include "runtime/render/fovea_depth.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/passes/log_polar_sets.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using foveation::Kfr3dPlan;
using Type = vk::DescriptorType;

constexpr std::uint32_t kMostRegions = foveation::Kfr3dParameters::kMostRegions;

/// Set 2 beyond the map (shaders/resolve/kfr3d.frag, lib/view_regions.glsl).
constexpr std::uint32_t kLpBuffers = kMapBindings.size();
constexpr std::uint32_t kDirectBuffer = kLpBuffers + kMostRegions;
constexpr std::uint32_t kViews = kDirectBuffer + 1;

/// Constants of the resolve.
enum Constant : std::uint32_t { kRegions = kOfMethod };

std::vector<Type> bindings() {
    std::vector<Type> all(kMapBindings.begin(), kMapBindings.end());
    all.insert(all.end(), kMostRegions + 1, Type::eCombinedImageSampler);
    all.push_back(Type::eStorageBuffer);
    return all;
}

light_field::LightField field_of(const scene::Scene& scene) {
    const light_field::LightField* const field = scene.light_field();
    return field != nullptr ? *field : light_field::LightField{};
}

class Kfr3dPasses final : public PlannedPasses<Kfr3dPlan> {
  public:
    Kfr3dPasses(const PassSetup& setup, const foveation::Kfr3dParameters& parameters)
        : PlannedPasses(setup.lp_gaussian
                            ? frame::PassList{"pass_i", "disc", "lp_gaussian", "resolve"}
                            : frame::PassList{"pass_i", "disc", "resolve"},
                        std::make_unique<Kfr3dPlan>(parameters, field_of(setup.scene))),
          setup_(setup),
          regions_(parameters.regions),
          set_layout_(vulkan::make_set_layout(setup.context.device(), bindings(),
                                              vk::ShaderStageFlagBits::eFragment)),
          layout_(vulkan::make_pipeline_layout(
              setup.context.device(), {setup.frame_layout, setup.scene.inputs(), *set_layout_},
              setup.empty_layout)),
          sampler_(make_lp_sampler(setup.context.device())) {
        make_pipelines();
        make_slots();
        if (setup.seen_depth) {
            depths_ = FoveaDepths(setup.context, setup.extents, setup.slots);
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            write_plan(slots_[frame.slot][e], gaze::kEyes.at(e), plans[e]);
        }
        const auto has_tiles = [&](std::size_t grid) {
            return !plans[0].grids[grid].tiles.empty() || !plans[1].grids[grid].tiles.empty();
        };
        bool any_texel = false;
        for (std::size_t region = 0; region < regions_; ++region) {
            any_texel = any_texel || has_tiles(region);
        }
        const bool any_pixel = has_tiles(plan().disc_grid());
        const auto for_texels = [&](const vk::raii::CommandBuffer& commands,
                                    const vk::raii::Pipeline& pipeline, bool smooth) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                for (std::uint32_t region = 0; region < regions_; ++region) {
                    bind_sets(commands, layout_, frame, e,
                              *slots_[frame.slot][e].regions[region].set);
                    LogPolarEye& eye = eyes_[e][region];
                    shade_cells(commands, smooth ? eye.smoothed_buffer() : eye.lp_buffer(),
                                plans[e].grids[region].tiles, region, setup_.unshaded);
                }
            }
        };
        const auto shade_disc = [&](const vk::raii::CommandBuffer& commands) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pass_i_);
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                bind_sets(commands, layout_, frame, e, *slots_[frame.slot][e].regions[0].set);
                shade_cells(commands, eyes_[e][0].direct_buffer(),
                            plans[e].grids[plan().disc_grid()].tiles, kMostRegions,
                            setup_.unshaded);
            }
        };
        // A pass without any tile is not submitted for itself; what it has to prepare goes along
        // with the resolve.
        if (any_texel) {
            for_texels(recorder.begin("pass_i"), pass_i_, false);
        }
        if (any_pixel) {
            shade_disc(recorder.begin("disc"));
        }
        if (any_texel && setup_.lp_gaussian) {
            for_texels(recorder.begin("lp_gaussian"), lp_gaussian_, true);
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("resolve");
        if (!any_pixel) {
            shade_disc(commands);
        }
        if (!any_texel) {
            for_texels(commands, pass_i_, false);
            if (setup_.lp_gaussian) {
                for_texels(commands, lp_gaussian_, true);
            }
        }
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, layout_, frame, e, *slots_[frame.slot][e].resolve_set);
            draw_resolve(commands, plans[e], frame.view.hidden[e].get());
        });
    }

    [[nodiscard]] double row_angle_rad(gaze::Eye eye) const override {
        return 2.0 * std::numbers::pi / plan().lp(eye, 0).height;
    }

    [[nodiscard]] bool keeps_depth() const override { return setup_.seen_depth; }

    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            depths_.of(frame.slot, e)
                .record(commands, eyes_[e][0].direct_buffer().tracked, frame.view.views[e],
                        fovea.eyes[e].position, plans[e].grids[plan().disc_grid()].bands);
        }
    }

    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        depths_.collect(slot, seen);
    }

    [[nodiscard]] std::vector<BufferPicture> buffers(
        gaze::Eye eye, const foveation::EyePlan& made) const override {
        std::vector<BufferPicture> pictures;
        const auto& regions = eyes_[gaze::index(eye)];
        for (std::size_t region = 0; region < regions.size(); ++region) {
            if (!made.grids[region].tiles.empty()) {
                pictures.push_back({plan().grids()[region], &regions[region].lp_buffer().image,
                                    &made.grids[region]});
            }
        }
        return pictures;
    }

  private:
    /// What a frame owns until the GPU has finished it.
    struct RegionSlot {
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer bands;
        vk::raii::DescriptorSet set{nullptr};
    };
    struct EyeSlot {
        std::vector<RegionSlot> regions;
        vulkan::HostBuffer views;
        vk::raii::DescriptorSet resolve_set{nullptr};
    };

    void make_pipelines() {
        const vk::raii::Device& device = setup_.context.device();
        const auto pass_constants = with_scene(setup_.scene, {{kSamples, setup_.samples}});
        pass_i_ =
            vulkan::make_pipeline(device, layout_,
                                  {.vertex = "tiles.vert",
                                   .fragment = fmt::format("{}.kfr3d.frag", setup_.scene.shader()),
                                   .format = kLpFormat,
                                   .constants = pass_constants});
        if (setup_.lp_gaussian) {
            lp_gaussian_ = vulkan::make_pipeline(device, layout_,
                                                 {.vertex = "full_screen.vert",
                                                  .fragment = "lp_gaussian.frag",
                                                  .format = kLpFormat});
        }
        const std::string resolve = resolve_shader("kfr3d", setup_);
        for (const std::uint32_t disc : {0U, 1U}) {
            const std::array constants{
                vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup_.format) ? 0U : 1U},
                vulkan::ShaderConstant{kWithDisc, disc},
                vulkan::ShaderConstant{kRegions, regions_}};
            (disc == 1 ? resolve_disc_ : resolve_) =
                vulkan::make_pipeline(device, layout_,
                                      {.vertex = "full_screen.vert",
                                       .fragment = resolve,
                                       .format = setup_.format,
                                       .depth_format = setup_.depth_format,
                                       .constants = constants});
        }
    }

    void make_slots() {
        const vk::raii::Device& device = setup_.context.device();
        const std::uint32_t sets =
            setup_.slots * static_cast<std::uint32_t>(gaze::kEyeCount) * (regions_ + 1);
        const std::array sizes{
            vk::DescriptorPoolSize(Type::eUniformBuffer, 2 * sets),
            vk::DescriptorPoolSize(Type::eStorageBuffer, 4 * sets),
            vk::DescriptorPoolSize(Type::eCombinedImageSampler, (kMostRegions + 1) * sets)};
        pool_ = vk::raii::DescriptorPool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes));
        const auto allocate = [&] {
            return std::move(vk::raii::DescriptorSets(
                device, vk::DescriptorSetAllocateInfo(*pool_, *set_layout_))[0]);
        };
        slots_.resize(setup_.slots);
        for (auto& slot : slots_) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                EyeSlot& at = slot[e];
                at.regions.resize(regions_);
                for (RegionSlot& region : at.regions) {
                    region.uniforms =
                        vulkan::HostBuffer(setup_.context, sizeof(foveation::MapUniforms),
                                           vk::BufferUsageFlagBits::eUniformBuffer);
                    region.set = allocate();
                }
                at.views =
                    vulkan::HostBuffer(setup_.context, plan().table_words() * sizeof(std::uint32_t),
                                       vk::BufferUsageFlagBits::eStorageBuffer);
                at.resolve_set = allocate();
            }
        }
    }

    void attach() override {
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t e = gaze::index(eye);
            eyes_[e].clear();
            for (std::uint32_t region = 0; region < regions_; ++region) {
                const foveation::LpSize lp = plan().lp(eye, region);
                // The disc is shaded into the first one's direct buffer.
                eyes_[e].emplace_back(
                    setup_.context, foveation::build_map_tables(plan().parameters().kfr.kernel, lp),
                    lp, region == 0 ? setup_.extents[e] : vk::Extent2D(1, 1), setup_.samples,
                    setup_.lp_gaussian);
            }
            for (auto& slot : slots_) {
                attach_slot(slot[e], eyes_[e]);
            }
        }
    }

    void attach_slot(EyeSlot& at, std::vector<LogPolarEye>& eye) const {
        const auto write = [&](vk::DescriptorSet set, std::size_t region, const auto& lp_of) {
            const vk::raii::Device& device = setup_.context.device();
            write_map(device, set, at.regions[region].uniforms.buffer(), eye[region].map_buffers(),
                      at.regions[region].bands.buffer());
            for (std::uint32_t i = 0; i < kMostRegions; ++i) {
                write_image(device, set, kLpBuffers + i, *sampler_, lp_of(i).image.view());
            }
            write_image(device, set, kDirectBuffer, *sampler_, eye[0].direct_buffer().image.view());
            const vk::DescriptorBufferInfo info(at.views.buffer(), 0, VK_WHOLE_SIZE);
            device.updateDescriptorSets(
                vk::WriteDescriptorSet(set, kViews, 0, Type::eStorageBuffer, {}, info), {});
        };
        for (std::size_t region = 0; region < regions_; ++region) {
            at.regions[region].bands = vulkan::HostBuffer(
                setup_.context, eye[region].max_bands() * sizeof(foveation::Columns),
                vk::BufferUsageFlagBits::eStorageBuffer);
            // The filter reads its own buffer, as the first.
            write(*at.regions[region].set, region,
                  [&](std::uint32_t /*i*/) -> auto& { return eye[region].lp_buffer(); });
        }
        write(*at.resolve_set, 0, [&](std::uint32_t i) -> auto& {
            LogPolarEye& shown = eye[std::min(i, regions_ - 1)];
            return setup_.lp_gaussian ? shown.smoothed_buffer() : shown.lp_buffer();
        });
    }

    /// The views of the plan, by where the scene keeps them.
    void write_views(vulkan::HostBuffer& views, std::span<const std::uint32_t> table) const {
        views.write(table);
        for (std::size_t at = Kfr3dPlan::kViewsBegin + Kfr3dPlan::kViewNumber; at < table.size();
             at += Kfr3dPlan::kViewWords) {
            const auto view = static_cast<std::uint32_t>(std::bit_cast<float>(table[at]));
            const std::array layer{static_cast<float>(setup_.scene.layer_of_view(view))};
            views.write(std::span<const float>(layer), at * sizeof(std::uint32_t));
        }
    }

    void write_plan(EyeSlot& at, gaze::Eye eye, const foveation::EyePlan& made) const {
        auto uniforms = foveation::map_uniforms_of(made);
        write_views(at.views, made.table);
        for (std::uint32_t region = 0; region < regions_; ++region) {
            const std::vector<foveation::Columns>& bands = made.grids[region].bands;
            const foveation::LpSize lp = plan().lp(eye, region);
            uniforms.lp_and_disc.x = static_cast<float>(lp.width);
            uniforms.lp_and_disc.y = static_cast<float>(lp.height);
            uniforms.radius_and_bands.z = static_cast<float>(bands.size());
            at.regions[region].uniforms.write(uniforms);
            at.regions[region].bands.write(std::span<const foveation::Columns>(bands));
        }
        at.regions[0].bands.write(
            std::span<const foveation::Columns>(made.grids[plan().disc_grid()].bands),
            made.grids[0].bands.size() * sizeof(foveation::Columns));
    }

    /// The whole picture from the LP-buffers, then the disc over it.
    void draw_resolve(const vk::raii::CommandBuffer& commands, const foveation::EyePlan& made,
                      const foveation::HiddenArea* hidden) const {
        const auto regions = std::span(made.grids).first(regions_);
        if (std::ranges::any_of(regions, [](const auto& grid) { return !grid.tiles.empty(); })) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_);
            draw_visible(commands, hidden);
        }
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_disc_);
        draw_visible_tiles(commands, made.grids[plan().disc_grid()].tiles, hidden);
    }

    PassSetup setup_;
    std::uint32_t regions_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pass_i_{nullptr};
    vk::raii::Pipeline lp_gaussian_{nullptr};  ///< null: without the filter
    vk::raii::Pipeline resolve_{nullptr};
    vk::raii::Pipeline resolve_disc_{nullptr};
    vk::raii::Sampler sampler_;
    vk::raii::DescriptorPool pool_{nullptr};
    gaze::PerEye<std::vector<LogPolarEye>> eyes_;  ///< one for each region
    std::vector<gaze::PerEye<EyeSlot>> slots_;
    FoveaDepths depths_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_kfr3d_passes(const PassSetup& setup,
                                                const foveation::Kfr3dParameters& parameters) {
    for (const vk::Extent2D extent : setup.extents) {
        // Checked now, not with the first frame, because it does not depend on the fields of view.
        (void)value_or_throw(foveation::region_sizes(parameters, {extent.width, extent.height}));
    }
    return std::make_unique<Kfr3dPasses>(setup, parameters);
}

}  // namespace gazeloop::render
