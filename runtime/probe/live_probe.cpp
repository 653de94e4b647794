#include "runtime/probe/live_probe.h"

#include <utility>

namespace gazeloop::probe {

void LiveProbe::on_sample(const gaze::GazeSample& sample, std::uint64_t /*frame*/) {
    watch_.add(sample);
}

void LiveProbe::on_rendered(const render::FrameView& view, const gaze::FrameFovea& fovea) {
    flipped_ = watch_.turns_at(fovea);
    painter_.paint(view, watch_.lost());
}

void LiveProbe::on_frame(const frame::FrameRecord& record) {
    if (!std::exchange(flipped_, false)) {
        return;
    }
    Flip flip = watch_.turn();
    flip.frame = record.index;
    flip.latched = record.stamps.latch;
    flip.display = record.stamps.display;
    flip.period_ns = record.period_ns;
    log_->add(flip);
}

void LiveProbe::on_gpu(const frame::FrameGpuRecord& record) {
    log_->set_shown(record.index, record.gpu_end);
}

}  // namespace gazeloop::probe
