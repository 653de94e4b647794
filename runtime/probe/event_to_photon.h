#pragma once

#include <cstdint>
#include <optional>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/frame_account.h"
#include "runtime/time/stamp.h"

namespace gazeloop::probe {

/// How long after something happens to the eye, at any moment, the first picture shows that follows
/// a sample of it. This is what a lamp and a camera see. It is longer than the age of that sample:
/// by half the time since the sample that the picture before rested on, on average.
struct EventToPhoton {
    std::uint64_t frames = 0;  ///< that were the first to follow a new sample
    std::optional<double> mean_ms{};
    std::optional<double> sd_ms{};                    ///< of single events
    time::StampKind kind = time::StampKind::Unknown;  ///< the least certain of the frames'
};

/// Gathers it from a session's frames, as a FrameObserver, in fixed memory. Of each pair of
/// successive samples that pictures rest on, every moment between them counts alike. Losses and
/// pauses (over 250 ms without a sample) are left out. Counts to the middle row's emission, where
/// the patch is.
class EventToPhotonModel final : public frame::FrameObserver {
  public:
    /// `period_ns`: of the display's profile, for frames that were announced none; 0: unknown.
    EventToPhotonModel(std::optional<std::int64_t> switching_ns, std::int64_t period_ns)
        : photons_{.switching_ns = switching_ns}, period_ns_(period_ns) {}

    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

    /// What has been seen so far, with frames that lack their GPU part.
    [[nodiscard]] EventToPhoton result();

  private:
    void complete(const latency::FinishedFrame& finished);

    latency::PhotonTimes photons_;
    std::int64_t period_ns_;
    latency::PendingFrames pending_;
    time::Stamp sample_before_;
    std::uint64_t frames_ = 0;
    time::StampKind kind_ = time::StampKind::Measured;
    double weight_ms_ = 0.0;
    double weighted_ms2_ = 0.0;  ///< sum of interval x mean delay in it
    double weighted_ms3_ = 0.0;  ///< sum of interval x mean squared delay
};

}  // namespace gazeloop::probe
