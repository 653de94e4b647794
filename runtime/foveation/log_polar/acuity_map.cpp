#include "runtime/foveation/log_polar/acuity_map.h"

#include <cmath>

#include "runtime/foveation/picture/angles.h"
#include "runtime/foveation/picture/hidden_area.h"

namespace gazeloop::foveation {
namespace {

double eccentricity_deg(double rho) { return 2.0 * std::atan(rho) * kDegreesPerRadian; }

}  // namespace

LpShare AcuityMap::share(const gaze::PixelPosition& position) const {
    const GazePolar polar = frame_.polar(position);
    return {profile_.u(eccentricity_deg(polar.rho)), polar.angle_rad / kTurn};
}

std::optional<gaze::PixelPosition> AcuityMap::position(const LpShare& share) const {
    const double eccentricity_rad = profile_.eccentricity_of_u_deg(share.u) / kDegreesPerRadian;
    return frame_.position({std::tan(0.5 * eccentricity_rad), share.v * kTurn});
}

Density AcuityMap::density(const gaze::PixelPosition& position, LpSize lp) const {
    return density_at(eccentricity_deg(frame_.polar(position).rho), lp);
}

std::optional<ColumnRange> AcuityMap::on_screen(double from_rad, double to_rad) const {
    return columns(frame_.on_screen(from_rad, to_rad));
}

std::optional<ColumnRange> AcuityMap::visible(const HiddenArea& hidden, double from_rad,
                                              double to_rad) const {
    return columns(frame_.rho_in_wedge(hidden.outline(), from_rad, to_rad));
}

std::optional<ColumnRange> AcuityMap::columns(const std::optional<GazeFrame::RhoRange>& rho) const {
    if (!rho) {
        return std::nullopt;
    }
    return ColumnRange{profile_.u(eccentricity_deg(rho->min)),
                       profile_.u(eccentricity_deg(rho->max))};
}

Density AcuityMap::density_at(double eccentricity_deg, LpSize lp) const {
    const double stretch = profile_.u(AcuityProfile::kMaxEccentricityDeg) /
                           profile_.columns(AcuityProfile::kMaxEccentricityDeg) * lp.width;
    const double around_deg = 360.0 * std::sin(eccentricity_deg / kDegreesPerRadian);
    return {profile_.columns_per_degree(eccentricity_deg) * stretch, lp.height / around_deg};
}

double AcuityMap::disc_eccentricity_deg(LpSize lp) const {
    const double pixels = pixels_per_degree(frame_.view(), frame_.nearest_in_view()).mean;
    // Both densities fall from the gaze to 90 degrees.
    const auto offers_texel = [&](double eccentricity_deg) {
        const Density offered = density_at(eccentricity_deg, lp);
        return offered.radial * offered.tangential >= pixels * pixels;
    };
    double low = 0.0;
    double high = 90.0;
    if (offers_texel(high)) {
        return high;
    }
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        (offers_texel(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace gazeloop::foveation
