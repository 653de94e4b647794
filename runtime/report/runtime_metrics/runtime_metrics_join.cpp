#include "runtime/report/runtime_metrics/runtime_metrics_join.h"

#include <algorithm>

#include "runtime/time/span.h"

namespace gazeloop::report {

void RuntimeMetricsJoin::on_sample(const gaze::GazeSample& sample, std::uint64_t frame) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_sample(sample, frame);
    }
}

void RuntimeMetricsJoin::on_hidden(const gaze::HiddenChange& change) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_hidden(change);
    }
}

void RuntimeMetricsJoin::on_origin(const gaze::OriginChange& change) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_origin(change);
    }
}

void RuntimeMetricsJoin::on_gpu(const frame::FrameGpuRecord& record) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_gpu(record);
    }
}

void RuntimeMetricsJoin::on_gaze(const frame::FrameGaze& gaze) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_gaze(gaze);
    }
}

void RuntimeMetricsJoin::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_event(time, kind, text);
    }
}

void RuntimeMetricsJoin::on_frame(const frame::FrameRecord& record) {
    frame::FrameRecord joined = record;
    if (record.should_render) {
        join(joined);
    }
    for (frame::FrameObserver* const observer : observers_) {
        observer->on_frame(joined);
    }
}

void RuntimeMetricsJoin::join(frame::FrameRecord& record) {
    // What is written of a frame is written within a few of the display's periods.
    constexpr std::int64_t kWrittenWithinNs = 5'000'000'000;
    frame::FrameStamps& stamps = record.stamps;
    ++counts_.frames;
    if (stamps.wake_up.kind == time::StampKind::Measured) {
        counts_.first_ns = counts_.first_ns.value_or(stamps.wake_up.ns);
        counts_.last_ns = stamps.wake_up.ns;
    }
    if (stamps.display.kind != time::StampKind::Predicted) {
        ++counts_.not_announced;
        return;
    }
    const std::int64_t end_ns = std::max(stamps.display.ns, stamps.end_frame.ns);
    frames_.read_until(time::saturated(static_cast<__int128>(end_ns) + kWrittenWithinNs));
    const MonadoShown told = frames_.find(stamps.display.ns, stamps.begin.ns);
    ++counts_.by_fate[static_cast<std::size_t>(told.fate)];
    counts_.repeated += told.times > 1 ? 1 : 0;
    if (told.fate == MonadoFate::Replaced) {
        stamps.display = {};
    }
    if (told.shown.known()) {
        stamps.present = told.present;
        stamps.shown = told.shown;
        counts_.compositor_late +=
            told.compositor_late && told.fate == MonadoFate::Modelled ? 1 : 0;
    }
}

}  // namespace gazeloop::report
