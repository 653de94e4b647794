#pragma once

#include <cstdint>

namespace gazeloop::scene {

/// How often frames had to wait until views of a light field were read.
struct ViewWaits {
    std::uint64_t frames = 0;  ///< that waited for views that nobody had fetched
    std::uint64_t views = 0;   ///< that they waited for
    std::uint64_t most_in_a_frame = 0;
    /// Views that were fetched ahead and were not there yet, and frames that waited for such: this
    /// depends on how fast the machine is, all else on what was asked for alone.
    std::uint64_t late_views = 0;
    std::uint64_t late_frames = 0;
};

}  // namespace gazeloop::scene
