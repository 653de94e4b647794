#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "runtime/frame/frame_record.h"
#include "runtime/time/span.h"

namespace gazeloop::latency {

/// Frames that follow on each other and have something in common.
struct FrameStretch {
    std::uint64_t frames = 0;
    std::uint64_t first = 0;  ///< index of the first one; meaningless without frames
    /// From the first one's wake_up to the first wake_up after the last one, or to that of the last
    /// one where the run ends with it.
    time::Span lasted{};
};

/// What frames made of the samples that there were.
struct GazeUseCounts {
    std::uint64_t rendered = 0;
    std::uint64_t with_gaze = 0;  ///< both foveae rest on a fresh sample
    /// Frames with gaze of which the frame before had the same sample.
    std::uint64_t reused = 0;
    /// Frames with gaze that could have been such: the frame before has gaze too.
    std::uint64_t comparable = 0;
    FrameStretch longest_reuse{};  ///< of one sample, its first use among them; none: 0 frames
    /// Frames without gaze after there had been some, or before the first.
    std::uint64_t lost = 0;
    std::uint64_t before_first = 0;  ///< of them, before the first gaze
    std::array<std::uint64_t, gaze::kLossReasonNames.size()> lost_by_reason{};
    std::array<std::uint64_t, gaze::kLossCauseNames.size()> lost_by_cause{};
    FrameStretch longest_loss{};  ///< after there had been gaze

    /// Frames that use a sample again, of those that can; absent if there are none.
    [[nodiscard]] std::optional<double> reused_percent() const;
    [[nodiscard]] std::optional<double> lost_percent() const;
};

/// Counts, while frames pass, which of them show the sample of the frame before and which have
/// none. In fixed memory, without allocation.
class GazeUse {
  public:
    /// In the order of their index. A gap between indices ends what was going on.
    void add(const frame::FrameRecord& frame);
    [[nodiscard]] const GazeUseCounts& counts() const { return counts_; }

  private:
    struct Running {
        std::uint64_t frames = 0;
        std::uint64_t first = 0;
        time::Stamp since;

        void add(const frame::FrameRecord& frame);
        void keep_longest(FrameStretch& longest, const time::Stamp& until) const;
    };

    GazeUseCounts counts_;
    std::optional<std::uint64_t> before_;           ///< index of the last rendered frame
    std::optional<std::uint64_t> sequence_before_;  ///< of its sample, if it has gaze
    bool had_gaze_ = false;
    Running reuse_;
    Running loss_;
};

/// The share of frames that must show a sample again because the tracker has fewer of them than the
/// display has frames, percent; 0 where it has as many. Absent where a rate is not known (0).
[[nodiscard]] std::optional<double> expected_reuse_percent(double tracker_hz, double frames_hz);

}  // namespace gazeloop::latency
