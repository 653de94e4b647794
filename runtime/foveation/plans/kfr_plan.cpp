#include "runtime/foveation/plans/kfr_plan.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::foveation {
namespace {

/// Float rounding moves the shader's distance from the fovea by less than this.
constexpr double kDiscSlackPx = 0.02;

}  // namespace

double core_u(const LogPolarMap& map, const LogPolarPlan& plan) {
    return plan.disc_radius_px > 0.0 ? map.u(plan.disc_radius_px - plan.disc_border_px) : kNoCore;
}

void plan_kfr(const KfrParameters& parameters, LpSize lp, ImageSize image,
              const gaze::PixelPosition& fovea, LogPolarPlan& plan, const HiddenArea* hidden) {
    const LogPolarMap map(parameters.kernel, image, fovea);
    plan.lp = lp;
    plan.fovea = fovea;
    plan.log2_max_radius = map.log2_max_radius();
    plan.disc.start(image.height_px);
    plan.in_gaze_frame.reset();
    plan.disc_radius_px = 0.0;
    plan.disc_border_px = 0.0;
    if (parameters.disc) {
        plan.disc_radius_px = map.disc_radius_px(lp);
        plan.disc_border_px = std::min(parameters.border_px, 0.5 * plan.disc_radius_px);
    } else if (parameters.close_hole) {
        // Around the hole, so that no part of the hole shows through the blend.
        const double hole_px = map.hole_radius_px(lp);
        plan.disc_border_px = std::min(parameters.border_px, hole_px);
        plan.disc_radius_px = hole_px + plan.disc_border_px;
    }
    if (plan.disc_radius_px >= map.max_radius_px()) {
        plan.disc_border_px = 0.0;  // the disc covers the screen: there is nothing to blend with
    }
    plan_lp_tiles(map, core_u(map, plan), hidden, plan);
    if (plan.disc_radius_px > 0.0) {
        const double radius = plan.disc_radius_px + kDiscSlackPx;
        const double width = image.width_px;
        const auto band_of = [&](std::uint32_t y0, std::uint32_t y1) -> Columns {
            const double nearest_y = std::clamp(fovea.y_px, y0 + 0.5, y1 - 0.5);
            const double dy = nearest_y - fovea.y_px;
            if (std::abs(dy) >= radius) {
                return {};
            }
            const double reach = std::sqrt(radius * radius - dy * dy);
            // Pixels whose centres lie within reach.
            return {static_cast<std::uint32_t>(
                        std::clamp(std::ceil(fovea.x_px - reach - 0.5), 0.0, width)),
                    static_cast<std::uint32_t>(
                        std::clamp(std::floor(fovea.x_px + reach + 0.5), 0.0, width))};
        };
        plan_disc_tiles(image.height_px, hidden, band_of, plan.disc);
    }
}

bool KfrPlan::fits(const gaze::StereoView& views) const {
    for (const gaze::Eye eye : gaze::kEyes) {
        const ImageSize& image = images_[gaze::index(eye)];
        const gaze::EyeView& view = views[gaze::index(eye)];
        if (image.width_px != view.width_px || image.height_px != view.height_px) {
            return false;
        }
    }
    return true;
}

Expected<void> KfrPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        images_[e] = {views[e].width_px, views[e].height_px};
        const auto lp = lp_buffer_size(parameters_, images_[e]);
        if (!lp) {
            return std::unexpected(lp.error());
        }
        lp_[e] = *lp;
    }
    return {};
}

void KfrPlan::plan(gaze::Eye eye, const gaze::EyeView& /*view*/, const gaze::FoveaPoint& fovea,
                   const HiddenArea* hidden, const FrameInRun& /*frame*/, EyePlan& plan) const {
    const std::size_t e = gaze::index(eye);
    plan_log_polar(plan, [&](LogPolarPlan& made) {
        plan_kfr(parameters_, lp_[e], images_[e], fovea.position, made, hidden);
    });
}

}  // namespace gazeloop::foveation
