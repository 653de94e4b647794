#include "runtime/render/passes/antialiased_passes.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/eye_sets.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/post_filter.h"
#include "runtime/render/saccade_landing.h"
#include "runtime/vulkan/history.h"
#include "runtime/vulkan/layered_image.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

/// A history is never rounded to halves, because its error would add up.
constexpr vk::Format kPastFormat = vk::Format::eR32G32B32A32Sfloat;
constexpr vk::Format kOwnDepthFormat = vk::Format::eD32Sfloat;

/// Images of the sets (shaders/lib/finish.glsl, shaders/resolve).
enum Image : std::uint32_t { kShown, kShownDepth, kPast, kFinished, kImages };

/// Constants of shaders/resolve/finish.frag.
enum Constant : std::uint32_t { kLargestFilter = kOfMethod, kDownwards };

/// std140, shaders/lib/finish.glsl.
struct FinishUniforms {
    glm::vec4 fovea{0.0F};
    glm::vec4 sampling{0.0F};
};

/// What the method is asked to draw: its picture in linear light and, for who follows motion, its
/// depth.
PassSetup for_method(const PassSetup& setup) {
    PassSetup own = setup;
    own.format = kLpFormat;
    if (setup.antialiasing.over_frames) {
        own.depth_format = kOwnDepthFormat;
    }
    return own;
}

frame::PassList with_finish(const frame::PassList& method, bool over_frames, bool filters) {
    return value_or_throw(frame::PassList::parse(
        method.text() + (over_frames ? " taa" : "") + (filters ? " post_filter" : " encode"),
        frame::kMostPasses));
}

class AntialiasedPasses final : public MethodPasses {
  public:
    AntialiasedPasses(const PassSetup& setup, std::unique_ptr<MethodPasses> method)
        : setup_(setup),
          target_setup_(setup),
          method_(std::move(method)),
          over_frames_(setup.antialiasing.over_frames),
          filter_px_(method_->is_foveated() ? largest_post_filter(setup.antialiasing.post_filter_px)
                                            : 1),
          passes_(with_finish(method_->passes(), over_frames_, filters())),
          sampler_(make_sampler(setup.context.device(), vk::Filter::eNearest)),
          sets_(setup, {.uniform_bytes = sizeof(FinishUniforms), .images = kImages}, *sampler_),
          down_sets_(setup, {.uniform_bytes = sizeof(FinishUniforms), .images = kImages},
                     *sampler_),
          layout_(vulkan::make_pipeline_layout(setup.context.device(),
                                               {setup.frame_layout, {}, sets_.layout()},
                                               setup.empty_layout)) {
        if (!over_frames_) {
            // The method draws the target's depth itself.
            target_setup_.depth_format = vk::Format::eUndefined;
        }
        make_images();
        make_pipelines();
    }

    [[nodiscard]] const frame::PassList& passes() const override { return passes_; }
    [[nodiscard]] const foveation::MethodPlan& plan() const override { return method_->plan(); }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return method_->fits(views);
    }
    void prepare(const gaze::StereoView& views) override { method_->prepare(views); }

    void record_before_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame) override {
        redirect(frame);
        method_->record_before_gaze(recorder, of_method(frame));
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        redirect(frame);
        method_->record_after_gaze(recorder, of_method(frame), plans);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            // Sets may not change once commands have bound them.
            prepare_eye(frame, e, plans[e]);
        }
        if (over_frames_) {
            mix_frames(recorder.begin("taa"), frame);
        }
        finish(recorder.begin(filters() ? "post_filter" : "encode"), frame);
    }

    [[nodiscard]] bool keeps_depth() const override { return method_->keeps_depth(); }
    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        method_->record_depth_copies(commands, frame, plans, fovea);
    }
    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        method_->collect_depth(slot, seen);
    }
    [[nodiscard]] std::vector<BufferPicture> buffers(
        gaze::Eye eye, const foveation::EyePlan& plan) const override {
        return method_->buffers(eye, plan);
    }

  private:
    /// What an eye keeps.
    struct Eye {
        vulkan::ColorImage shown;    ///< what the method drew
        vulkan::LayeredImage depth;  ///< of it; only over frames
        vulkan::TrackedColorImage half_filtered;
        vulkan::History history;
        SaccadeLanding landing;
    };

    [[nodiscard]] bool filters() const { return filter_px_ >= 3; }

    void make_images() {
        using Usage = vk::ImageUsageFlagBits;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            Eye& eye = eyes_[e];
            const vk::Extent2D extent = setup_.extents[e];
            const vk::ImageUsageFlags usage = Usage::eColorAttachment | Usage::eSampled;
            eye.shown = vulkan::ColorImage(setup_.context, extent, kLpFormat, usage);
            color_[e] = vulkan::TrackedImage(eye.shown.image(), vk::ImageAspectFlagBits::eColor);
            // What a set is never asked for, any image does.
            const vk::ImageView shown = eye.shown.view();
            vk::ImageView depth = shown;
            vk::ImageView past = shown;
            vk::ImageView half = shown;
            if (over_frames_) {
                eye.depth = vulkan::LayeredImage(
                    setup_.context, {.extent = extent,
                                     .format = kOwnDepthFormat,
                                     .usage = Usage::eDepthStencilAttachment | Usage::eSampled,
                                     .aspect = vk::ImageAspectFlagBits::eDepth});
                depth_[e] =
                    vulkan::TrackedImage(eye.depth.image(), vk::ImageAspectFlagBits::eDepth);
                eye.history = vulkan::History(setup_.context, extent, kPastFormat);
                depth = eye.depth.view();
                eye.history.advance();
                past = eye.history.now().image.view();
            }
            if (filters()) {
                eye.half_filtered = {setup_.context, extent, kLpFormat, usage};
                half = eye.half_filtered.image.view();
            }
            sets_.attach(e, 1, {}, std::array{shown, depth, past, past});
            down_sets_.attach(e, 1, {}, std::array{shown, depth, past, half});
        }
    }

    void make_pipelines() {
        const vk::raii::Device& device = setup_.context.device();
        if (over_frames_) {
            taa_ = vulkan::make_pipeline(
                device, layout_,
                {.vertex = "full_screen.vert", .fragment = "taa.frag", .format = kPastFormat});
        }
        if (filters()) {
            const std::array across{vulkan::ShaderConstant{kLargestFilter, filter_px_}};
            across_ = vulkan::make_pipeline(device, layout_,
                                            {.vertex = "full_screen.vert",
                                             .fragment = "finish.frag",
                                             .format = kLpFormat,
                                             .constants = across});
        }
        const std::array constants{
            vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup_.format) ? 0U : 1U},
            vulkan::ShaderConstant{kLargestFilter, filters() ? filter_px_ : 0},
            vulkan::ShaderConstant{kDownwards, 1}};
        finish_ = vulkan::make_pipeline(device, layout_,
                                        {.vertex = "full_screen.vert",
                                         .fragment = resolve_shader("finish", target_setup_),
                                         .format = target_setup_.format,
                                         .depth_format = target_setup_.depth_format,
                                         .constants = constants});
    }

    /// Lets the method draw into the pictures of its own.
    void redirect(const FrameRecording& frame) {
        view_ = frame.view;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            EyeTarget& target = view_.targets[e];
            target.image = eyes_[e].shown.image();
            target.view = eyes_[e].shown.view();
            if (over_frames_) {
                target.depth_image = eyes_[e].depth.image();
                target.depth_view = eyes_[e].depth.view();
            }
        }
    }
    [[nodiscard]] FrameRecording of_method(const FrameRecording& frame) {
        return {.view = view_,
                .in_run = frame.in_run,
                .slot = frame.slot,
                .frame_sets = frame.frame_sets,
                .scene_sets = frame.scene_sets,
                .color = color_,
                .depth = over_frames_ ? depth_ : frame.depth,
                .fovea = frame.fovea};
    }

    void prepare_eye(const FrameRecording& frame, std::size_t e, const foveation::EyePlan& made) {
        Eye& eye = eyes_[e];
        const gaze::EyeView& view = frame.view.views[e];
        const gaze::FoveaPoint fovea = plan().followed(view, frame.fovea->eyes[e]);
        bool remembers = false;
        if (over_frames_) {
            if (!frame.in_run.follows) {
                eye.history.reset();
                eye.landing.reset();
            }
            if (eye.landing.landed(fovea, view.pose) && setup_.antialiasing.forget_at_landings) {
                eye.history.reset();
            }
            eye.history.advance();
            remembers = eye.history.before() != nullptr;
            sets_.attach_image(frame.slot, e, kPast, eye.history.other().image.view());
            sets_.attach_image(frame.slot, e, kFinished, eye.history.now().image.view());
        }
        const glm::dvec2 at(fovea.position.x_px, fovea.position.y_px);
        const glm::dvec2 size(view.width_px, view.height_px);
        const double farthest_px = glm::length(glm::max(glm::abs(at), glm::abs(size - at)));
        const FinishUniforms uniforms{
            .fovea = glm::vec4(glm::dvec4(at, 1.0 / farthest_px, made.ring_px)),
            .sampling = glm::vec4(glm::dvec4(method_->row_angle_rad(gaze::kEyes.at(e)),
                                             remembers ? 1.0 : 0.0, 0.0, 0.0))};
        sets_.write(frame.slot, e, uniforms, {});
        down_sets_.write(frame.slot, e, uniforms, {});
    }

    void mix_frames(const vk::raii::CommandBuffer& commands, const FrameRecording& frame) {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            Eye& eye = eyes_[e];
            color_[e].use(commands, vulkan::Use::Sampled);
            depth_[e].use(commands, vulkan::Use::Sampled);
            eye.history.other().tracked.use(
                commands, vulkan::Use::Sampled,
                eye.history.before() != nullptr ? vulkan::Keep::Content : vulkan::Keep::Nothing);
            draw_into(commands, frame, e, eye.history.now(), taa_);
        }
    }

    void finish(const vk::raii::CommandBuffer& commands, const FrameRecording& frame) {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            color_[e].use(commands, vulkan::Use::Sampled);
            if (filters()) {
                draw_into(commands, frame, e, eyes_[e].half_filtered, across_);
            }
        }
        draw_pictures(commands, frame, target_setup_, [&](std::size_t e) {
            bind_sets(commands, layout_, frame, e,
                      (filters() ? down_sets_ : sets_).of(frame.slot, e));
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *finish_);
            draw_visible(commands, frame.view.hidden[e].get());
        });
    }

    /// What no eye sees holds zeros, by which the next pass knows it.
    void draw_into(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                   std::size_t e, vulkan::TrackedColorImage& image,
                   const vk::raii::Pipeline& pipeline) {
        const foveation::HiddenArea* const hidden = frame.view.hidden[e].get();
        image.tracked.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        begin_rendering(
            commands, image.image.view(), image.image.extent(),
            hidden != nullptr ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare);
        bind_sets(commands, layout_, frame, e, sets_.of(frame.slot, e));
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        draw_visible(commands, hidden);
        commands.endRendering();
        image.tracked.use(commands, vulkan::Use::Sampled);
    }

    PassSetup setup_;
    PassSetup target_setup_;  ///< of the last pass
    std::unique_ptr<MethodPasses> method_;
    bool over_frames_;
    std::uint32_t filter_px_;
    frame::PassList passes_;
    vk::raii::Sampler sampler_;
    EyeSets sets_;
    EyeSets down_sets_;  ///< the same, reading what is half filtered
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline taa_{nullptr};
    vk::raii::Pipeline across_{nullptr};
    vk::raii::Pipeline finish_{nullptr};
    gaze::PerEye<Eye> eyes_;
    gaze::PerEye<vulkan::TrackedImage> color_;  ///< of Eye::shown
    gaze::PerEye<vulkan::TrackedImage> depth_;
    FrameView view_;  ///< the frame's, into those pictures
};

}  // namespace

std::unique_ptr<MethodPasses> make_antialiased_passes(const PassSetup& setup,
                                                      const MakePasses& make_method) {
    const Antialiasing& wanted = setup.antialiasing;
    if (!wanted.over_frames && largest_post_filter(wanted.post_filter_px) < 3) {
        return make_method(setup);
    }
    auto method = make_method(for_method(setup));
    if (!wanted.over_frames && !method->is_foveated()) {
        return make_method(setup);
    }
    return std::make_unique<AntialiasedPasses>(setup, std::move(method));
}

}  // namespace gazeloop::render
