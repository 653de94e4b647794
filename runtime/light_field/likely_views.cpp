#include "runtime/light_field/likely_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace gazeloop::light_field {
namespace {

constexpr double kMostFrames = 10.0;
constexpr double kTurnedAsideShare = 0.1;  ///< of the cameras' spacing, a frame

/// In how many frames a lens that reaches `reach_m`, and `wider_m` more with every frame, reaches a
/// camera that is `apart_m` from its middle as it moves by `step_m` a frame; 0: it does now.
double frames_until(const glm::dvec2& apart_m, const glm::dvec2& step_m, double reach_m,
                    double wider_m) {
    // |apart - t step| = reach + t wider, the first t.
    const double c = glm::dot(apart_m, apart_m) - reach_m * reach_m;
    if (c < 0.0) {
        return 0.0;
    }
    const double a = glm::dot(step_m, step_m) - wider_m * wider_m;
    const double b = glm::dot(apart_m, step_m) + reach_m * wider_m;
    const double under_root = b * b - a * c;
    const double divisor = under_root >= 0.0 ? b + std::sqrt(under_root) : 0.0;
    return divisor > 0.0 ? c / divisor : std::numeric_limits<double>::infinity();
}

}  // namespace

LikelyViews::LikelyViews(const LightField& field) : field_(field) {
    soon_.reserve(field.cameras.count());
    views_.reserve(field.cameras.count());
}

std::span<const std::uint32_t> LikelyViews::after(std::span<const MovingLens> lenses) {
    const CameraGrid& cameras = field_.cameras;
    const double reach = reach_m(field_);
    soon_.clear();
    for (std::uint32_t view = 0; view < cameras.count(); ++view) {
        const glm::dvec2 camera_m =
            cameras.camera_m(view % cameras.columns, view / cameras.columns);
        double frames = std::numeric_limits<double>::infinity();
        for (const MovingLens& lens : lenses) {
            const bool jumped = glm::length(lens.step_m) > reach;
            frames = std::min(frames, frames_until(camera_m - lens.middle_m,
                                                   jumped ? glm::dvec2(0.0) : lens.step_m, reach,
                                                   kTurnedAsideShare * cameras.spacing_m));
        }
        if (frames > 0.0 && frames <= kMostFrames) {
            soon_.push_back({frames, view});
        }
    }
    std::ranges::sort(soon_, {}, [](const Soon& one) { return std::tuple(one.frames, one.view); });
    views_.clear();
    for (const Soon& one : soon_) {
        views_.push_back(one.view);
    }
    return views_;
}

}  // namespace gazeloop::light_field
