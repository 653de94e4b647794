#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/hidden_area.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/frame/sample_counts.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// What one eye's picture takes of one grid, and what it leaves out.
struct ShadedGrid {
    std::vector<Columns> bands;  ///< cells that are shaded, by kBandRows rows; none: no cell is
    std::vector<Tile> tiles;     ///< what is drawn for them
    frame::GridCounts counts;    ///< of this eye

    /// Empties it. Keeps room for every band and tile that a grid of this height can have, so that
    /// no later gaze makes it grow.
    void start(std::uint32_t height);
};

/// What the frame before showed one eye.
struct EyeBefore {
    gaze::EyeView view{};
    gaze::PixelPosition fovea{};  ///< that it was planned for
};

/// Which frame of a run is planned, for methods that do not shade everything in every frame.
struct FrameInRun {
    std::uint64_t index = 0;
    /// Whether the frame before was rendered too, by views of these fields and sizes: what it left
    /// can be used.
    bool follows = false;
    /// None where the frame follows no other one, and at a cut (render::is_cut()).
    gaze::PerEye<std::optional<EyeBefore>> before{};
};

/// One eye's picture at one gaze.
struct EyePlan {
    std::vector<ShadedGrid> grids;  ///< in the order of MethodPlan::grids()
    /// The part of the method that depends on the gaze, as its shaders take it (descriptor set 2,
    /// binding 0).
    std::array<glm::vec4, 16> uniforms{};
    /// More of the same, where it is a table (binding 1); for methods by GridPasses.
    std::vector<std::uint32_t> table{};
    double ring_px = 0.0;  ///< radius of the ring to draw around the fovea; 0: none
};

/// Which samples a method takes: pure, the same for the same arguments. A method is some grids of
/// samples and a resolve.
class MethodPlan {
  public:
    MethodPlan() = default;
    MethodPlan(const MethodPlan&) = delete;
    MethodPlan& operator=(const MethodPlan&) = delete;
    virtual ~MethodPlan() = default;

    /// Their names; fixed for the run.
    [[nodiscard]] virtual const frame::GridList& grids() const = 0;

    /// Whether it was made for views with these fields of view and sizes.
    [[nodiscard]] virtual bool fits(const gaze::StereoView& views) const = 0;

    /// Makes what depends on fields of view and sizes, if these have changed. May take
    /// milliseconds, so call it before the gaze is read. Errors (Usage): parameters that do not fit
    /// the pictures.
    virtual Expected<void> prepare(const gaze::StereoView& views) = 0;

    /// The fovea that it plans for where this is the gaze's.
    [[nodiscard]] virtual gaze::FoveaPoint followed(const gaze::EyeView& /*view*/,
                                                    const gaze::FoveaPoint& fovea) const {
        return fovea;
    }

    /// Plans one eye's picture at one gaze, in microseconds. Reuses the plan's memory: only the
    /// first call after a prepare() allocates, wherever the gaze is. `hidden` must be of this
    /// picture; null: nothing is hidden. Precondition: prepare() for views that this one belongs
    /// to.
    virtual void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                      const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const = 0;
};

}  // namespace gazeloop::foveation
