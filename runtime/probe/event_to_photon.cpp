#include "runtime/probe/event_to_photon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gazeloop::probe {

void EventToPhotonModel::on_frame(const frame::FrameRecord& record) {
    if (record.should_render) {
        pending_.add(record,
                     [this](const latency::FinishedFrame& finished) { complete(finished); });
    }
}

void EventToPhotonModel::on_gpu(const frame::FrameGpuRecord& record) {
    pending_.add(record, [this](const latency::FinishedFrame& finished) { complete(finished); });
}

void EventToPhotonModel::complete(const latency::FinishedFrame& finished) {
    const latency::FrameAccount account = latency::account_of(finished, period_ns_, photons_);
    if (!account.with_gaze()) {
        sample_before_ = {};
        return;
    }
    const gaze::Eye older = latency::older_eye(finished.frame.fovea);
    const time::Stamp sampled = finished.frame.fovea.eyes[gaze::index(older)].sampled;
    const time::Span since = time::between(std::exchange(sample_before_, sampled), sampled);
    const time::Span& age = account.age.at_display;
    constexpr std::int64_t kPause_ns = 250'000'000;
    if (!since.known() || !age.known() || since.ns <= 0 || since.ns > kPause_ns) {
        return;
    }
    ++frames_;
    kind_ = time::weaker(kind_, age.kind);
    const double interval_ms = static_cast<double>(since.ns) / 1e6;
    const double age_ms = static_cast<double>(age.ns) / 1e6;
    weight_ms_ += interval_ms;
    weighted_ms2_ += interval_ms * (age_ms + interval_ms / 2.0);
    weighted_ms3_ +=
        interval_ms * (age_ms * age_ms + age_ms * interval_ms + interval_ms * interval_ms / 3.0);
}

EventToPhoton EventToPhotonModel::result() {
    pending_.finish([this](const latency::FinishedFrame& finished) { complete(finished); });
    EventToPhoton result{.frames = frames_};
    if (frames_ > 0) {
        const double mean_ms = weighted_ms2_ / weight_ms_;
        result.mean_ms = mean_ms;
        result.sd_ms = std::sqrt(std::max(0.0, weighted_ms3_ / weight_ms_ - mean_ms * mean_ms));
        result.kind = kind_;
    }
    return result;
}

}  // namespace gazeloop::probe
