#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/time/stamp.h"

namespace gazeloop::drivers {

/// What a runtime said of a gaze pose's time. Nanoseconds; `given` and `asked` on the runtime's
/// time line, the others on the host's.
struct GivenTime {
    std::int64_t given = 0;               ///< XrEyeGazeSampleTimeEXT::time
    std::optional<std::int64_t> host_ns;  ///< `given` in host time; none where it is no time
    std::int64_t asked = 0;               ///< the time that the pose was asked for
    std::int64_t now_ns = 0;              ///< the same in host time
};

/// Why the time of a pose does not say when the eye was seen.
enum class SampleTimeTrouble {
    None,
    NotGiven,     ///< 0: the runtime does not know
    Predicted,    ///< the very time that was asked for: the pose was extrapolated to it
    Ahead,        ///< in the future: the pose was extrapolated
    StandsStill,  ///< the gaze moves on, its time does not
    Absurd        ///< negative, no time at all, or too far from now: of another clock
};
[[nodiscard]] std::string_view text_of(SampleTimeTrouble trouble);

struct SampleTime {
    time::Stamp sampled;  ///< when the eye was seen; Measured, or unknown with any trouble
    /// The time that the pose is for, known also for one that was extrapolated.
    std::optional<std::int64_t> pose_ns;
    SampleTimeTrouble trouble = SampleTimeTrouble::None;
};

/// Farther from now than this, a time is taken for another clock's: no gaze of that age is of use.
inline constexpr std::int64_t kFarthestSample_ns = 10'000'000'000;
/// Error of converting to and from the runtime's time line, which reads clocks twice: a time that
/// lies ahead by less than this is now. Far above what conversions cost (microseconds), far below
/// any tracker's delay.
inline constexpr std::int64_t kClockNoise_ns = 100'000;

[[nodiscard]] SampleTime sample_time(const GivenTime& time);

}  // namespace gazeloop::drivers
