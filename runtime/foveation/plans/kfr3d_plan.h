#pragma once

#include <array>
#include <span>

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/light_field/lens.h"

namespace gazeloop::foveation {

/// The parameters of 3D kernel foveated rendering (Meng et al. 2020, "3D-Kernel Foveated Rendering
/// for Light Fields"): views of a light field are put into regions by how far their camera is from
/// the gaze's place in the cameras' plane (Eq. 12, 13), and each region has an LP-buffer of its own
/// sigma (Eq. 14). The paper states neither radii nor the sigmas of the outer regions: here they
/// follow from two numbers.
struct Kfr3dParameters {
    static constexpr std::uint32_t kMostRegions = 4;
    static constexpr double kMostGrowth = 4.0;

    KfrParameters kfr;          ///< of the foveal region; its sigma is sigma_0
    std::uint32_t regions = 3;  ///< the foveal one included, [1, kMostRegions]
    /// r_0 over the lens's reach (light_field::ViewsInLens), [0, 1]; the other radii divide the
    /// rest up to the reach evenly, and the last region has everything beyond.
    double inner = 0.4;
    double growth = 1.5;  ///< sigma_i / sigma_(i-1), [1, kMostGrowth]; sigma ends at kMaxSigma
};

/// The region of a view whose camera is `distance_m` from the gaze's place.
[[nodiscard]] std::uint32_t region_of(const Kfr3dParameters& parameters, double distance_m,
                                      double reach_m);

/// The LP-buffers' sizes, the foveal region's first. Errors: as lp_buffer_size, of that one; the
/// others have at least 2 x 4 texels.
Expected<std::array<LpSize, Kfr3dParameters::kMostRegions>> region_sizes(
    const Kfr3dParameters& parameters, ImageSize image);

/// 3D-KFR for pictures whose sizes may differ. Grids: one for each region's LP-buffer, "lp_0" the
/// foveal one's, and "picture", the disc. Regions without views shade nothing. One view alone
/// is in the foveal region: then this is KFR.
///
/// EyePlan::table holds, as 32-bit words: where the views of region 0, 1, 2, 3 begin and where the
/// last one's end; at kViewsBegin, four floats for each view: its camera's place in the cameras'
/// plane (x, y, m), its number, its weight.
class Kfr3dPlan final : public MethodPlan {
  public:
    static constexpr std::size_t kViewsBegin = 8;
    static constexpr std::size_t kViewWords = 4;
    static constexpr std::size_t kViewNumber = 2;  ///< which of these words

    /// `field`: the scene's; one camera with a lens of no opening where it is no light field.
    Kfr3dPlan(const Kfr3dParameters& parameters, const light_field::LightField& field);

    [[nodiscard]] const frame::GridList& grids() const override { return grids_; }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return foveal_.fits(views);
    }
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    [[nodiscard]] const Kfr3dParameters& parameters() const { return parameters_; }
    /// Precondition: prepare().
    [[nodiscard]] LpSize lp(gaze::Eye eye, std::uint32_t region) const {
        return lp_[gaze::index(eye)].at(region);
    }
    /// The disc's place in grids().
    [[nodiscard]] std::size_t disc_grid() const { return parameters_.regions; }
    /// The greatest size of a table, in words.
    [[nodiscard]] std::size_t table_words() const;

    /// Of a plan's table: how many views a region has.
    [[nodiscard]] static std::uint32_t views_in(std::span<const std::uint32_t> table,
                                                std::size_t region) {
        return table[region + 1] - table[region];
    }

  private:
    void list_views(const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                    std::vector<std::uint32_t>& table) const;

    Kfr3dParameters parameters_;
    light_field::LightField field_;
    frame::GridList grids_;
    KfrPlan foveal_;
    gaze::PerEye<std::array<LpSize, Kfr3dParameters::kMostRegions>> lp_{};
};

}  // namespace gazeloop::foveation
