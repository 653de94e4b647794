#include "runtime/render/passes/sparse_passes.h"

#include <fmt/core.h>

#include <cmath>

#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/eye_sets.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/history.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using foveation::SparsePlan;

/// A history is never rounded to halves, because its error would add up.
constexpr vk::Format kHistoryFormat = vk::Format::eR32G32B32A32Sfloat;

/// What a history holds where nothing was drawn: no surface has this nearness.
constexpr std::array<float, 4> kNoSurface{0.0F, 0.0F, 0.0F, -1.0F};

/// Storage buffers of set 2: the pattern, then one for each neighbour.
constexpr std::uint32_t kMostNeighbours = foveation::NearestSamples::kMaxNeighbours;

/// Images of set 2 (shaders/lib/sparse_fill.glsl, shaders/resolve).
enum Image : std::uint32_t { kList, kBefore, kNow, kImages };

/// Constants of the shaders.
enum Constant : std::uint32_t { kNeighbours = kOfMethod, kDepthGuided, kAccumulated };

frame::PassList pass_list(bool accumulate) {
    return accumulate ? frame::PassList{"samples", "accumulate", "resolve"}
                      : frame::PassList{"samples", "resolve"};
}

/// A pattern on the GPU.
struct PatternBuffers {
    std::shared_ptr<const SparsePlan::Prepared> prepared;
    vulkan::DeviceBuffer samples;
    /// Of each neighbour, the nearest first: an index for each pixel of the field.
    std::vector<vulkan::DeviceBuffer> nearest;
};

/// Refuses a picture (Usage) of whose field, twice as long each way, a shader of this device cannot
/// read an index for every pixel from one buffer.
void check_field(vk::Extent2D extent, std::uint64_t most_bytes) {
    const std::uint64_t bytes = 16 * std::uint64_t{extent.width} * extent.height;
    if (bytes > most_bytes) {
        throw SetupError(
            ErrorKind::Usage,
            fmt::format("sparse: the tables of {}x{} pixels take {} MiB each, and a shader of this "
                        "device reads {}: use a picture at most {:.2f} times as long each way "
                        "(render.scale)",
                        extent.width, extent.height, bytes >> 20U, most_bytes >> 20U,
                        std::floor(100.0 * std::sqrt(static_cast<double>(most_bytes) /
                                                     static_cast<double>(bytes))) /
                            100.0));
    }
}

class SparsePasses final : public PlannedPasses<SparsePlan> {
  public:
    SparsePasses(const PassSetup& setup, const SparseConfig& config)
        : PlannedPasses(pass_list(config.accumulate), std::make_unique<SparsePlan>(config.plan)),
          setup_(setup),
          config_(config),
          sampler_(make_sampler(setup.context.device(), vk::Filter::eNearest)),
          sets_(setup, {.buffers = 1 + kMostNeighbours, .images = kImages}, *sampler_),
          layout_(vulkan::make_pipeline_layout(
              setup.context.device(), {setup.frame_layout, setup.scene.inputs(), sets_.layout()},
              setup.empty_layout)) {
        make_pipelines();
        if (config.accumulate) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                histories_[e] = vulkan::History(setup.context, setup.extents[e], kHistoryFormat);
            }
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        // Sets may not change once commands have bound them.
        for (std::size_t e = 0; e < gaze::kEyeCount && config_.accumulate; ++e) {
            advance(frame, e);
        }
        const vk::raii::CommandBuffer& shading = recorder.begin("samples");
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            sets_.write(frame.slot, e, plans[e]);
            bind_sets(shading, layout_, frame, e, sets_.of(frame.slot, e));
            shading.bindPipeline(vk::PipelineBindPoint::eGraphics, *shade_);
            shade_cells(shading, lists_[e], plans[e].grids[0].tiles, 0, setup_.unshaded);
        }
        if (config_.accumulate) {
            const vk::raii::CommandBuffer& commands = recorder.begin("accumulate");
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                accumulate(commands, frame, e);
            }
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("resolve");
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, layout_, frame, e, sets_.of(frame.slot, e));
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_);
            draw_visible(commands, frame.view.hidden[e].get());
        });
    }

  private:
    void attach() override {
        for (const gaze::Eye eye : gaze::kEyes) {
            attach_eye(eye);
        }
    }

    void make_pipelines() {
        const vk::raii::Device& device = setup_.context.device();
        const auto samples = with_scene(setup_.scene, {{kSamples, setup_.samples}});
        shade_ =
            vulkan::make_pipeline(device, layout_,
                                  {.vertex = "full_screen.vert",
                                   .fragment = fmt::format("{}.sparse.frag", setup_.scene.shader()),
                                   .format = kLpFormat,
                                   .constants = samples});
        const std::array filling{
            vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup_.format) ? 0U : 1U},
            vulkan::ShaderConstant{kNeighbours, config_.plan.neighbours},
            vulkan::ShaderConstant{kDepthGuided, config_.depth_guided ? 1U : 0U},
            vulkan::ShaderConstant{kAccumulated, config_.accumulate ? 1U : 0U}};
        resolve_ = vulkan::make_pipeline(device, layout_,
                                         {.vertex = "full_screen.vert",
                                          .fragment = resolve_shader("sparse", setup_),
                                          .format = setup_.format,
                                          .depth_format = setup_.depth_format,
                                          .constants = filling});
        if (config_.accumulate) {
            accumulate_ = vulkan::make_pipeline(device, layout_,
                                                {.vertex = "full_screen.vert",
                                                 .fragment = "sparse_accumulate.frag",
                                                 .format = kHistoryFormat,
                                                 .constants = filling});
        }
    }

    void attach_eye(gaze::Eye eye) {
        const std::size_t e = gaze::index(eye);
        const auto& prepared = plan().prepared(eye);
        using Usage = vk::ImageUsageFlagBits;
        lists_[e] = {setup_.context,
                     {SparsePlan::kListWidth, prepared->list_rows()},
                     kLpFormat,
                     Usage::eColorAttachment | Usage::eSampled};
        upload(e, prepared);
        const vk::ImageView view = lists_[e].image.view();
        std::array<vk::Buffer, 1 + kMostNeighbours> buffers;
        // The shader reads no more neighbours than there are.
        buffers.fill(patterns_[e]->nearest.front().buffer());
        buffers[0] = patterns_[e]->samples.buffer();
        for (std::size_t k = 0; k < patterns_[e]->nearest.size(); ++k) {
            buffers.at(1 + k) = patterns_[e]->nearest[k].buffer();
        }
        sets_.attach(e, prepared->table_words(), buffers, std::array{view, view, view});
    }

    /// Eyes with one pattern share its buffers.
    void upload(std::size_t e, const std::shared_ptr<const SparsePlan::Prepared>& prepared) {
        for (const auto& pattern : patterns_) {
            if (pattern != nullptr && pattern->prepared == prepared) {
                patterns_[e] = pattern;
                return;
            }
        }
        static_assert(sizeof(foveation::FieldPixel) == sizeof(std::uint32_t));
        auto made = std::make_shared<PatternBuffers>();
        made->prepared = prepared;
        constexpr auto kStorage = vk::BufferUsageFlagBits::eStorageBuffer;
        made->samples = {setup_.context, std::as_bytes(std::span(prepared->pattern.samples)),
                         kStorage};
        const std::vector<std::uint32_t>& map = prepared->nearest.map;
        const std::size_t neighbours = config_.plan.neighbours;
        std::vector<std::uint32_t> of_one(map.size() / neighbours);
        for (std::size_t k = 0; k < neighbours; ++k) {
            for (std::size_t pixel = 0; pixel < of_one.size(); ++pixel) {
                of_one[pixel] = map[pixel * neighbours + k];
            }
            made->nearest.emplace_back(setup_.context, std::as_bytes(std::span(of_one)), kStorage);
        }
        patterns_[e] = std::move(made);
    }

    /// Begins a frame of an eye's history.
    void advance(const FrameRecording& frame, std::size_t e) {
        vulkan::History& history = histories_[e];
        if (!frame.in_run.follows) {
            history.reset();
        }
        history.advance();
        sets_.attach_image(frame.slot, e, kBefore, history.other().image.view());
        sets_.attach_image(frame.slot, e, kNow, history.now().image.view());
    }

    /// Mixes what this frame shows into the history.
    void accumulate(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                    std::size_t e) {
        vulkan::History& history = histories_[e];
        vulkan::History::Entry& now = history.now();
        vulkan::History::Entry& before = history.other();
        before.tracked.use(
            commands, vulkan::Use::Sampled,
            history.before() != nullptr ? vulkan::Keep::Content : vulkan::Keep::Nothing);
        now.tracked.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        bind_sets(commands, layout_, frame, e, sets_.of(frame.slot, e));
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *accumulate_);
        const bool hidden = frame.view.hidden[e] != nullptr;
        begin_rendering(commands, now.image.view(), now.image.extent(),
                        hidden ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare,
                        kNoSurface);
        draw_visible(commands, frame.view.hidden[e].get());
        commands.endRendering();
        now.tracked.use(commands, vulkan::Use::Sampled);
    }

    PassSetup setup_;
    SparseConfig config_;
    vk::raii::Sampler sampler_;
    EyeSets sets_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline shade_{nullptr};
    vk::raii::Pipeline accumulate_{nullptr};
    vk::raii::Pipeline resolve_{nullptr};
    gaze::PerEye<vulkan::TrackedColorImage> lists_;
    gaze::PerEye<std::shared_ptr<const PatternBuffers>> patterns_;
    gaze::PerEye<vulkan::History> histories_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_sparse_passes(const PassSetup& setup,
                                                 const SparseConfig& config) {
    const std::uint64_t most =
        setup.context.physical().getProperties().limits.maxStorageBufferRange;
    for (const vk::Extent2D extent : setup.extents) {
        // Now, before minutes go into looking for neighbours.
        check_field(extent, most);
    }
    return std::make_unique<SparsePasses>(setup, config);
}

}  // namespace gazeloop::render
