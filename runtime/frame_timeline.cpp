#include "runtime/frame_timeline.h"

#include <fmt/core.h>

#include "runtime/time/clock.h"

namespace gazeloop {
namespace {

/// The same eyes on another head.
gaze::StereoView on_head(const gaze::Pose& head, const gaze::StereoView& views,
                         const gaze::Pose& views_head) {
    gaze::StereoView moved = views;
    const gaze::Pose change = gaze::compose(head, gaze::inverse(views_head));
    for (gaze::EyeView& view : moved) {
        view.pose = gaze::compose(change, view.pose);
    }
    return moved;
}

const session::RecordedFrame& frame_at(session::FrameCursor& cursor, std::uint64_t index) {
    if (!value_or_throw(session::move_to(cursor, index))) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("the recording has lost its frame {} meanwhile", index));
    }
    return *cursor.row();
}

}  // namespace

time::Stamp LiveTimeline::now() { return time::measured_now(); }

std::int64_t LiveTimeline::slept_ns() const { return time::slept_ns(); }

void LiveTimeline::plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
                        PlannedFrame& frame) {
    frame.display = target.display;
    frame.period_ns = target.period_ns;
    frame.should_render = target.should_render;
    frame.scene_time_s = static_cast<double>(target.aimed_ns - start_ns_) * 1e-9;
    frame.head = head != nullptr ? head->at(target.aimed_ns) : target.head;
    frame.views = head != nullptr ? on_head(frame.head, target.views, target.head) : target.views;
    frame.hidden = target.hidden;
    frame.origin.reset();
    if (head == nullptr) {
        for (const gaze::AnnouncedOrigin& announced : target.new_origins) {
            origin_.announce(announced);
        }
        frame.origin = origin_.next(target.display.ns, target.period_ns, target.head);
    }
}

time::Stamp VirtualTimeline::now() {
    return {static_cast<std::int64_t>(frame_) * model_.period_ns, time::StampKind::Modelled};
}

void VirtualTimeline::plan(const present::TargetFrame&, const gaze::HeadMotion* head,
                           PlannedFrame& frame) {
    frame.display = {now().ns + model_.period_ns, time::StampKind::Modelled};
    frame.period_ns = model_.period_ns;
    frame.should_render = true;
    frame.scene_time_s = static_cast<double>(frame.display.ns) * 1e-9;
    frame.head = head != nullptr ? head->at(frame.display.ns) : gaze::Pose{};
    frame.views = on_head(frame.head, model_.views, gaze::Pose{});
}

void VirtualTimeline::settle(frame::FrameRecord& record) {
    if (record.should_render) {
        record.stamps.gpu_begin = record.stamps.submit;
        record.stamps.gpu_end = {record.stamps.submit.ns + model_.gpu_ns,
                                 time::StampKind::Modelled};
    }
}

void VirtualTimeline::settle(frame::FrameGpuRecord& record) {
    const std::int64_t submit = static_cast<std::int64_t>(record.index) * model_.period_ns;
    record.gpu_begin = {submit, time::StampKind::Modelled};
    record.gpu_end = {submit + model_.gpu_ns, time::StampKind::Modelled};
    record.pass_starts = {};  // the passes took real time, which has no place in the model's
    record.clock_deviation_ns.reset();
}

RecordedTimeline::RecordedTimeline(const session::OpenSession& session, std::uint64_t frames)
    : frame_count_(frames),
      begun_(session),
      finished_(session),
      hidden_(session),
      origin_(session) {
    value_or_throw(hidden_.next());
    value_or_throw(origin_.next());
    begin(0);
}

time::Stamp RecordedTimeline::now() { return frame_.stamps.wake_up; }

void RecordedTimeline::begin(std::uint64_t frame) {
    frame_ = frame_at(begun_, frame).frame;
    while (hidden_.row() != nullptr && hidden_.row()->frame <= frame) {
        hidden_now_ = hidden_.row()->meshes;
        value_or_throw(hidden_.next());
    }
    origin_now_.reset();
    while (origin_.row() != nullptr && origin_.row()->frame <= frame) {
        origin_now_ = *origin_.row();
        value_or_throw(origin_.next());
    }
}

void RecordedTimeline::plan(const present::TargetFrame&, const gaze::HeadMotion*,
                            PlannedFrame& frame) {
    frame.display = frame_.stamps.display;
    frame.period_ns = frame_.period_ns;
    frame.should_render = frame_.should_render;
    frame.scene_time_s = frame_.scene_time_s;
    frame.head = frame_.head;
    frame.views = frame_.views;
    frame.hidden = hidden_now_;
    frame.origin = origin_now_;
    frame.quality_level = frame_.quality_level;
}

time::Stamp RecordedTimeline::latch() { return frame_.stamps.latch; }

void RecordedTimeline::settle(frame::FrameRecord& record) { record.stamps = frame_.stamps; }

void RecordedTimeline::settle(frame::FrameGpuRecord& record) {
    const frame::FrameGpuRecord& gpu = frame_at(finished_, record.index).gpu;
    record.gpu_begin = gpu.gpu_begin;
    record.gpu_end = gpu.gpu_end;
    record.pass_starts = {};  // of this run's passes, which ran at no time of the recording
    record.clock_deviation_ns = gpu.clock_deviation_ns;
}

}  // namespace gazeloop
