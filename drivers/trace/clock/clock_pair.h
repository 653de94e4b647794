#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/trace/clock/counter_wrap.h"
#include "drivers/trace/clock/device_times.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {

/// What both clocks say of the same rows. Both spans are as long as the rows. Precondition of all
/// that compares: the rows have a host time.
struct ClockPair {
    const DeviceTimes& device;
    std::span<const std::optional<std::int64_t>> host_ns;

    /// Host time less device time.
    [[nodiscard]] Wide lag(std::size_t row) const {
        return static_cast<Wide>(*host_ns[row]) - device.time_ns[row];
    }
    /// By how much more the host's clock went on than the device's.
    [[nodiscard]] Wide excess(std::size_t before, std::size_t after) const {
        return lag(after) - lag(before);
    }
    /// On the host's clock.
    [[nodiscard]] Wide elapsed(std::size_t before, std::size_t after) const {
        return static_cast<Wide>(*host_ns[after]) - *host_ns[before];
    }
    /// So much later or earlier than its neighbours a report may come without a reason to doubt its
    /// host time.
    [[nodiscard]] std::int64_t jitter_ns() const {
        constexpr std::int64_t kIntervals = 8;
        constexpr std::int64_t kLeast_ns = 50'000'000;
        return std::max(time::saturated(static_cast<Wide>(kIntervals) * device.interval_ns),
                        kLeast_ns);
    }
    /// Whether the device's clock was set after one row and not after another.
    [[nodiscard]] bool is_set_in(std::size_t before, std::size_t after) const {
        const auto set = std::upper_bound(device.sets.begin(), device.sets.end(), before);
        return set != device.sets.end() && *set <= after;
    }
};

}  // namespace gazeloop::drivers
