#include "runtime/render/frame_renderer.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
// The state lies on the stack: no allocation per frame.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <chrono>
#include <cmath>

#include "runtime/error.h"
#include "runtime/render/cut.h"
#include "runtime/render/frame_uniforms.h"
#include "runtime/render/passes/antialiased_passes.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

constexpr std::uint32_t kBytesPerPixel = 4;
constexpr std::uint32_t kMostInFlight = 3;

/// The views whose pixel centres lie where these have theirs moved by so many pixels.
gaze::StereoView moved_aside(const gaze::StereoView& views, const glm::dvec2& offset_px) {
    gaze::StereoView moved = views;
    const auto move = [](double& from_rad, double& to_rad, double share) {
        const double from = std::tan(from_rad);
        const double to = std::tan(to_rad);
        const double by = share * (to - from);
        from_rad = std::atan(from + by);
        to_rad = std::atan(to + by);
    };
    for (gaze::EyeView& view : moved) {
        move(view.fov.left_rad, view.fov.right_rad, offset_px.x / view.width_px);
        move(view.fov.up_rad, view.fov.down_rad, offset_px.y / view.height_px);
    }
    return moved;
}

void check(const Antialiasing& wanted) {
    if (wanted.footprint_taps < 1 || wanted.footprint_taps > Antialiasing::kMostFootprintTaps) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("render.footprint_taps = {}: must lie in [1, {}]",
                                     wanted.footprint_taps, Antialiasing::kMostFootprintTaps));
    }
    if (wanted.post_filter_px > Antialiasing::kMostPostFilter_px) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("render.post_filter = {}: must lie in [0, {}]",
                                     wanted.post_filter_px, Antialiasing::kMostPostFilter_px));
    }
}

/// The scene's passes, then the method's.
frame::PassList pass_list(const frame::PassList& scene, const frame::PassList& method) {
    const std::string text =
        scene.text() + (scene.size() > 0 && method.size() > 0 ? " " : "") + method.text();
    return value_or_throw(frame::PassList::parse(text, frame::kMostPasses));
}

}  // namespace

/// What a frame owns until the GPU has finished it.
struct FrameRenderer::Slot {
    struct Eye {
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer pixels;  ///< for hashing
        vk::raii::DescriptorSet set{nullptr};
    };
    Slot(const vulkan::Context& context, const frame::PassList& passes, bool profile)
        : recorder(context, passes, profile) {}

    vulkan::PassRecorder recorder;
    gaze::PerEye<Eye> eyes;
    gaze::PerEye<vulkan::TrackedImage> color;
    gaze::PerEye<vulkan::TrackedImage> depth;
    std::size_t number = 0;
    std::uint64_t frame_index = 0;
};

FrameRenderer::FrameRenderer(const vulkan::Context& context, scene::Scene& scene,
                             const MakePasses& make_passes, const RendererConfig& config)
    : context_(&context), scene_(&scene), config_(config), clock_(context) {
    if (config.samples < 1 || config.samples > kMaxSamples) {
        throw SetupError(ErrorKind::Usage, fmt::format("render.spp = {}: must lie in [1, {}]",
                                                       config.samples, kMaxSamples));
    }
    if (config.frames_in_flight < 1 || config.frames_in_flight > kMostInFlight) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("render.frames_in_flight = {}: must lie in [1, {}]",
                                     config.frames_in_flight, kMostInFlight));
    }
    check(config.antialiasing);
    own_scene_ = scene.for_renderer({.extents = config.extents, .slots = config.frames_in_flight});
    scene_ = own_scene_ ? own_scene_.get() : &scene;
    const vk::raii::Device& device = context.device();
    constexpr std::array kFrameBindings{vk::DescriptorType::eUniformBuffer};
    frame_layout_ =
        vulkan::make_set_layout(device, kFrameBindings, vk::ShaderStageFlagBits::eFragment);
    empty_layout_ = vulkan::make_set_layout(device, {}, {});
    method_ = make_antialiased_passes(
        {.context = context,
         .scene = *scene_,
         .frame_layout = *frame_layout_,
         .empty_layout = *empty_layout_,
         .samples = config.samples,
         .extents = config.extents,
         .format = config.format,
         .depth_format = config.depth_format,
         .slots = config.frames_in_flight,
         .seen_depth = config.seen_depth,
         .lp_gaussian =
             config.lp_gaussian == FilterUse::On ||
             (config.lp_gaussian == FilterUse::AsSceneNeeds && scene_->is_point_sampled()),
         .antialiasing = config.antialiasing,
         .unshaded = config.unshaded},
        make_passes);
    passes_ = pass_list(scene_->passes(), method_->passes());
    const std::uint32_t sets =
        config.frames_in_flight * static_cast<std::uint32_t>(gaze::kEyeCount);
    const vk::DescriptorPoolSize size(vk::DescriptorType::eUniformBuffer, sets);
    pool_ = vk::raii::DescriptorPool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             sets, size));
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    timeline_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));
    begun_ = vk::raii::Semaphore(device, vk::SemaphoreCreateInfo({}, &timeline));
    make_slots();
}

void FrameRenderer::make_slots() {
    const vk::raii::Device& device = context_->device();
    for (std::uint32_t i = 0; i < config_.frames_in_flight; ++i) {
        auto slot = std::make_unique<Slot>(*context_, passes_, config_.profile);
        slot->number = i;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            Slot::Eye& at = slot->eyes[e];
            at.uniforms = vulkan::HostBuffer(*context_, sizeof(FrameUniforms),
                                             vk::BufferUsageFlagBits::eUniformBuffer);
            at.set = std::move(vk::raii::DescriptorSets(
                device, vk::DescriptorSetAllocateInfo(*pool_, *frame_layout_))[0]);
            const vk::DescriptorBufferInfo info(at.uniforms.buffer(), 0, VK_WHOLE_SIZE);
            device.updateDescriptorSets(
                vk::WriteDescriptorSet(*at.set, 0, 0, vk::DescriptorType::eUniformBuffer, {}, info),
                {});
            if (config_.hash) {
                const vk::Extent2D extent = config_.extents[e];
                at.pixels = vulkan::HostBuffer(
                    *context_, vk::DeviceSize{extent.width} * extent.height * kBytesPerPixel,
                    vk::BufferUsageFlagBits::eTransferDst);
            }
        }
        slots_.push_back(std::move(slot));
    }
}

void FrameRenderer::prepare(const gaze::StereoView& views) {
    if (!method_->fits(views)) {
        wait_idle();
        method_->prepare(views);
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

void FrameRenderer::wait_for_slot() { wait_for_slot(config_.frames_in_flight); }

void FrameRenderer::wait_for_slot(std::uint32_t in_flight) {
    if (submitted_ >= in_flight) {
        wait_for(*timeline_, submitted_ - in_flight + 1);
    }
}

void FrameRenderer::wait_for(vk::Semaphore timeline, std::uint64_t value) const {
    // Drivers end work that hangs. Work that is only slow may take minutes in software; say so.
    constexpr std::chrono::seconds kPatience(10);
    std::chrono::seconds waited(0);
    while (context_->device().waitSemaphores(vk::SemaphoreWaitInfo({}, timeline, value),
                                             std::chrono::nanoseconds(kPatience).count()) !=
           vk::Result::eSuccess) {
        waited += kPatience;
        spdlog::warn(
            "the GPU has not finished a frame for {} s: a smaller picture (--set render.scale=0.5) "
            "or fewer samples (--set render.spp=1) take less; a second Ctrl-C ends at once",
            waited.count());
    }
}

/// How far the samples of the next frame are moved aside, in pixels.
glm::dvec2 FrameRenderer::next_offset() {
    if (!config_.antialiasing.over_frames) {
        return {};
    }
    if (!in_run_.follows) {
        jitter_.reset();
    }
    const glm::dvec2 offset = jitter_.offset();
    jitter_.advance();
    return offset;
}

FrameRecording FrameRenderer::recording(Slot& slot, const FrameView& view,
                                        const gaze::FrameFovea* fovea) {
    FrameRecording frame{.view = view,
                         .in_run = in_run_,
                         .slot = slot.number,
                         .frame_sets = {},
                         .scene_sets = {},
                         .color = slot.color,
                         .depth = slot.depth,
                         .fovea = fovea};
    for (const gaze::Eye eye : gaze::kEyes) {
        frame.frame_sets[gaze::index(eye)] = *slot.eyes[gaze::index(eye)].set;
        frame.scene_sets[gaze::index(eye)] = scene_->inputs_of(eye, slot.number);
    }
    return frame;
}

/// What the last frame showed, where any of it can be of use. Precondition: the last views are
/// those before this one.
gaze::PerEye<std::optional<foveation::EyeBefore>> FrameRenderer::before(
    const FrameView& view) const {
    gaze::PerEye<std::optional<foveation::EyeBefore>> before;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const gaze::EyeView* const last = last_views_.of(eye);
        if (last != nullptr &&
            !is_cut({last->pose, last_scene_time_s_}, {view.views[e].pose, view.scene_time_s})) {
            before[e] = {*last, last_foveae_[e]};
        }
    }
    return before;
}

void FrameRenderer::begin(const FrameView& view) {
    prepare(view.views);
    given_ = &view;
    view_ = &view;
    if (config_.camera != CameraMotion::Still) {
        carried_ = view;
        carried_.views = carried(config_.camera, view.views, view.scene_time_s);
        view_ = &carried_;
    }
    Slot& slot = *slots_[submitted_ % slots_.size()];
    slot.recorder.reset();
    slot.frame_index = view.index;
    in_run_ = {view.index, last_views_.begin(view.index, view_->views), before(*view_)};
    last_scene_time_s_ = view.scene_time_s;
    const glm::dvec2 aside_px = next_offset();
    // Several samples fill their cell already.
    const glm::dvec2 aside = aside_px / std::sqrt(static_cast<double>(config_.samples));
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        slot.eyes[e].uniforms.write(frame_uniforms(view_->views[e], view.scene_time_s,
                                                   config_.samples, last_views_.of(eye), aside));
        slot.color[e] = vulkan::TrackedImage::of_earlier_frames(view.targets[e].image,
                                                                vk::ImageAspectFlagBits::eColor);
        slot.depth[e] = vulkan::TrackedImage::of_earlier_frames(view.targets[e].depth_image,
                                                                vk::ImageAspectFlagBits::eDepth);
    }
    // What is drawn by pixels is drawn for pixels that lie aside.
    scene_->record_geometry(
        slot.recorder,
        config_.antialiasing.over_frames ? moved_aside(view_->views, aside_px) : view_->views,
        view.scene_time_s, slot.number);
    method_->record_before_gaze(slot.recorder, recording(slot, *view_, nullptr));
    if (slot.recorder.any()) {
        slot.recorder.submit(*begun_, ++begun_submitted_);
    }
}

void FrameRenderer::wait_for_begun() {
    if (begun_submitted_ > 0) {
        wait_for(*begun_, begun_submitted_);
    }
}

frame::SampleCounts FrameRenderer::finish(const gaze::FrameFovea& fovea) {
    Slot& slot = *slots_[submitted_ % slots_.size()];
    frame::SampleCounts counts;
    counts.grid_count = static_cast<std::uint32_t>(grids().size());
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const gaze::EyeView& view = view_->views[e];
        const foveation::HiddenArea* const hidden = view_->hidden[e].get();
        method_->plan().plan(eye, view, fovea.eyes[e], hidden, in_run_, plans_[e]);
        last_foveae_[e] = method_->plan().followed(view, fovea.eyes[e]).position;
        for (std::size_t grid = 0; grid < counts.grid_count; ++grid) {
            counts.grids[grid] += plans_[e].grids[grid].counts;
        }
        counts.pixels_output += std::uint64_t{view.width_px} * view.height_px;
        counts.pixels_hidden += hidden != nullptr ? hidden->hidden_pixels() : 0;
    }
    const FrameRecording frame = recording(slot, *view_, &fovea);
    method_->record_after_gaze(slot.recorder, frame, plans_);
    if (config_.hash || method_->keeps_depth()) {
        // Depth is read by who knows the head, and not how it is carried.
        record_copies(slot, recording(slot, *given_, &fovea), fovea);
    }
    slot.recorder.submit(*timeline_, ++submitted_);
    given_ = nullptr;
    view_ = nullptr;
    return counts;
}

/// What the host reads of the frame.
void FrameRenderer::record_copies(Slot& slot, const FrameRecording& frame,
                                  const gaze::FrameFovea& fovea) {
    const vk::raii::CommandBuffer& commands = slot.recorder.begin_untimed();
    if (config_.hash) {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            slot.color[e].use(commands, vulkan::Use::CopySource);
            commands.copyImageToBuffer(
                slot.color[e].image(), slot.color[e].layout(), slot.eyes[e].pixels.buffer(),
                vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                    vk::Extent3D(config_.extents[e], 1)));
            slot.color[e].use(commands, vulkan::Use::ColorTarget);
        }
    }
    if (method_->keeps_depth()) {
        method_->record_depth_copies(commands, frame, plans_, fovea);
    }
    using Stage = vk::PipelineStageFlagBits2;
    const vk::MemoryBarrier2 to_host(Stage::eCopy, vk::AccessFlagBits2::eTransferWrite,
                                     Stage::eHost, vk::AccessFlagBits2::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
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
    slot.recorder.collect(clock_, record);
    if (config_.hash) {
        XXH3_state_t state;
        XXH3_64bits_reset(&state);
        for (const Slot::Eye& eye : slot.eyes) {
            const std::span<const std::byte> pixels = eye.pixels.mapped();
            XXH3_64bits_update(&state, pixels.data(), pixels.size());
        }
        record.pixel_hash = XXH3_64bits_digest(&state);
    }
    if (method_->keeps_depth()) {
        method_->collect_depth(slot.number, seen_depth_);
    }
    return record;
}

void FrameRenderer::wait_idle() { context_->device().waitIdle(); }

}  // namespace gazeloop::render
