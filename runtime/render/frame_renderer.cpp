#include "runtime/render/frame_renderer.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
// The state lies on the stack: no allocation per frame.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "runtime/error.h"
#include "runtime/render/eye_uniforms.h"
#include "runtime/render/fovea_depth.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

constexpr std::uint32_t kMaxSegments = 4;  // pass I, resolve, disc, copies
constexpr std::uint32_t kBytesPerPixel = 4;

bool encodes_srgb(vk::Format format) {
    return format == vk::Format::eR8G8B8A8Srgb || format == vk::Format::eB8G8R8A8Srgb;
}

void barrier(const vk::raii::CommandBuffer& commands, const vk::ImageMemoryBarrier2& image) {
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, image));
}

/// Makes a target ready to be drawn into; what it held is discarded. Earlier frames may still write
/// or copy it.
void discard_and_attach(const vk::raii::CommandBuffer& commands, vk::Image image) {
    barrier(commands,
            vulkan::image_barrier(image, Layout::eUndefined, Layout::eColorAttachmentOptimal,
                                  Stage::eColorAttachmentOutput | Stage::eCopy,
                                  Access::eColorAttachmentWrite, Stage::eColorAttachmentOutput,
                                  Access::eColorAttachmentWrite));
}

void discard_and_attach_depth(const vk::raii::CommandBuffer& commands, vk::Image image) {
    constexpr auto kTests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    barrier(commands,
            vulkan::image_barrier(
                image, Layout::eUndefined, Layout::eDepthStencilAttachmentOptimal, kTests,
                Access::eDepthStencilAttachmentWrite, kTests,
                Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite,
                vk::ImageAspectFlagBits::eDepth));
}

void write_buffer(const vk::raii::Device& device, vk::DescriptorSet set, std::uint32_t binding,
                  vk::DescriptorType type, vk::Buffer buffer) {
    const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
    device.updateDescriptorSets(vk::WriteDescriptorSet(set, binding, 0, type, {}, info), {});
}

/// `depth_view` null: colours alone. Cleared depth is infinitely far.
void begin_rendering(const vk::raii::CommandBuffer& commands, vk::ImageView view,
                     vk::Extent2D extent, vk::AttachmentLoadOp load,
                     const std::array<float, 4>& background = {}, vk::ImageView depth_view = {}) {
    const vk::RenderingAttachmentInfo attachment(view, Layout::eColorAttachmentOptimal, {}, {}, {},
                                                 load, vk::AttachmentStoreOp::eStore,
                                                 vk::ClearColorValue(background));
    const vk::RenderingAttachmentInfo depth(depth_view, Layout::eDepthStencilAttachmentOptimal, {},
                                            {}, {}, load, vk::AttachmentStoreOp::eStore,
                                            vk::ClearValue(vk::ClearDepthStencilValue(0.0F, 0)));
    const vk::Rect2D area({0, 0}, extent);
    commands.beginRendering(
        vk::RenderingInfo({}, area, 1, 0, attachment, depth_view ? &depth : nullptr));
    commands.setViewport(0, vk::Viewport(0.0F, 0.0F, static_cast<float>(extent.width),
                                         static_cast<float>(extent.height), 0.0F, 1.0F));
    commands.setScissor(0, area);
}

/// One large triangle for each tile, which the scissor cuts.
void draw_tiles(const vk::raii::CommandBuffer& commands, std::span<const foveation::Tile> tiles,
                std::uint32_t instance) {
    for (const foveation::Tile& tile : tiles) {
        commands.setScissor(
            0, vk::Rect2D({static_cast<std::int32_t>(tile.x0), static_cast<std::int32_t>(tile.y0)},
                          {tile.x1 - tile.x0, tile.y1 - tile.y0}));
        commands.draw(3, 1, 0, instance);
    }
}

/// The whole picture, or what of it is visible.
void draw_visible(const vk::raii::CommandBuffer& commands, const foveation::HiddenArea* hidden) {
    if (hidden != nullptr) {
        draw_tiles(commands, hidden->visible_tiles(), 0);
    } else {
        commands.draw(3, 1, 0, 0);
    }
}

}  // namespace

struct FrameRenderer::EyeSlot {
    vulkan::HostBuffer uniforms;
    vulkan::HostBuffer bands;
    vulkan::HostBuffer pixels;  ///< for hashing
    std::optional<FoveaDepth> depth;
    vk::raii::DescriptorSet set{nullptr};
};

/// What a frame owns until the GPU has finished it. A segment is one command buffer, one submit and
/// one pair of timestamps: several pairs inside one command buffer are wrong on lavapipe 22.3.
struct FrameRenderer::Slot {
    gaze::PerEye<EyeSlot> eyes;
    vk::raii::CommandPool pool{nullptr};
    vk::raii::CommandBuffers buffers{nullptr};
    vk::raii::QueryPool queries{nullptr};
    std::uint32_t segments = 0;
    std::array<std::optional<std::size_t>, kMaxSegments> segment_pass;
    std::uint32_t timed_segments = 0;  ///< what is read back is no part of the frame's time
    std::uint64_t frame_index = 0;

    [[nodiscard]] const vk::raii::CommandBuffer& commands() const { return buffers[segments - 1]; }
};

FrameRenderer::FrameRenderer(const vulkan::Context& context, const RendererConfig& config)
    : context_(&context), config_(config), clock_(context) {
    if (config.samples < 1 || config.samples > kMaxSamples) {
        throw SetupError(ErrorKind::Usage, fmt::format("render.spp = {}: must lie in [1, {}]",
                                                       config.samples, kMaxSamples));
    }
    const vk::raii::Device& device = context.device();
    const bool log_polar = config.method != Method::Full;
    passes_ = log_polar ? frame::PassList{"pass_i", "disc", "resolve"} : frame::PassList{"full"};
    grids_ = log_polar ? frame::GridList{"lp", "picture"} : frame::GridList{"picture"};
    set_layout_ = vulkan::make_set_layout(
        device, log_polar ? vulkan::Inputs::UniformsAndLpMap : vulkan::Inputs::Uniforms);
    layout_ = vulkan::make_pipeline_layout(device, set_layout_);
    const bool encode = !encodes_srgb(config.format);
    // A variant of its own: the mere statement of a depth costs a third of a resolve.
    const std::string_view suffix =
        config.depth_format == vk::Format::eUndefined ? "frag" : "depth.frag";
    const bool in_gaze_frame = config.method == Method::Acuity;
    if (log_polar) {
        pass_i_ = vulkan::make_pipeline(device, layout_,
                                        {.vertex = "tiles.vert",
                                         .fragment = fmt::format("{}.log_polar.frag", config.scene),
                                         .format = kLpFormat,
                                         .in_gaze_frame = in_gaze_frame,
                                         .samples = config.samples});
        const std::string resolve_shader = fmt::format("log_polar.{}", suffix);
        vulkan::PipelineSource resolve{.vertex = "full_screen.vert",
                                       .fragment = resolve_shader,
                                       .format = config.format,
                                       .depth_format = config.depth_format,
                                       .in_gaze_frame = in_gaze_frame,
                                       .encode_srgb = encode};
        resolve_ = vulkan::make_pipeline(device, layout_, resolve);
        resolve.disc = true;
        resolve_disc_ = vulkan::make_pipeline(device, layout_, resolve);
        using Mode = vk::SamplerAddressMode;
        sampler_ = vk::raii::Sampler(
            device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                          vk::SamplerMipmapMode::eNearest, Mode::eClampToEdge,
                                          Mode::eRepeat, Mode::eClampToEdge));
    } else {
        full_ = vulkan::make_pipeline(device, layout_,
                                      {.vertex = "full_screen.vert",
                                       .fragment = fmt::format("{}.full.{}", config.scene, suffix),
                                       .format = config.format,
                                       .depth_format = config.depth_format,
                                       .encode_srgb = encode,
                                       .samples = config.samples});
    }

    const std::uint32_t sets =
        config.frames_in_flight * static_cast<std::uint32_t>(gaze::kEyeCount);
    const std::array sizes{
        vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, 2 * sets),
        vk::DescriptorPoolSize(vk::DescriptorType::eStorageBuffer, 3 * sets),
        vk::DescriptorPoolSize(vk::DescriptorType::eCombinedImageSampler, 2 * sets)};
    pool_ = vk::raii::DescriptorPool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             sets, sizes));
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    timeline_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));

    make_slots();
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        if (config.method == Method::Kfr) {
            attach_eye(
                e, std::make_unique<LogPolarEye>(
                       context, config.kfr,
                       foveation::ImageSize{config.extents[e].width, config.extents[e].height}));
        }
    }
}

void FrameRenderer::make_slots() {
    const vk::raii::Device& device = context_->device();
    for (std::uint32_t i = 0; i < config_.frames_in_flight; ++i) {
        auto slot = std::make_unique<Slot>();
        slot->pool = vk::raii::CommandPool(
            device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                              context_->queue_family()));
        slot->buffers = vk::raii::CommandBuffers(
            device, vk::CommandBufferAllocateInfo(*slot->pool, vk::CommandBufferLevel::ePrimary,
                                                  kMaxSegments));
        slot->queries = vk::raii::QueryPool(
            device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * kMaxSegments));
        for (const gaze::Eye eye : gaze::kEyes) {
            EyeSlot& at = slot->eyes[gaze::index(eye)];
            at.uniforms = vulkan::HostBuffer(*context_, sizeof(EyeUniforms),
                                             vk::BufferUsageFlagBits::eUniformBuffer);
            at.set = std::move(vk::raii::DescriptorSets(
                device, vk::DescriptorSetAllocateInfo(*pool_, *set_layout_))[0]);
            write_buffer(device, *at.set, vulkan::kEyeUniformsBinding,
                         vk::DescriptorType::eUniformBuffer, at.uniforms.buffer());
            if (config_.hash) {
                const vk::Extent2D extent = config_.extents[gaze::index(eye)];
                at.pixels = vulkan::HostBuffer(
                    *context_, vk::DeviceSize{extent.width} * extent.height * kBytesPerPixel,
                    vk::BufferUsageFlagBits::eTransferDst);
            }
            if (keeps_depth()) {
                at.depth.emplace(*context_, config_.extents[gaze::index(eye)]);
            }
        }
        slots_.push_back(std::move(slot));
    }
}

/// Precondition: no frame is unfinished on the GPU.
void FrameRenderer::attach_eye(std::size_t eye, std::unique_ptr<LogPolarEye> made) {
    const vk::raii::Device& device = context_->device();
    eyes_[eye] = std::move(made);
    const LogPolarEye& put = *eyes_[eye];
    for (const auto& slot : slots_) {
        EyeSlot& at = slot->eyes[eye];
        at.bands = vulkan::HostBuffer(*context_, put.max_bands() * sizeof(foveation::Columns),
                                      vk::BufferUsageFlagBits::eStorageBuffer);
        write_buffer(device, *at.set, vulkan::kMapTablesBinding, vk::DescriptorType::eUniformBuffer,
                     put.map_buffers().map_tables());
        for (const auto& [binding, buffer] :
             {std::pair{vulkan::kColumnTableBinding, put.map_buffers().column_table()},
              {vulkan::kRowTableBinding, put.map_buffers().row_table()},
              {vulkan::kBandsBinding, at.bands.buffer()}}) {
            write_buffer(device, *at.set, binding, vk::DescriptorType::eStorageBuffer, buffer);
        }
        for (const auto& [binding, image] :
             {std::pair{vulkan::kLpBufferBinding, &put.lp_buffer()},
              {vulkan::kDirectBufferBinding, &put.direct_buffer()}}) {
            const vk::DescriptorImageInfo info(*sampler_, image->view(),
                                               Layout::eShaderReadOnlyOptimal);
            device.updateDescriptorSets(
                vk::WriteDescriptorSet(*at.set, binding, 0,
                                       vk::DescriptorType::eCombinedImageSampler, info),
                {});
        }
    }
}

/// The acuity-derived map needs the fields of view, which a runtime states with the first frame and
/// may change.
void FrameRenderer::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        if (config_.method == Method::Acuity &&
            (eyes_[e] == nullptr || !eyes_[e]->fits(views[e]))) {
            wait_idle();
            attach_eye(e, std::make_unique<LogPolarEye>(*context_, config_.acuity, views[e]));
        }
    }
}

FrameRenderer::~FrameRenderer() {
    try {
        wait_idle();
    } catch (const vk::SystemError& error) {
        // The device is lost: nothing is running on it any more.
        spdlog::debug("the renderer ends on a lost device ({})", error.what());
    }
}

const LogPolarEye* FrameRenderer::log_polar_eye(gaze::Eye eye) const {
    return eyes_[gaze::index(eye)].get();
}

const foveation::SamplingPlan& FrameRenderer::last_plan(gaze::Eye eye) const {
    return plans_[gaze::index(eye)];
}

void FrameRenderer::wait_for_slot() { wait_for_slot(config_.frames_in_flight); }

void FrameRenderer::wait_for_slot(std::uint32_t in_flight) {
    if (submitted_ < in_flight) {
        return;
    }
    const std::uint64_t needed = submitted_ - in_flight + 1;
    // Drivers end what hangs; what is merely slow may take minutes in software, but not in silence.
    constexpr std::chrono::seconds kPatience(10);
    std::chrono::seconds waited(0);
    while (context_->device().waitSemaphores(vk::SemaphoreWaitInfo({}, *timeline_, needed),
                                             std::chrono::nanoseconds(kPatience).count()) !=
           vk::Result::eSuccess) {
        waited += kPatience;
        spdlog::warn(
            "the GPU has not finished a frame for {} s: a smaller picture (--set render.scale=0.5) "
            "or fewer samples (--set render.spp=1) take less; a second Ctrl-C ends at once",
            waited.count());
    }
}

frame::SampleCounts FrameRenderer::render(const FrameRequest& request) {
    prepare(request.views);
    Slot& slot = *slots_[submitted_ % slots_.size()];
    slot.pool.reset();
    slot.segments = 0;
    slot.timed_segments = 0;
    slot.frame_index = request.index;

    frame::SampleCounts counts;
    counts.grid_count = static_cast<std::uint32_t>(grids_.size());
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const gaze::EyeView& view = request.views[e];
        const std::uint64_t pixels = std::uint64_t{view.width_px} * view.height_px;
        const std::uint64_t hidden =
            request.hidden[e] != nullptr ? request.hidden[e]->hidden_pixels() : 0;
        counts.pixels_output += pixels;
        counts.pixels_hidden += hidden;
        EyeSlot& at = slot.eyes[e];
        foveation::SamplingPlan* plan = nullptr;
        if (const LogPolarEye* const log_polar = eyes_[e].get()) {
            plan = &plans_[e];
            log_polar->plan(view, request.foveae[e], request.gaze_directions[e],
                            request.hidden[e].get(), *plan);
            at.bands.write(std::span<const foveation::Columns>(plan->lp_bands));
            at.bands.write(std::span<const foveation::Columns>(plan->disc_bands),
                           plan->lp_bands.size() * sizeof(foveation::Columns));
            counts.grids[0] +=
                {std::uint64_t{plan->lp.width} * plan->lp.height, plan->texels_shaded,
                 plan->texels_off_screen, plan->texels_under_disc, plan->texels_hidden};
            counts.grids[1] += {plan->pixels_direct, plan->pixels_direct, 0, 0, 0};
        } else {
            counts.grids[0] += {pixels, pixels - hidden, 0, 0, hidden};
        }
        at.uniforms.write(eye_uniforms(view, request.scene_time_s, config_.samples, plan));
    }
    if (config_.method == Method::Full) {
        record_full(slot, request);
    } else {
        record_log_polar(slot, request);
    }
    slot.timed_segments = slot.segments;
    if (config_.hash || keeps_depth()) {
        record_copies(slot, request);
    }
    end_segments(slot);
    submit(slot);
    return counts;
}

void FrameRenderer::begin_segment(Slot& slot, std::string_view pass) {
    if (slot.segments > 0 && !pass.empty() && !config_.profile) {
        return;  // one segment for all passes
    }
    const std::uint32_t segment = slot.segments++;
    slot.segment_pass[segment] = config_.profile ? passes_.find(pass) : std::nullopt;
    const vk::raii::CommandBuffer& commands = slot.commands();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.resetQueryPool(*slot.queries, 2 * segment, 2);
    commands.writeTimestamp2(Stage::eTopOfPipe, *slot.queries, 2 * segment);
}

void FrameRenderer::end_segments(Slot& slot) {
    for (std::uint32_t segment = 0; segment < slot.segments; ++segment) {
        slot.buffers[segment].writeTimestamp2(Stage::eBottomOfPipe, *slot.queries, 2 * segment + 1);
        slot.buffers[segment].end();
    }
}

/// Shades tiles of one eye into a buffer and makes it readable for the resolve. Tiles may be none:
/// the resolve then reads nothing of it, but its layout must be right.
void FrameRenderer::shade_tiles(Slot& slot, std::size_t eye, const vulkan::ColorImage& target,
                                std::span<const foveation::Tile> tiles, bool direct) {
    const vk::raii::CommandBuffer& commands = slot.commands();
    barrier(commands, vulkan::image_barrier(
                          target.image(), Layout::eUndefined, Layout::eColorAttachmentOptimal,
                          Stage::eFragmentShader | Stage::eCopy, Access::eNone,
                          Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite));
    const bool clear = config_.lp_background.has_value();
    if (!tiles.empty() || clear) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pass_i_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0,
                                    *slot.eyes[eye].set, {});
        begin_rendering(commands, target.view(), target.extent(),
                        clear ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare,
                        config_.lp_background.value_or(std::array<float, 4>{}));
        draw_tiles(commands, tiles, direct ? 1 : 0);
        commands.endRendering();
    }
    barrier(commands,
            vulkan::image_barrier(target.image(), Layout::eColorAttachmentOptimal,
                                  Layout::eShaderReadOnlyOptimal, Stage::eColorAttachmentOutput,
                                  Access::eColorAttachmentWrite, Stage::eFragmentShader,
                                  Access::eShaderSampledRead));
}

/// Draws both eyes' pictures, less what no eye sees of them.
template <typename DrawEye>
void FrameRenderer::draw_pictures(const Slot& slot, const FrameRequest& request,
                                  const DrawEye& draw_eye) {
    const vk::raii::CommandBuffer& commands = slot.commands();
    const bool depth = config_.depth_format != vk::Format::eUndefined;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const EyeTarget& target = request.targets[e];
        discard_and_attach(commands, target.image);
        if (depth) {
            discard_and_attach_depth(commands, target.depth_image);
        }
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0,
                                    *slot.eyes[e].set, {});
        const foveation::HiddenArea* const hidden = request.hidden[e].get();
        begin_rendering(
            commands, target.view, config_.extents[e],
            hidden != nullptr ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare, {},
            depth ? target.depth_view : vk::ImageView{});
        draw_eye(e);
        commands.endRendering();
    }
}

void FrameRenderer::record_full(Slot& slot, const FrameRequest& request) {
    begin_segment(slot, "full");
    const vk::raii::CommandBuffer& commands = slot.commands();
    draw_pictures(slot, request, [&](std::size_t e) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *full_);
        draw_visible(commands, request.hidden[e].get());
    });
}

void FrameRenderer::record_log_polar(Slot& slot, const FrameRequest& request) {
    const bool any_lp = !plans_[0].lp_tiles.empty() || !plans_[1].lp_tiles.empty();
    const bool any_disc = !plans_[0].disc_tiles.empty() || !plans_[1].disc_tiles.empty();
    // A pass without any tile is not submitted for itself; what it has to prepare goes along with
    // the resolve.
    const auto lp_pass = [&] {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            shade_tiles(slot, e, eyes_[e]->lp_buffer(), plans_[e].lp_tiles, false);
        }
    };
    const auto disc_pass = [&] {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            shade_tiles(slot, e, eyes_[e]->direct_buffer(), plans_[e].disc_tiles, true);
        }
    };
    if (any_lp) {
        begin_segment(slot, "pass_i");
        lp_pass();
    }
    if (any_disc) {
        begin_segment(slot, "disc");
        disc_pass();
    }
    begin_segment(slot, "resolve");
    if (!any_lp) {
        lp_pass();
    }
    if (!any_disc) {
        disc_pass();
    }
    draw_pictures(slot, request,
                  [&](std::size_t e) { draw_resolve(slot, plans_[e], request.hidden[e].get()); });
}

/// The whole picture from the LP-buffer, then the disc over it.
void FrameRenderer::draw_resolve(const Slot& slot, const foveation::SamplingPlan& plan,
                                 const foveation::HiddenArea* hidden) {
    const vk::raii::CommandBuffer& commands = slot.commands();
    if (!plan.lp_tiles.empty()) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_);
        draw_visible(commands, hidden);
    }
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_disc_);
    draw_tiles(commands, plan.disc_tiles, 0);
}

/// What the host reads of the frame.
void FrameRenderer::record_copies(Slot& slot, const FrameRequest& request) {
    begin_segment(slot, {});
    if (config_.hash) {
        record_picture_copies(slot, request);
    }
    if (keeps_depth()) {
        record_depth_copies(slot, request);
    }
    const vk::MemoryBarrier2 to_host(Stage::eCopy, Access::eTransferWrite, Stage::eHost,
                                     Access::eHostRead);
    slot.commands().pipelineBarrier2(vk::DependencyInfo({}, to_host));
}

void FrameRenderer::record_depth_copies(Slot& slot, const FrameRequest& request) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        slot.eyes[e].depth->record(slot.commands(), eyes_[e]->direct_buffer().image(),
                                   request.views[e], request.foveae[e], plans_[e].disc_bands);
    }
}

void FrameRenderer::record_picture_copies(Slot& slot, const FrameRequest& request) {
    const vk::raii::CommandBuffer& commands = slot.commands();
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const vk::Extent2D extent = config_.extents[e];
        const vk::Image image = request.targets[e].image;
        barrier(commands, vulkan::image_barrier(
                              image, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal,
                              Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                              Stage::eCopy, Access::eTransferRead));
        commands.copyImageToBuffer(
            image, Layout::eTransferSrcOptimal, slot.eyes[e].pixels.buffer(),
            vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                vk::Extent3D(extent, 1)));
        barrier(commands, vulkan::image_barrier(
                              image, Layout::eTransferSrcOptimal, Layout::eColorAttachmentOptimal,
                              Stage::eCopy, Access::eNone, Stage::eColorAttachmentOutput,
                              Access::eColorAttachmentRead | Access::eColorAttachmentWrite));
    }
}

void FrameRenderer::submit(Slot& slot) {
    ++submitted_;
    for (std::uint32_t segment = 0; segment < slot.segments; ++segment) {
        const vk::CommandBufferSubmitInfo commands(*slot.buffers[segment]);
        const vk::SemaphoreSubmitInfo done(*timeline_, submitted_, Stage::eAllCommands);
        const bool last = segment + 1 == slot.segments;
        context_->queue().submit2(
            vk::SubmitInfo2({}, 0, nullptr, 1, &commands, last ? 1U : 0U, &done));
    }
}

std::optional<frame::FrameGpuRecord> FrameRenderer::next_finished() {
    if (collected_ == submitted_ || timeline_.getCounterValue() <= collected_) {
        return std::nullopt;
    }
    return collect(*slots_[collected_++ % slots_.size()]);
}

frame::FrameGpuRecord FrameRenderer::collect(Slot& slot) {
    frame::FrameGpuRecord record;
    record.index = slot.frame_index;
    std::array<std::uint64_t, std::size_t{2} * kMaxSegments> ticks{};
    const vk::Result result =
        (*context_->device())
            .getQueryPoolResults(*slot.queries, 0, 2 * slot.segments,
                                 2 * sizeof(std::uint64_t) * slot.segments, ticks.data(),
                                 sizeof(std::uint64_t), vk::QueryResultFlagBits::e64,
                                 *context_->device().getDispatcher());
    if (result == vk::Result::eSuccess) {
        for (std::uint32_t segment = 0; segment < slot.timed_segments; ++segment) {
            if (const auto pass = slot.segment_pass[segment]) {
                record.passes.set(
                    *pass, std::llround(clock_.elapsed_ns(ticks[std::size_t{2} * segment],
                                                          ticks[std::size_t{2} * segment + 1])));
            }
        }
        record.gpu_begin = clock_.host_time(ticks[0]);
        record.gpu_end = clock_.host_time(ticks[std::size_t{2} * slot.timed_segments - 1]);
    }
    if (config_.hash) {
        XXH3_state_t state;
        XXH3_64bits_reset(&state);
        for (const EyeSlot& eye : slot.eyes) {
            const std::span<const std::byte> pixels = eye.pixels.mapped();
            XXH3_64bits_update(&state, pixels.data(), pixels.size());
        }
        record.pixel_hash = XXH3_64bits_digest(&state);
    }
    if (keeps_depth()) {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            slot.eyes[e].depth->collect(seen_depth_[e]);
        }
    }
    return record;
}

void FrameRenderer::wait_idle() { context_->device().waitIdle(); }

}  // namespace gazeloop::render
