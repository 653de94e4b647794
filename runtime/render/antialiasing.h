#pragma once

#include <cstdint>

namespace gazeloop::render {

/// Whether a filter runs.
enum class FilterUse : std::uint8_t { Off, On, AsSceneNeeds };

/// What is done against aliasing besides samples. All off: pictures as the methods make them.
struct Antialiasing {
    /// Largest size of the post filter (post_filter.h), px; below 3: none.
    std::uint32_t post_filter_px = 0;
    /// Places within a pixel at which a log-polar resolve reads, [1, kMostFootprintTaps].
    std::uint32_t footprint_taps = 1;
    /// Samples move from frame to frame, and what the last frames showed is mixed in.
    bool over_frames = false;
    /// That is forgotten where a saccade lands.
    bool forget_at_landings = true;

    static constexpr std::uint32_t kMostFootprintTaps = 16;
    static constexpr std::uint32_t kMostPostFilter_px = 39;
};

}  // namespace gazeloop::render
