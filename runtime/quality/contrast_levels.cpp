#include "runtime/quality/contrast_levels.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <numeric>

#include "runtime/quality/fast_exponent.h"
#include "runtime/quality/pyramid.h"

namespace gazeloop::quality {
namespace {

/// Pixels of the picture per pixel of the level; its pixel x lies on the picture's pixel x * step.
double step_of(std::size_t level) { return std::ldexp(1.0, static_cast<int>(level)); }

/// Where a level's pixel lies in the picture.
gaze::PixelPosition place(std::uint32_t x, std::uint32_t y, double step) {
    return {x * step + 0.5, y * step + 0.5};
}

/// A mechanism's decay on the temporal side, and what it is more on the nasal one: per degree (x)
/// and per degree and cpd (y). It is linear in between.
struct Decay {
    glm::vec2 temporal;
    glm::vec2 nasal;
};

Decay decay_of(Mechanism mechanism) {
    const foveation::StelaDecay temporal = sensitivity_decay(mechanism, 0.0);
    const foveation::StelaDecay nasal = sensitivity_decay(mechanism, 1.0);
    return {glm::vec2(glm::dvec2(temporal.per_deg, temporal.per_deg_cpd)),
            glm::vec2(glm::dvec2(nasal.per_deg - temporal.per_deg,
                                 nasal.per_deg_cpd - temporal.per_deg_cpd))};
}

/// As foveation::nasal_share, of a ray's parts across the gaze: towards the nose, up or down, and
/// their length.
float nasal_share(float nasal, float vertical, float across) {
    if (nasal <= 0.0F) {
        return 0.0F;
    }
    constexpr float kRightAngle = 0.5F * std::numbers::pi_v<float>;
    return across > 0.0F ? std::atan2(nasal, std::abs(vertical)) / kRightAngle : 0.0F;
}

constexpr float kOctavesPerDecade = std::numbers::ln10_v<float> / std::numbers::ln2_v<float>;

}  // namespace

ContrastLevels::ContrastLevels(const gaze::EyeView& view, gaze::Eye eye, const RowWork& work)
    : eye_(eye) {
    const foveation::GazeFrame ahead(view, {0.0, 0.0, -1.0});
    const glm::dmat3& ray_of = ahead.gaze_from_picture();
    const glm::dvec2 scale = foveation::px_per_tangent(view);
    constexpr double kDeg = std::numbers::pi / 180.0;
    const double middle_per_deg = std::sqrt(std::abs(scale.x * scale.y)) * kDeg;
    constexpr std::uint32_t kLeastSide_px = 4;
    std::uint32_t width = view.width_px;
    std::uint32_t height = view.height_px;
    bool rest = false;
    while (!rest) {
        const std::size_t at = levels_.size();
        const double step = step_of(at);
        const double band_cpd = kCoarserBand.cycles_per_px * middle_per_deg / step;
        rest = at > 0 && (band_cpd < kRestCpd || std::min(width, height) < kLeastSide_px);
        const BandResponse band = at == 0 ? kFinestBand : kCoarserBand;
        Level level{.width = width,
                    .height = height,
                    .band_gain = rest ? 1.0 : band.gain,
                    .log2_cpd = Plane(width, height),
                    .weight = Plane(width, height),
                    .decay = {}};
        level.decay.fill(Plane(width, height));
        std::vector<double> row_sums(height);
        work.over(height, [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t y = from; y < to; ++y) {
                for (std::uint32_t x = 0; x < width; ++x) {
                    const gaze::PixelPosition pixel = place(x, y, step);
                    const glm::dvec3 ray = ray_of * glm::dvec3(pixel.x_px, pixel.y_px, 1.0);
                    // Pixels per degree, the geometric mean of both directions, rise with
                    // (1 / cosine)^(3/2) of the angle from the view's axis.
                    const double length2 = ray.x * ray.x + ray.y * ray.y + ray.z * ray.z;
                    const double per_deg = middle_per_deg * std::pow(length2, 0.75);
                    const double cpd = band.cycles_per_px * per_deg / step;
                    level.log2_cpd.row(y)[x] =
                        static_cast<float>(std::log2(rest ? std::max(cpd, kRestCpd) : cpd));
                    const double weight = 1.0 / (per_deg * per_deg);
                    level.weight.row(y)[x] = static_cast<float>(weight);
                    row_sums[y] += weight;
                }
            }
        });
        const auto over_sum =
            static_cast<float>(1.0 / std::accumulate(row_sums.begin(), row_sums.end(), 0.0));
        for (float& weight : level.weight.values) {
            weight *= over_sum;
        }
        levels_.push_back(std::move(level));
        width = halved(width);
        height = halved(height);
    }
}

void ContrastLevels::look(const foveation::GazeField& field, const RowWork& work) {
    const glm::dmat3& ray_of = field.frame().gaze_from_picture();
    // The nose lies to the right of the left eye.
    const float towards_nose = eye_ == gaze::Eye::Left ? 1.0F : -1.0F;
    std::array<Decay, kStillMechanisms> decays;
    for (std::size_t m = 0; m < kStillMechanisms; ++m) {
        decays[m] = decay_of(static_cast<Mechanism>(m));
    }
    for (std::size_t at = 0; at < levels_.size(); ++at) {
        Level& level = levels_[at];
        const double step = step_of(at);
        work.over(level.height, [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t y = from; y < to; ++y) {
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    const gaze::PixelPosition pixel = place(x, y, step);
                    const glm::vec3 ray(ray_of * glm::dvec3(pixel.x_px, pixel.y_px, 1.0));
                    const float across = std::sqrt(ray.x * ray.x + ray.y * ray.y);
                    const float nasal = nasal_share(towards_nose * ray.x, ray.y, across);
                    const float e_octaves =
                        kOctavesPerDecade * glm::degrees(std::atan2(across, ray.z));
                    const float cpd = exp2_of(level.log2_cpd.row(y)[x]);
                    for (std::size_t m = 0; m < kStillMechanisms; ++m) {
                        const Decay& decay = decays[m];
                        level.decay[m].row(y)[x] =
                            e_octaves * (decay.temporal.x + nasal * decay.nasal.x +
                                         (decay.temporal.y + nasal * decay.nasal.y) * cpd);
                    }
                }
            }
        });
    }
}

}  // namespace gazeloop::quality
