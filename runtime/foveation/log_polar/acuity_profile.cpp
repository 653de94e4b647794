#include "runtime/foveation/log_polar/acuity_profile.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runtime/foveation/picture/angles.h"
#include "runtime/foveation/picture/gaze_frame.h"

namespace gazeloop::foveation {
namespace {

Expected<void> check(const char* name, double value, double least, double greatest) {
    if (value >= least && value <= greatest) {
        return {};
    }
    return std::unexpected(Error{ErrorKind::Usage, fmt::format("{} = {}: must lie in [{}, {}]",
                                                               name, value, least, greatest)});
}

Expected<void> check_view(const gaze::EyeView& view) {
    if (view.width_px < 2 || view.height_px < 2 || view.width_px > LpSize::kMaxSide ||
        view.height_px > LpSize::kMaxSide) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("a picture of {}x{} px cannot be foveated: each "
                                                "side must have 2 to {} px",
                                                view.width_px, view.height_px, LpSize::kMaxSide)});
    }
    if (!gaze::is_valid(view)) {
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("a field of view from {} to {} and {} to {} rad cannot be foveated: it "
                        "must rise from left to right and from down to up, in (-pi/2, pi/2)",
                        view.fov.left_rad, view.fov.right_rad, view.fov.down_rad,
                        view.fov.up_rad)});
    }
    return {};
}

/// Rows needed around the gaze: 360 degrees of a circle at e are sin e times as long as on the
/// equator. Its maximum is flat; steps of a twentieth of a degree are exact to under a row.
double most_rows(const MarLine& mar, double pixels_per_degree) {
    double most = 0.0;
    for (double e = 0.05; e < 180.0; e += 0.05) {
        most = std::max(most, 360.0 * std::sin(e * kRadiansPerDegree) *
                                  std::min(pixels_per_degree, 2.0 / mar.omega_deg(e)));
    }
    return most;
}

}  // namespace

Expected<AcuityProfile> AcuityProfile::create(const AcuityParameters& parameters,
                                              const gaze::EyeView& view) {
    using P = AcuityParameters;
    const bool derived = parameters.pixels_per_degree == 0.0;
    if (auto good = check_view(view); !good) {
        return std::unexpected(good.error());
    }
    const double pixels_per_degree =
        derived ? std::clamp(most_pixels_per_degree(view), P::kMinPixelsPerDegree,
                             P::kMaxPixelsPerDegree)
                : parameters.pixels_per_degree;
    for (const auto& good : {check_mar_line(parameters.mar),
                             check("acuity.pixels_per_degree", pixels_per_degree,
                                   P::kMinPixelsPerDegree, P::kMaxPixelsPerDegree),
                             check("acuity.border_px", parameters.border_px, 0.0, 64.0)}) {
        if (!good) {
            return std::unexpected(good.error());
        }
    }
    AcuityProfile profile(parameters.mar, pixels_per_degree);
    const auto side = [](std::uint32_t stated, double needed, std::uint32_t least) {
        return stated != 0 ? stated
                           : std::max(static_cast<std::uint32_t>(std::lround(needed)), least);
    };
    profile.lp_ = {side(parameters.lp_width, profile.max_columns_, LpSize::kMinWidth),
                   side(parameters.lp_height, most_rows(parameters.mar, pixels_per_degree),
                        LpSize::kMinHeight)};
    if (!profile.lp_.in_range()) {
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("acuity.lp_width = {} and acuity.lp_height = {} make an LP-buffer of {}x{} "
                        "texels: it must have {}x{} to {}x{}",
                        parameters.lp_width, parameters.lp_height, profile.lp_.width,
                        profile.lp_.height, LpSize::kMinWidth, LpSize::kMinHeight, LpSize::kMaxSide,
                        LpSize::kMaxSide)});
    }
    return profile;
}

AcuityProfile::AcuityProfile(const MarLine& mar, double pixels_per_degree)
    : mar_(mar),
      pixels_per_degree_(pixels_per_degree),
      display_limit_deg_(std::max((2.0 / pixels_per_degree - mar.omega0_deg) / mar.slope, 0.0)),
      omega_at_limit_deg_(mar.omega_deg(display_limit_deg_)),
      max_columns_(columns(kMaxEccentricityDeg)) {}

double AcuityProfile::columns(double eccentricity_deg) const {
    if (eccentricity_deg <= display_limit_deg_) {
        return pixels_per_degree_ * eccentricity_deg;
    }
    return pixels_per_degree_ * display_limit_deg_ +
           2.0 / mar_.slope *
               std::log1p(mar_.slope * (eccentricity_deg - display_limit_deg_) /
                          omega_at_limit_deg_);
}

double AcuityProfile::eccentricity_deg(double columns) const {
    const double beyond = columns - pixels_per_degree_ * display_limit_deg_;
    if (beyond <= 0.0) {
        return columns / pixels_per_degree_;
    }
    return display_limit_deg_ +
           omega_at_limit_deg_ * std::expm1(0.5 * mar_.slope * beyond) / mar_.slope;
}

double AcuityProfile::columns_per_degree(double eccentricity_deg) const {
    return eccentricity_deg <= display_limit_deg_ ? pixels_per_degree_
                                                  : 2.0 / mar_.omega_deg(eccentricity_deg);
}

double AcuityProfile::u(double eccentricity_deg) const {
    return columns(std::clamp(eccentricity_deg, 0.0, kMaxEccentricityDeg)) / max_columns_;
}

double AcuityProfile::eccentricity_of_u_deg(double u) const {
    return std::min(eccentricity_deg(std::clamp(u, 0.0, 1.0) * max_columns_), kMaxEccentricityDeg);
}

}  // namespace gazeloop::foveation
