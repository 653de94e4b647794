#pragma once

#include <cstdint>
#include <optional>

namespace gazeloop::drivers {

/// What a row of a trace file says of when it was taken, before its clocks are judged.
struct RowClock {
    std::uint64_t line = 0;                 ///< of the file, from 1
    std::optional<std::uint64_t> sequence;  ///< where the format has one
    /// The device's clock as the file has it, in ticks of the format (TraceOrigin); none where the
    /// cell cannot be read.
    std::optional<std::int64_t> device_ticks;
    /// Another clock of the device's, for want of the first in all rows.
    std::optional<std::int64_t> other_ticks;
    std::optional<std::int64_t> host_ns;  ///< the host's clock at the arrival, where recorded
};

}  // namespace gazeloop::drivers
