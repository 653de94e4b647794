#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/frame/name_list.h"

namespace gazeloop::frame {

/// Most grids that a method can have: the session has columns for as many.
inline constexpr std::size_t kMostGrids = 8;

/// The grids of samples of a run's method, by name. A grid is cells that are shaded, each by its
/// own samples: the picture's pixels, an LP-buffer's texels, a layer's pixels. At most kMostGrids.
using GridList = NameList;

/// Cells of one grid in one frame, both eyes. planned = shaded + off_screen + covered + hidden.
struct GridCounts {
    std::uint64_t planned = 0;     ///< cells that the grid has at this gaze
    std::uint64_t shaded = 0;      ///< of them, shaded
    std::uint64_t off_screen = 0;  ///< left out: no pixel on screen reads them
    std::uint64_t covered = 0;     ///< left out: another grid covers them
    std::uint64_t hidden = 0;      ///< left out: only pixels that no eye sees read them

    GridCounts& operator+=(const GridCounts& more) {
        planned += more.planned;
        shaded += more.shaded;
        off_screen += more.off_screen;
        covered += more.covered;
        hidden += more.hidden;
        return *this;
    }
    friend bool operator==(const GridCounts&, const GridCounts&) = default;
};

/// What a frame's method shaded and left out, both eyes.
struct SampleCounts {
    std::array<GridCounts, kMostGrids> grids{};  ///< by their places in the run's GridList
    std::uint32_t grid_count = 0;                ///< how many of them there are
    std::uint64_t pixels_output = 0;             ///< pixels of the pictures
    std::uint64_t pixels_hidden = 0;  ///< of them not drawn: the headset shows them to no eye

    [[nodiscard]] std::span<const GridCounts> used() const {
        return std::span(grids).first(grid_count);
    }
    /// Cells shaded on all grids.
    [[nodiscard]] std::uint64_t shaded() const {
        std::uint64_t sum = 0;
        for (const GridCounts& grid : used()) {
            sum += grid.shaded;
        }
        return sum;
    }
    SampleCounts& operator+=(const SampleCounts& more) {
        grid_count = grid_count < more.grid_count ? more.grid_count : grid_count;
        for (std::size_t grid = 0; grid < kMostGrids; ++grid) {
            grids[grid] += more.grids[grid];
        }
        pixels_output += more.pixels_output;
        pixels_hidden += more.pixels_hidden;
        return *this;
    }
    friend bool operator==(const SampleCounts&, const SampleCounts&) = default;
};

}  // namespace gazeloop::frame
