#pragma once

#include <cstdint>
#include <optional>

#include "drivers/psvr2/gaze_packet.h"

namespace gazeloop::drivers::psvr2 {

/// The device's time of each packet, microseconds, without wraps.
///
/// One public source reads the field as 64 bits, another as 32 that wrap every 71.6 minutes. To be
/// right for both, the first value counts as 64 bits; after it only differences of the lower half
/// count, the shorter way round. So a 64-bit counter comes out as it is, and a 32-bit one
/// unwrapped, whatever stands in its upper half. (Packets more than 35.8 minutes apart may be wrong
/// by 71.6 minutes, but the clock starts anew after 2 minutes of silence.)
///
/// If the first packet's own timestamp is 0, the foveated block's timestamp is used throughout.
class PacketTimestamp {
  public:
    [[nodiscard]] std::uint64_t unwrapped_us(const GazePacket& packet) {
        if (!last_us_) {
            foveated_ = packet.timestamp_us == 0;
        }
        const auto raw = static_cast<std::uint64_t>(foveated_ ? packet.foveated_timestamp_us
                                                              : packet.timestamp_us);
        if (!last_us_) {
            // An upper half that would mean centuries is not part of the time.
            last_us_ = raw < kCentury_us ? raw : raw & kLowerHalf;
        } else {
            const auto step = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw) -
                                                        static_cast<std::uint32_t>(*last_us_));
            *last_us_ += static_cast<std::uint64_t>(std::int64_t{step});
        }
        return *last_us_;
    }

  private:
    static constexpr std::uint64_t kCentury_us = 3'155'760'000'000'000;
    static constexpr std::uint64_t kLowerHalf = 0xFFFF'FFFF;

    bool foveated_ = false;
    std::optional<std::uint64_t> last_us_;
};

}  // namespace gazeloop::drivers::psvr2
