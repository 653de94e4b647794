#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/time/stamp.h"

namespace gazeloop::frame {

/// What became of a tracker's samples on the way to the host.
struct GazeCounts {
    std::uint64_t received = 0;
    std::uint64_t invalid = 0;  ///< the tracker vouches for neither eye
    std::uint64_t lost = 0;     ///< by gaps in the sequence numbers
    /// Repeated, overtaken by a higher sequence number, or sampled before its predecessor.
    std::uint64_t out_of_order = 0;

    friend bool operator==(const GazeCounts&, const GazeCounts&) = default;
};

/// Why it is not known how far a frame's fovea was off; the first that holds.
enum class GazeErrorGap : std::uint8_t {
    None,
    NoDisplayTime,  ///< nor, in a damaged file, a pose of the head
    NoSampleNear,   ///< none within 25 ms before, or none after
    EyeLost,        ///< a blink, or no eye that the tracker vouches for
    NoHead,         ///< only `radians` is unknown: samples have no head pose
};
inline constexpr std::size_t kGazeErrorGapCount = 5;
inline constexpr std::array<std::string_view, kGazeErrorGapCount> kGazeErrorGapNames{
    "none", "no_display_time", "no_sample_near", "eye_lost", "no_head"};

/// How far from where the eye looked a frame's fovea was when the frame was shown
/// (latency::GazeErrors finds it out).
struct GazeError {
    /// Of the worse eye, from 0 to pi; of the kind of the less certain of its times.
    std::optional<double> radians{};
    /// Had the gaze been held in the head, not in world.
    std::optional<double> without_poses_radians{};
    time::StampKind kind = time::StampKind::Unknown;
    GazeErrorGap gap = GazeErrorGap::None;

    friend bool operator==(const GazeError&, const GazeError&) = default;
};

/// What a session says of a frame's gaze without its samples.
struct FrameGaze {
    std::uint64_t index = 0;
    GazeCounts counts;               ///< of all samples up to this frame
    std::optional<GazeError> error;  ///< none: the foveae rest on no fresh sample
};

}  // namespace gazeloop::frame
