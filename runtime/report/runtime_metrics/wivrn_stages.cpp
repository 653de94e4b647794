#include "runtime/report/runtime_metrics/wivrn_stages.h"

#include <algorithm>

#include "runtime/time/span.h"

namespace gazeloop::report {
namespace {

bool of_headset(WivrnEvent event) { return event >= WivrnEvent::ReceiveBegin; }

/// The server's clock is the host's. The headset's times are in it by WiVRn's fit, which lets the
/// constant part of the way unseen: a time line of somebody else. What is displayed when is
/// predicted by the headset's runtime.
time::Stamp stamp(const WivrnTimes& times, WivrnEvent event) {
    const std::optional<std::int64_t> ns = times[event];
    if (!ns) {
        return {};
    }
    return {*ns, event == WivrnEvent::Display ? time::StampKind::Predicted
                 : of_headset(event)          ? time::StampKind::Modelled
                                              : time::StampKind::Measured};
}

time::Span span(const WivrnTimes& times, const WivrnStage& stage, const time::Stamp& end_frame) {
    time::Span span =
        time::between(stage.from ? stamp(times, *stage.from) : end_frame, stamp(times, stage.to));
    // Of one clock, whatever that is off by.
    if (stage.from && of_headset(*stage.from) && span.kind == time::StampKind::Modelled) {
        span.kind = time::StampKind::Measured;
    }
    return span;
}

}  // namespace

void WivrnStages::on_frame(const frame::FrameRecord& record) {
    if (!record.should_render) {
        return;
    }
    ++counts_.frames;
    if (record.stamps.wake_up.kind == time::StampKind::Measured) {
        counts_.first_ns = counts_.first_ns.value_or(record.stamps.wake_up.ns);
        counts_.last_ns = record.stamps.wake_up.ns;
    }
    WivrnFrame* const frame = frame_of(record);
    if (frame == nullptr) {
        return;
    }
    ++counts_.joined;
    frame->joined = true;
    const WivrnTimes together = frame->together();
    add(together_, together, record.stamps.end_frame);
    for (std::size_t stream = 0; stream < WivrnFrame::kMostStreams; ++stream) {
        add(streams_[stream], frame->of_stream(stream), {});
    }
    display_error_.add(time::between(record.stamps.display, stamp(together, WivrnEvent::Display)));
}

WivrnFrame* WivrnStages::frame_of(const frame::FrameRecord& record) {
    // The headset tells of a frame after it has shown it.
    constexpr std::int64_t kToldWithinNs = 3'000'000'000;
    const frame::FrameStamps& stamps = record.stamps;
    if (stamps.display.kind != time::StampKind::Predicted || record.period_ns <= 0) {
        ++counts_.not_announced;
        return nullptr;
    }
    const std::int64_t end_ns = std::max(stamps.display.ns, stamps.end_frame.ns);
    value_or_throw(
        frames_.read_until(time::saturated(static_cast<__int128>(end_ns) + kToldWithinNs)));
    WivrnFrame* const frame = frames_.nearest(stamps.display.ns, record.period_ns / 2);
    if (frame == nullptr) {
        ++counts_.missing;
        return nullptr;
    }
    if (frame->joined) {
        ++counts_.taken;
        return nullptr;
    }
    const auto encoded = frame->together()[WivrnEvent::EncodeBegin];
    if (encoded && stamps.submit.known() && *encoded < stamps.submit.ns) {
        ++counts_.too_early;
        return nullptr;
    }
    return frame;
}

void WivrnStages::add(Series& series, const WivrnTimes& times, const time::Stamp& end_frame) {
    for (std::size_t stage = 0; stage < kWivrnStages.size(); ++stage) {
        series[stage].add(span(times, kWivrnStages[stage], end_frame));
    }
}

std::size_t WivrnStages::streams() const {
    std::size_t count = 0;
    for (std::size_t stream = 0; stream < WivrnFrame::kMostStreams; ++stream) {
        const bool any = std::ranges::any_of(
            streams_[stream],
            [](const latency::SpanSeries& series) { return series.row().count > 0; });
        count = any ? stream + 1 : count;
    }
    return count;
}

}  // namespace gazeloop::report
