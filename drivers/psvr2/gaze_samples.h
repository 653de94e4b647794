#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "drivers/device/sample_clock.h"
#include "drivers/device/tracker_device.h"
#include "drivers/psvr2/gaze_packet.h"
#include "drivers/psvr2/head_axes.h"
#include "drivers/psvr2/packet_timestamp.h"

namespace gazeloop::drivers::psvr2 {

/// Makes samples of a headset's transfers, in the order of arrival. Allocates only where it has a
/// change to report.
///
/// An eye is valid where the headset vouches for its direction, the axes agree, and it is not
/// closed.
class GazeSamples {
  public:
    explicit GazeSamples(const TrackerDelay& delay) : clock_({kWide, kMicrosecond_ns}, delay) {}

    /// The sample of a transfer that had arrived by `arrived_ns`, without its number; none where it
    /// is no gaze packet.
    [[nodiscard]] std::optional<gaze::GazeSample> take(std::span<const std::uint8_t> bytes,
                                                       std::int64_t arrived_ns);
    /// Packets that are missing before the last sample, by the headset's own count. What was not
    /// sent while the stream had stopped is no loss.
    [[nodiscard]] std::uint64_t lost_before_last() const { return lost_before_last_; }

    /// A line about what the last transfers changed; none where nothing is left to say.
    [[nodiscard]] std::optional<std::string> take_change();

    /// Packets that are cut short, too long, or hold impossible values are damaged; those of
    /// calibration and raw data are others.
    [[nodiscard]] const TrackerCounts& counts() const { return counts_; }
    /// The diameter of each pupil, as the headset last vouched for it.
    [[nodiscard]] const PupilsMm& pupils_mm() const { return pupils_mm_; }
    /// Null before the first sample.
    [[nodiscard]] const time::ClockFit* clock() const {
        return counts_.samples > 0 ? &clock_.fit() : nullptr;
    }

  private:
    static constexpr std::uint32_t kWide = 64;  ///< bits: packet_timestamp.h has unwrapped it
    static constexpr double kMicrosecond_ns = 1000.0;

    void refuse(PacketFault fault, std::size_t bytes);
    void tell_axes(AxesVerdict before);

    HeadAxes axes_;
    PacketTimestamp timestamp_;
    SampleClock clock_;
    TrackerCounts counts_;
    PupilsMm pupils_mm_;
    std::uint64_t lost_before_last_ = 0;
    std::uint32_t last_frame_ = 0;
    std::int64_t last_arrived_ns_ = 0;
    bool told_damaged_ = false;
    std::deque<std::string> notices_;
};

}  // namespace gazeloop::drivers::psvr2
