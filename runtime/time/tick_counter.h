#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "runtime/time/span.h"

namespace gazeloop::time {

/// The ticks from one reading of a counter of `bits` (1 to 64) to another; the bits above are
/// ignored. A difference of more than half the range is taken for the shorter way round.
[[nodiscard]] constexpr std::int64_t tick_difference(std::uint64_t from, std::uint64_t to,
                                                     std::uint32_t bits) {
    // Both shifted to the left end of 64 bits: their difference wraps as they do.
    const std::uint32_t shift = 64 - bits;
    return static_cast<std::int64_t>((to << shift) - (from << shift)) >> shift;
}

/// A device's counter of limited width, without its wraps, by tick_difference(). So a counter that
/// is set back by less than half its range goes back here too.
class TickCounter {
  public:
    /// `bits` (1 to 64) of the counter, each tick `tick_ns` (> 0) nanoseconds long.
    TickCounter(std::uint32_t bits, double tick_ns) : bits_(bits), tick_ns_(tick_ns) {}

    /// The device's time in nanoseconds: that of the ticks themselves. If a reading is too far from
    /// 0 to be exact (Windows' clock counts from 1601), times count from that reading.
    [[nodiscard]] std::int64_t to_ns(std::uint64_t ticks) {
        if (!started_) {
            started_ = true;
            total_ = (ticks << (64 - bits_)) >> (64 - bits_);
        } else {
            total_ += static_cast<std::uint64_t>(tick_difference(total_, ticks, bits_));
        }
        if (is_far(static_cast<std::int64_t>(total_ - base_))) {
            base_ = total_;
        }
        return ns_of(static_cast<std::int64_t>(total_ - base_));
    }

  private:
    [[nodiscard]] bool is_far(std::int64_t ticks) const {
        constexpr auto kFar_ns = std::int64_t{1} << 62;    // saturates at twice that
        constexpr auto kFarTicks = std::int64_t{1} << 52;  // double is exact to twice that
        const std::int64_t far = is_whole() ? kFar_ns : kFarTicks;
        const std::int64_t reached = is_whole() ? ns_of(ticks) : ticks;
        return reached > far || reached < -far;
    }

    /// Whether a tick is a whole number of nanoseconds, so that times are exact.
    [[nodiscard]] bool is_whole() const {
        constexpr double kWholeBelow = 1e12;
        return tick_ns_ < kWholeBelow && tick_ns_ == std::floor(tick_ns_);
    }

    [[nodiscard]] std::int64_t ns_of(std::int64_t ticks) const {
        if (is_whole()) {
            return saturated(static_cast<__int128>(ticks) * static_cast<std::int64_t>(tick_ns_));
        }
        constexpr auto kGreatest = static_cast<double>(std::numeric_limits<std::int64_t>::max());
        const double ns = static_cast<double>(ticks) * tick_ns_;
        if (std::abs(ns) < kGreatest) {
            return std::llround(ns);
        }
        return ns < 0.0 ? std::numeric_limits<std::int64_t>::min()
                        : std::numeric_limits<std::int64_t>::max();
    }

    std::uint32_t bits_;
    double tick_ns_;
    std::uint64_t total_ = 0;  ///< two's complement
    std::uint64_t base_ = 0;
    bool started_ = false;
};

}  // namespace gazeloop::time
