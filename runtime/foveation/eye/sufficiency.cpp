#include "runtime/foveation/eye/sufficiency.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gazeloop::foveation {
namespace {

constexpr int kDirections = 144;
constexpr double kGrowth = 1.0025;
constexpr double kStepDeg = 0.02;

double direction_rad(int i) { return i * (2.0 * std::numbers::pi / kDirections); }

}  // namespace

Sufficiency check_sufficiency(const GazeField& field, const OfferedDensity& offered,
                              const AcuityModel& model, gaze::Eye eye) {
    const FullDensity display;
    Sufficiency result{.least_ratio = std::numeric_limits<double>::infinity(), .worst = {}};
    const double farthest_deg = field.greatest_eccentricity_deg();
    const FieldPoint centre =
        field.at(gaze::PixelPosition{field.view().width_px / 2.0, field.view().height_px / 2.0});
    double eccentricity = 0.2 / display.at(centre).worst_density();
    for (bool last = false; !last;) {
        last = eccentricity >= farthest_deg;
        eccentricity = std::min(eccentricity, farthest_deg);
        for (int i = 0; i < kDirections; ++i) {
            const auto at = field.at(eccentricity, direction_rad(i));
            if (!at) {
                continue;
            }
            const double required = std::min(
                required_per_deg(model, at->eccentricity_deg, nasal_share(eye, at->direction_rad)),
                display.at(*at).worst_density());
            const double ratio = offered.at(*at).worst_density() / required;
            if (ratio < result.least_ratio) {
                result = {.least_ratio = ratio, .worst = *at};
            }
        }
        eccentricity = std::max(eccentricity * kGrowth, eccentricity + kStepDeg);
    }
    return result;
}

std::vector<DensityAt> density_profile(const GazeField& field, const OfferedDensity& offered,
                                       double from_deg, int points) {
    const double farthest_deg = field.greatest_eccentricity_deg();
    std::vector<DensityAt> profile;
    for (int point = 0; point < points; ++point) {
        const double eccentricity =
            from_deg * std::pow(farthest_deg / from_deg, point / (points - 1.0));
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < kDirections; ++i) {
            if (const auto at = field.at(eccentricity, direction_rad(i))) {
                least = std::min(least, offered.at(*at).worst_density());
            }
        }
        if (std::isfinite(least)) {
            profile.push_back({eccentricity, least});
        }
    }
    return profile;
}

}  // namespace gazeloop::foveation
