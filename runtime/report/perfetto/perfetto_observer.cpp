#include "runtime/report/perfetto/perfetto_observer.h"

#include <algorithm>
#include <utility>

namespace gazeloop::report::perfetto {

PerfettoObserver::PerfettoObserver(PerfettoConfig config, TraceWriter::Sink sink)
    : samples_(config.samples),
      writer_(config.session.clock == latency::LoopClock::Virtual ? TraceClock::Own
                                                                  : TraceClock::Monotonic,
              std::move(sink)),
      tracks_(writer_, config.about),
      drawing_(writer_, tracks_, unshown_),
      frames_(writer_, drawing_, std::move(config.session)),
      events_(writer_, drawing_),
      states_(writer_, tracks_, unshown_) {}

void PerfettoObserver::on_sample(const gaze::GazeSample& sample, std::uint64_t) {
    events_.add(sample, samples_ == SampleDetail::All);
}

void PerfettoObserver::on_frame(const frame::FrameRecord& record) {
    draw_pending();
    pending_.emplace(latency::FinishedFrame{.frame = record, .gpu = std::nullopt});
    latch_ = record.stamps.latch;
}

void PerfettoObserver::on_gaze(const frame::FrameGaze& gaze) { events_.add(gaze.counts, latch_); }

void PerfettoObserver::on_gpu(const frame::FrameGpuRecord& record) {
    if (pending_ && pending_->frame.index == record.index) {
        pending_->gpu = record;
        draw_pending();
    }
}

void PerfettoObserver::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    events_.add(time, kind, text);
}

void PerfettoObserver::draw_pending() {
    if (pending_) {
        events_.add_frame(pending_->frame.index, pending_->frame.stamps.wake_up);
        states_.add(pending_->frame);
        frames_.draw(*pending_);
        pending_.reset();
    }
}

void PerfettoObserver::finish() {
    draw_pending();
    states_.finish();
    writer_.finish();
}

std::uint64_t PerfettoObserver::samples_left_out() const {
    const std::uint64_t samples = events_.samples();
    return samples_ == SampleDetail::All ? 0 : samples - std::min(samples, frames_.samples_used());
}

}  // namespace gazeloop::report::perfetto
