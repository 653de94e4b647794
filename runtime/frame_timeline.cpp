#include "runtime/frame_timeline.h"

#include <algorithm>
#include <iterator>

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

}  // namespace

time::Stamp LiveTimeline::now() { return time::measured_now(); }

std::int64_t LiveTimeline::slept_ns() const { return time::slept_ns(); }

void LiveTimeline::plan(const present::TargetFrame& target, const gaze::HeadMotion* head,
                        PlannedFrame& frame) {
    frame.display = target.display;
    frame.period_ns = target.period_ns;
    frame.should_render = target.should_render;
    frame.scene_time_s = static_cast<double>(target.display.ns - start_ns_) * 1e-9;
    frame.head = head != nullptr ? head->at(target.display.ns) : target.head;
    frame.views = head != nullptr ? on_head(frame.head, target.views, target.head) : target.views;
    frame.hidden = target.hidden;
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
}

time::Stamp RecordedTimeline::now() { return frames_[frame_].frame.stamps.wake_up; }

void RecordedTimeline::plan(const present::TargetFrame&, const gaze::HeadMotion*,
                            PlannedFrame& frame) {
    const frame::FrameRecord& recorded = frames_[frame_].frame;
    frame.display = recorded.stamps.display;
    frame.period_ns = recorded.period_ns;
    frame.should_render = recorded.should_render;
    frame.scene_time_s = recorded.scene_time_s;
    frame.head = recorded.head;
    frame.views = recorded.views;
    const auto later = std::ranges::upper_bound(
        hidden_, frame_, {}, [](const gaze::HiddenChange& change) { return change.frame; });
    frame.hidden = later == hidden_.begin() ? nullptr : std::prev(later)->meshes;
}

time::Stamp RecordedTimeline::latch() { return frames_[frame_].frame.stamps.latch; }

void RecordedTimeline::settle(frame::FrameRecord& record) {
    record.stamps = frames_[record.index].frame.stamps;
}

void RecordedTimeline::settle(frame::FrameGpuRecord& record) {
    record.gpu_begin = frames_[record.index].gpu.gpu_begin;
    record.gpu_end = frames_[record.index].gpu.gpu_end;
}

}  // namespace gazeloop
