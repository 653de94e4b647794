#include "runtime/frame_loop.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/gaze/head_limits.h"
#include "runtime/render/depth.h"

namespace gazeloop {
namespace {

/// One second of a 1000 Hz tracker, so that a late frame need not allocate for its samples.
constexpr std::size_t kSamplesAtOnce = 1000;

class FrameLoop {
  public:
    FrameLoop(const LoopParts& parts, const LoopOptions& options)
        : parts_(parts), options_(options), renderer_(&parts.renderer) {
        samples_.reserve(kSamplesAtOnce);
        if (parts.renderer.config().depth_format != vk::Format::eUndefined) {
            target_frame_.depth = {.near_m = std::numeric_limits<float>::infinity(),
                                   .far_m = render::kDepthNear_m};
        }
    }

    LoopResult run() {
        try {
            follow_target();
            renderer_->wait_idle();
            report_finished_frames();
        } catch (...) {
            tell_the_rest();
            throw;
        }
        return result_;
    }

  private:
    void follow_target() {
        for (;;) {
            ask_for_end();
            const present::TargetState state = parts_.target.poll();
            report_target_events();
            if (state == present::TargetState::Ended) {
                break;
            }
            if (state == present::TargetState::Idle) {
                take_idle_gaze();
                continue;
            }
            if (ending_) {
                pass_empty_frame();
            } else {
                begin_time();
                one_frame();
            }
        }
    }

    /// After a failure: what the target had said before, and the frames that the GPU still
    /// finishes.
    void tell_the_rest() {
        try {
            report_target_events();
            renderer_->wait_idle();
            report_finished_frames();
        } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch)
            // It failed again after its failure; the first one is reported.
        }
    }

    void begin_time() {
        if (timeline_ == nullptr) {
            timeline_ = parts_.make_timeline();
            start_ns_ = timeline_->now().ns;
            slept_ns_ = timeline_->slept_ns();
            source_ = parts_.make_source(start_ns_);
            head_fixed_ = source_->fixed_in_head();
            result_.fixed_in_head = head_fixed_;
        }
    }

    /// The limits end the loop between frames: the target is asked, and winds down by itself.
    void ask_for_end() {
        if (ending_) {
            return;
        }
        if (const auto why = options_.stop ? options_.stop() : std::nullopt) {
            end(*why);
        } else if ((options_.frames && result_.frames >= *options_.frames) ||
                   (options_.seconds && time_is_up())) {
            end(LoopEnd::Limit);
        } else if (timeline_ != nullptr && (timeline_->over(result_.frames) ||
                                            (options_.end_with_source && source_->finished()))) {
            end(LoopEnd::SourceEnd);
        }
    }

    /// Counted up to the end of the frame by the clock, not by what a runtime announces.
    [[nodiscard]] bool time_is_up() const {
        return *options_.seconds <= 0.0 ||
               (timeline_ != nullptr && static_cast<double>(timeline_->now().ns) +
                                                static_cast<double>(planned_.period_ns) -
                                                static_cast<double>(start_ns_) >=
                                            *options_.seconds * 1e9);
    }

    void end(LoopEnd why) {
        ending_ = true;
        result_.end = why;
        parts_.target.request_exit();
    }

    void pass_empty_frame() {
        parts_.target.wait_frame(target_frame_);
        parts_.target.begin_frame();
        parts_.target.end_frame(target_frame_, false);
    }

    void one_frame() {
        timeline_->begin(result_.frames);
        frame::FrameRecord record;
        record.index = result_.frames;
        record.budget_ns = options_.budget_ns;

        parts_.target.wait_frame(target_frame_);
        record.stamps.wake_up = timeline_->now();
        parts_.target.begin_frame();
        record.stamps.begin = timeline_->now();
        parts_.target.locate(target_frame_);
        watch_for_sleep(record.stamps.begin);
        timeline_->plan(target_frame_, source_->head_track(), planned_);
        record.stamps.display = planned_.display;
        record.period_ns = planned_.period_ns;
        choose_renderer(record.index);
        if (parts_.chooser != nullptr) {
            record.quality_level = parts_.chooser->quality_level();
        }
        record.should_render = planned_.should_render;
        record.scene_time_s = planned_.scene_time_s;
        record.head = planned_.head;
        record.views = planned_.views;
        follow_hidden_area(record.index);
        follow_origin(record.index);

        // A frame that is not drawn still takes the gaze, so that the next one gets no old gaze.
        if (planned_.should_render) {
            view_.targets = parts_.target.acquire();
            renderer_->prepare(planned_.views);
            wait_for_gpu();
            report_finished_frames();
            begin(record.index);
        }
        record.stamps.latch = timeline_->latch();
        read_gaze(record.stamps.latch.ns);
        record.fovea = parts_.gaze.latch(record.stamps.latch, planned_.head, planned_.views,
                                         record.stamps.display);
        record.stamps.filtered = timeline_->now();
        if (planned_.should_render) {
            finish(record);
        }
        parts_.target.end_frame(target_frame_, planned_.should_render);
        record.stamps.end_frame = timeline_->now();
        timeline_->settle(record);

        report_source_events();
        report_gaze_changes(record.fovea);
        for (frame::FrameObserver* const observer : parts_.observers) {
            observer->on_frame(record);
        }
        ++result_.frames;
    }

    /// Where a chooser decides by whom a frame is drawn. No renderer is left with frames under way.
    void choose_renderer(std::uint64_t frame) {
        if (parts_.chooser == nullptr) {
            return;
        }
        render::FrameRenderer* const chosen = parts_.chooser->choose(
            {.index = frame,
             .shown_ns = planned_.display.known() ? planned_.display.ns : timeline_->now().ns,
             .should_render = planned_.should_render,
             .period_ns = planned_.period_ns,
             .recorded_level = planned_.quality_level});
        if (const auto event = parts_.chooser->take_event()) {
            report_event(timeline_->now(), event->kind, event->text.view());
        }
        planned_.scene_time_s = parts_.chooser->scene_time_s(planned_.scene_time_s);
        if (chosen == nullptr) {
            planned_.should_render = false;
        } else if (chosen != renderer_) {
            renderer_->wait_idle();
            report_finished_frames();
            renderer_ = chosen;
            last_gpu_ns_ = 0;
        }
    }

    /// Another mask, or other fields of view for it. This is rare, so it may take its time.
    void follow_hidden_area(std::uint64_t frame) {
        const gaze::HiddenMeshes meshes = options_.hidden_area ? planned_.hidden : nullptr;
        const bool changed = meshes != hidden_.meshes;
        const auto same_picture = [](const gaze::EyeView& a, const gaze::EyeView& b) {
            return a.fov == b.fov && a.width_px == b.width_px && a.height_px == b.height_px;
        };
        if (!changed && std::ranges::equal(planned_.views, hidden_views_, same_picture)) {
            return;
        }
        hidden_ = {frame, meshes};
        hidden_views_ = planned_.views;
        hidden_areas_ = foveation::hidden_areas(meshes, planned_.views);
        if (changed) {
            for (frame::FrameObserver* const observer : parts_.observers) {
                observer->on_hidden(hidden_);
            }
            report_event(timeline_->now(), frame::kHiddenAreaEvent,
                         fmt::format("hidden pixels: left {}, right {}", hidden_pixels(0),
                                     hidden_pixels(1)));
        }
    }

    /// Held gaze goes along with the world; what was seen in the one before is forgotten.
    void follow_origin(std::uint64_t frame) {
        if (const std::uint64_t given_up = timeline_->origins_given_up(); given_up > 0) {
            report_event(timeline_->now(), frame::kOriginEvent,
                         fmt::format("{} announced new origin{} never showed in the head's poses: "
                                     "not followed; the runtime is at fault",
                                     given_up, given_up == 1 ? "" : "s"));
        }
        if (!planned_.origin) {
            return;
        }
        gaze::OriginChange change = *planned_.origin;
        change.frame = frame;
        parts_.gaze.move_origin(change.new_in_old);
        first_in_this_world_ = frame;
        source_->take_seen_depth({});
        for (frame::FrameObserver* const observer : parts_.observers) {
            observer->on_origin(change);
        }
        report_event(
            timeline_->now(), frame::kOriginEvent,
            fmt::format("new origin, turned by {:.1f} deg and moved by {:.3f} m, {}",
                        glm::degrees(gaze::turned_rad({}, change.new_in_old)),
                        glm::length(change.new_in_old.position_m),
                        change.announced ? "as the runtime said: held gaze goes along"
                                         : "by how the head stands: held gaze stays in the head"));
    }

    [[nodiscard]] std::uint64_t hidden_pixels(std::size_t eye) const {
        return hidden_areas_[eye] != nullptr ? hidden_areas_[eye]->hidden_pixels() : 0;
    }

    void read_gaze(std::int64_t now_ns) {
        samples_.clear();
        source_->poll(now_ns, samples_);
        for (gaze::GazeSample& sample : samples_) {
            if (!sample.head && !head_fixed_ && sample.sampled.known()) {
                sample.head = head_at(sample.sampled.ns);
            }
            if (sample.head) {
                const time::Stamp& seen = sample.sampled.known() ? sample.sampled : sample.arrived;
                sample.head = timeline_->in_this_world(*sample.head, seen.ns);
            }
            parts_.gaze.add(sample);
            for (frame::FrameObserver* const observer : parts_.observers) {
                observer->on_sample(sample, result_.frames);
            }
        }
    }

    /// While the target wants no frames, the gaze is still taken. Otherwise the first frame after
    /// that would find a queue full of the oldest gaze.
    void take_idle_gaze() {
        if (timeline_ != nullptr && timeline_->is_live()) {
            read_gaze(timeline_->now().ns);
            report_source_events();
        }
    }

    /// In the world that the views are in: the source's, if it knows the head, else the target's.
    [[nodiscard]] std::optional<gaze::Pose> head_at(std::int64_t time_ns) {
        if (const gaze::HeadMotion* const motion = source_->head_track()) {
            return motion->at(time_ns);
        }
        return timeline_->is_live() ? parts_.target.head_at(time_ns) : std::nullopt;
    }

    /// What needs no gaze goes to the GPU before the gaze is read.
    void begin(std::uint64_t frame) {
        view_.index = frame;
        view_.scene_time_s = planned_.scene_time_s;
        view_.views = planned_.views;
        view_.hidden = hidden_areas_;
        renderer_->begin(view_);
        if (options_.wait_before_latch) {
            renderer_->wait_for_begun();
        }
    }

    void finish(frame::FrameRecord& record) {
        gaze::FrameFovea drawn;
        if (parts_.chooser != nullptr) {
            drawn = parts_.chooser->drawn(record.fovea, record.views);
        }
        const gaze::FrameFovea& fovea = parts_.chooser != nullptr ? drawn : record.fovea;
        record.samples = renderer_->finish(fovea);
        if (parts_.chooser != nullptr) {
            record.samples = parts_.chooser->in_run(*renderer_, record.samples);
        }
        record.stamps.submit = timeline_->now();
        for (frame::FrameObserver* const observer : parts_.observers) {
            observer->on_rendered(view_, fovea);
        }
    }

    /// Frames overlap on the GPU only while it keeps up with the display. Behind a backlog, the
    /// gaze would age by whole frames between latch and display.
    void wait_for_gpu() {
        if (last_gpu_ns_ > planned_.period_ns) {
            renderer_->wait_for_slot(1);
        } else {
            renderer_->wait_for_slot();
        }
    }

    void report_finished_frames() {
        while (auto finished = renderer_->next_finished()) {
            if (parts_.chooser != nullptr) {
                finished = parts_.chooser->in_run(*renderer_, *finished);
            }
            if (finished->gpu_begin.known() && finished->gpu_end.known()) {
                last_gpu_ns_ = finished->gpu_end.ns - finished->gpu_begin.ns;
            }
            timeline_->settle(*finished);
            for (frame::FrameObserver* const observer : parts_.observers) {
                observer->on_gpu(*finished);
            }
            if (finished->index >= first_in_this_world_) {
                source_->take_seen_depth(renderer_->seen_depth());
            }
        }
    }

    void report_gaze_changes(const gaze::FrameFovea& fovea) {
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::FoveaPoint& point = fovea.eyes[gaze::index(eye)];
            Seen& seen = seen_[gaze::index(eye)];
            if (seen.state == point.state && seen.reason == point.reason &&
                seen.cause == point.cause) {
                continue;
            }
            seen = {point.state, point.reason, point.cause};
            std::array<char, 96> text{};
            const bool lost = point.reason != gaze::LossReason::None;
            const bool why = point.cause != gaze::LossCause::None;
            const auto end = fmt::format_to_n(
                text.data(), text.size(), "{} eye: {}{}{}{}{}{}", gaze::kEyeNames[gaze::index(eye)],
                gaze::kFoveaStateNames[static_cast<std::size_t>(point.state)],
                lost || why ? " (" : "",
                lost ? gaze::kLossReasonNames[static_cast<std::size_t>(point.reason)] : "",
                lost && why ? ": " : "",
                why ? gaze::kLossCauseNames[static_cast<std::size_t>(point.cause)] : "",
                lost || why ? ")" : "");
            report_event(fovea.latched, frame::kGazeEvent, {text.data(), end.size});
        }
    }

    /// Stamps do not show it, but every device's clock has run on, and the gaze may be from before.
    void watch_for_sleep(time::Stamp now) {
        constexpr std::int64_t kWorthTelling = 500'000'000;
        const std::int64_t slept_ns = timeline_->slept_ns();
        if (slept_ns - slept_ns_ > kWorthTelling) {
            std::array<char, 96> text{};
            const auto end = fmt::format_to_n(text.data(), text.size(),
                                              "the machine slept for {:.1f} s before this",
                                              static_cast<double>(slept_ns - slept_ns_) * 1e-9);
            report_event(now, frame::kClockEvent, {text.data(), end.size});
        }
        slept_ns_ = std::max(slept_ns_, slept_ns);
    }

    void report_target_events() {
        for (const frame::Event& event : parts_.target.take_events()) {
            report_event(timeline_ != nullptr ? timeline_->now() : time::Stamp{}, event.kind,
                         event.text);
        }
    }

    void report_source_events() {
        for (const drivers::SourceEvent& event : source_->take_events()) {
            report_event(event.time, event.kind, event.text);
        }
    }

    void report_event(time::Stamp time, const frame::EventKind& kind, std::string_view text) {
        for (frame::FrameObserver* const observer : parts_.observers) {
            observer->on_event(time, kind.name, text);
        }
    }

    struct Seen {
        gaze::FoveaState state = gaze::FoveaState::Ahead;
        gaze::LossReason reason = gaze::LossReason::Never;
        gaze::LossCause cause = gaze::LossCause::None;
    };

    const LoopParts& parts_;
    const LoopOptions& options_;
    render::FrameRenderer* renderer_;  ///< of the present frame
    std::unique_ptr<FrameTimeline> timeline_;
    std::unique_ptr<drivers::GazeSource> source_;
    std::int64_t start_ns_ = 0;
    std::int64_t slept_ns_ = 0;
    std::int64_t last_gpu_ns_ = 0;
    bool head_fixed_ = false;
    bool ending_ = false;
    present::TargetFrame target_frame_;
    PlannedFrame planned_;
    render::FrameView view_;     ///< of the frame that is rendered
    gaze::HiddenChange hidden_;  ///< in force, and of these views
    gaze::StereoView hidden_views_;
    std::uint64_t first_in_this_world_ = 0;  ///< frame
    foveation::HiddenAreas hidden_areas_;
    std::vector<gaze::GazeSample> samples_;
    gaze::PerEye<Seen> seen_;
    LoopResult result_{.end = LoopEnd::TargetEnd};
};

}  // namespace

LoopResult run_frame_loop(const LoopParts& parts, const LoopOptions& options) {
    return FrameLoop(parts, options).run();
}

}  // namespace gazeloop
