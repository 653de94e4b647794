#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "runtime/time/span.h"
#include "runtime/time/tick_range.h"

namespace gazeloop::time {

/// A device's counter of limited range, without its wraps. So a counter that is set back by less
/// than half its range goes back here too.
///
/// A range that was only stated may be wrong: many state 31 bits of a counter of 32, or what is
/// left of another field. A reading that goes on beyond the stated range, forwards, shows that, and
/// from then on the range of what the reading is held in counts. Any other reading beyond it, like
/// a lone "no data", makes a time that nothing fits, and changes nothing for those after it.
class TickCounter {
  public:
    /// Of `bits` (1 to 64), each tick `tick_ns` (> 0) nanoseconds long; what readings hold above
    /// these bits is ignored.
    TickCounter(std::uint32_t bits, double tick_ns)
        : TickCounter(TickRange::of_bits(bits), TickRange::of_bits(bits), tick_ns) {}
    /// Of a stated range inside that of what holds it.
    TickCounter(const TickRange& stated, const TickRange& held_in, double tick_ns)
        : range_(stated), held_in_(held_in), tick_ns_(tick_ns) {}

    /// The device's time in nanoseconds: that of the ticks themselves. If a reading is too far from
    /// 0 to be exact (Windows' clock counts from 1601), times count from that reading.
    ///
    /// `passed_ns` is how much time has passed since the reading before by another clock. It tells
    /// how often a counter that wraps soon has done so while nothing was read, if it is right to
    /// less than half of what the counter's range lasts. 0: less than half a range has passed.
    [[nodiscard]] std::int64_t to_ns(std::uint64_t ticks, std::int64_t passed_ns = 0) {
        if (!started_) {
            started_ = true;
            total_ = ((ticks - least_held()) & held_in_.span) + least_held();
            last_ = ticks;
        } else {
            passed_ns_ = saturated(static_cast<__int128>(passed_ns_) + passed_ns);
            const bool inside = range_.holds(ticks);
            const std::int64_t advance = tick_difference(
                last_, ticks, inside && range_.holds(last_) ? range_ : held_in_, passed_ticks());
            if (!inside && advance <= 0) {
                return ns_of(static_cast<std::int64_t>(
                    total_ + static_cast<std::uint64_t>(advance) - base_));
            }
            range_ = inside ? range_ : held_in_;
            total_ += static_cast<std::uint64_t>(advance);
            last_ = ticks;
            passed_ns_ = 0;
        }
        if (is_far(static_cast<std::int64_t>(total_ - base_))) {
            base_ = total_;
        }
        return ns_of(static_cast<std::int64_t>(total_ - base_));
    }

  private:
    [[nodiscard]] std::uint64_t least_held() const {
        return static_cast<std::uint64_t>(held_in_.least);
    }

    [[nodiscard]] std::int64_t passed_ticks() const {
        constexpr auto kGreatest = static_cast<double>(std::int64_t{1} << 62);
        const double ticks = static_cast<double>(passed_ns_) / tick_ns_;
        return static_cast<std::int64_t>(std::clamp(ticks, -kGreatest, kGreatest));
    }

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

    TickRange range_;
    TickRange held_in_;
    double tick_ns_;
    std::uint64_t last_ = 0;      ///< the reading that total_ is of
    std::int64_t passed_ns_ = 0;  ///< since then
    std::uint64_t total_ = 0;     ///< two's complement
    std::uint64_t base_ = 0;
    bool started_ = false;
};

}  // namespace gazeloop::time
