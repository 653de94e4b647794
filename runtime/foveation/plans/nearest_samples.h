#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/plans/sparse_pattern.h"

namespace gazeloop::foveation {

/// For every pixel of a pattern's field, its k nearest samples. For a gaze anywhere in the picture,
/// pixel (x, y) of the picture reads the entry at window(gaze) + (x, y). The samples in that entry,
/// moved back by window(gaze), are the pixels to fill it from. Samples outside the picture are not
/// rendered: a reader skips them.
struct NearestSamples {
    static constexpr std::uint32_t kMaxNeighbours = 8;

    ImageSize field;
    std::uint32_t neighbours = 1;  ///< k
    std::vector<std::uint32_t>
        map;  ///< k indices into the pattern's samples per pixel, nearest first

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t x, std::uint32_t y) const {
        return std::span(map).subspan((std::size_t{y} * field.width_px + x) * neighbours,
                                      neighbours);
    }
};

/// Exact, by distance between pixel centres; of equally near samples, it may take any. Uses 4 k
/// bytes per pixel of the field, which is 16 k per pixel of the picture. Errors (Usage): k of 0,
/// over kMaxNeighbours, or over the number of samples.
Expected<NearestSamples> find_nearest_samples(const SparsePattern& pattern,
                                              std::uint32_t neighbours);

}  // namespace gazeloop::foveation
