#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// Which pixels of one eye's picture nobody can see, so that nothing need be shaded for them.
///
/// A compositor reads a picture bilinearly: what an eye sees at a position depends on the pixels
/// less than 1 px away on each axis. So a pixel is hidden if the mesh covers everything that close
/// to its centre, as far as it lies on the picture. Every error is on the side of drawing:
///  - A pixel near an edge that two triangles do not share counts as visible, even where further
///    triangles overlap that edge.
///  - What lies between two visible pixels of a row or of a column is visible, because masks
///    surround the picture. (Monado 25's mask is displaced where up and down differ.)
///  - Rows are hidden only in whole groups of kGroupRows, and columns in blocks of kBlockColumns.
///    Few rectangles are quick to draw, and a block shared by two of them would be shaded twice.
///  - Triangles that are not finite, or lie farther from the picture than 2^20 px, are left out.
/// The outermost 1/64 px of the picture are not tested, because meshes end there with rounding.
class HiddenArea {
  public:
    static constexpr std::uint32_t kGroupRows = 8;
    static constexpr std::uint32_t kBlockColumns = 4;
    static_assert(kGroupRows % kBandRows == 0);

    /// Precondition: gaze::is_valid(view). Takes time in proportion to triangles times rows.
    HiddenArea(const gaze::HiddenMesh& mesh, const gaze::EyeView& view);

    /// The visible pixels as few rectangles, one below the other.
    [[nodiscard]] std::span<const Tile> visible_tiles() const { return tiles_; }
    [[nodiscard]] std::uint64_t hidden_pixels() const { return hidden_pixels_; }

    /// The columns of the visible pixels in a band of rows. Precondition: the band lies between a
    /// multiple of kBandRows and the next, and in the picture.
    [[nodiscard]] Columns visible_columns(std::uint32_t first_row) const {
        return groups_[first_row / kGroupRows];
    }

    /// The convex hull of the visible pixels' centres: its corners, px, in the order in which
    /// angles from x to y grow. It is the polygon that screen_wedge.h and GazeFrame::rho_in_wedge
    /// take.
    [[nodiscard]] std::span<const glm::dvec2> outline() const { return outline_; }

  private:
    void add_tile(const Tile& tile);
    void fill_columns();

    std::vector<Columns> groups_;
    std::vector<Tile> tiles_;
    std::vector<glm::dvec2> outline_;
    std::uint64_t hidden_pixels_ = 0;
};

/// What an eye's picture may leave out; null: nothing.
using HiddenAreas = gaze::PerEye<std::shared_ptr<const HiddenArea>>;

/// The areas of both eyes' views. Null where there is no mesh, where it hides no pixel, and where
/// it hides all of them (which no runtime can mean).
HiddenAreas hidden_areas(const gaze::HiddenMeshes& meshes, const gaze::StereoView& views);

}  // namespace gazeloop::foveation
