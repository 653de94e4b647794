#include "runtime/report/perfetto/gaze_states.h"

#include <algorithm>
#include <utility>

namespace gazeloop::report::perfetto {

GazeStates::GazeStates(TraceWriter& writer, Tracks& tracks, Unshown& unshown)
    : writer_(writer),
      tracks_(tracks),
      unshown_(unshown),
      reason_(writer.key("reason")),
      kind_(writer.key("kind")),
      kinds_(writer) {
    std::ranges::transform(gaze::kFoveaStateNames, states_.begin(),
                           [&writer](std::string_view name) { return writer.name(name); });
    std::ranges::transform(gaze::kLossReasonNames, reasons_.begin(),
                           [&writer](std::string_view name) { return writer.text(name); });
}

void GazeStates::add(const frame::FrameRecord& record) {
    const auto before = std::exchange(last_index_, record.index);
    if (!record.should_render || (before && *before + 1 != record.index)) {
        finish();
    }
    if (!record.should_render) {
        return;
    }
    const time::Stamp& latch = record.stamps.latch;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        EyeTrack& eye = eyes_[i];
        const gaze::FoveaPoint& fovea = record.fovea.eyes[i];
        const Open state{fovea.state, fovea.reason};
        if (!latch.known()) {
            unshown_.add(eye.subject, WhyUnshown::Unknown);
        } else if (!drawable_time(latch.ns)) {
            unshown_.add(eye.subject, WhyUnshown::OutOfRange);
        } else if (latch.ns < eye.last_ns) {
            unshown_.add(eye.subject, WhyUnshown::Backwards);
        } else {
            if (eye.open != state) {
                end(eye, latch.ns);
                begin(eye, state, latch);
            }
            eye.last_ns = latch.ns;
        }
    }
}

void GazeStates::end(EyeTrack& eye, std::int64_t ns) {
    if (std::exchange(eye.open, std::nullopt)) {
        writer_.add(
            TraceEvent{.type = EventType::SliceEnd, .track = tracks_.of(eye.subject), .ns = ns});
    }
}

void GazeStates::begin(EyeTrack& eye, const Open& state, const time::Stamp& from) {
    TraceEvent event{.type = EventType::SliceBegin,
                     .track = tracks_.of(eye.subject),
                     .ns = from.ns,
                     .name = states_[static_cast<std::size_t>(state.state)]};
    if (state.reason != gaze::LossReason::None) {
        event.annotations.add(reason_, reasons_[static_cast<std::size_t>(state.reason)]);
    }
    event.annotations.add(kind_, kinds_.of(from.kind));
    writer_.add(event);
    eye.open = state;
}

void GazeStates::finish() {
    for (EyeTrack& eye : eyes_) {
        end(eye, eye.last_ns);
    }
}

}  // namespace gazeloop::report::perfetto
