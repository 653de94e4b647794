#include "runtime/session/gaze_ledger.h"

#include "runtime/latency/frame_account.h"

namespace gazeloop::session {

void GazeLedger::add(const gaze::GazeSample& sample) {
    samples_.add(sample);
    errors_.add(sample);
}

void GazeLedger::add(const frame::FrameRecord& record) {
    if (record.period_ns > 0) {
        periods_.add(record.period_ns);
    }
    if (record.should_render) {
        errors_.add(record);
        pending_.add(record,
                     [this](const latency::FinishedFrame& finished) { set_shown(finished); });
    }
}

void GazeLedger::add(const frame::FrameGpuRecord& record) {
    pending_.add(record, [this](const latency::FinishedFrame& finished) { set_shown(finished); });
}

void GazeLedger::finish() {
    pending_.finish([this](const latency::FinishedFrame& finished) { set_shown(finished); });
    errors_.finish();
}

void GazeLedger::set_shown(const latency::FinishedFrame& finished) {
    const latency::FrameAccount account =
        latency::account_of(finished, periods_.ns().value_or(0), {});
    errors_.set_shown(finished.frame.index, account.shown.at);
}

}  // namespace gazeloop::session
