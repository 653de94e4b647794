#include "runtime/latency/frame_account.h"

#include <algorithm>

namespace gazeloop::latency {

frame::FrameStamps joined_stamps(const FinishedFrame& finished) {
    frame::FrameStamps stamps = finished.frame.stamps;
    const bool modelled = stamps.gpu_end.kind == time::StampKind::Modelled;
    if (finished.gpu && finished.gpu->gpu_end.known() && !modelled) {
        stamps.gpu_begin = finished.gpu->gpu_begin;
        stamps.gpu_end = finished.gpu->gpu_end;
    }
    return stamps;
}

FrameAccount account_of(const FinishedFrame& finished, std::int64_t period_ns,
                        const PhotonTimes& photons) {
    const frame::FrameRecord& record = finished.frame;
    FrameAccount account;
    account.stamps = joined_stamps(finished);
    account.shown =
        shown_frame(account.stamps, record.period_ns > 0 ? record.period_ns : period_ns);
    account.state = std::max(record.fovea.eyes[0].state, record.fovea.eyes[1].state);
    if (account.state != gaze::FoveaState::Ahead) {
        account.age = frame_gaze_age(record, account.stamps, account.shown.at, photons.switching_ns,
                                     photons.rolling_ns);
    }
    return account;
}

}  // namespace gazeloop::latency
