#include "runtime/foveation/log_polar/map_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/foveation/picture/angles.h"

namespace gazeloop::foveation {
namespace {

constexpr double kHalfLn2 = 0.5 * std::numbers::ln2;
/// Rounding of one float operation, relative. Vulkan allows division 2.5 units in the last place (5
/// of these) and sqrt, as the inverse of inversesqrt, 4.5 (9).
constexpr double kEps = 1.0 / (1 << 24);
constexpr double kDivision = 5.0 * kEps;
constexpr double kSqrt = 9.0 * kEps;

// Linear interpolation between entries h apart errs by |f''| h^2 / 8.
constexpr double kSteps2 = double{MapTables::kMantissaSteps} * MapTables::kMantissaSteps;
/// log2(1 + x), absolute: |f''| <= 1 / ln 2; entries and interpolation round three times below 1.
constexpr double kLog2Error = 1.0 / (8.0 * std::numbers::ln2 * kSteps2) + 3.0 * kEps;
/// 2^x, relative: f'' / f = ln^2 2; entries, fraction and interpolation round four times.
constexpr double kExp2Error = std::numbers::ln2 * std::numbers::ln2 / (8.0 * kSteps2) + 4.0 * kEps;

/// turns(), the sum of three errors: the fit's 2.3e-8; the quotient's, with a weight of at most 1 /
/// (2 pi); and half a unit in the last place below 1, of the final subtraction from 1, .5 or .25.
constexpr double kTurnsError = 2.3e-8 + kDivision / kTurn + 0.5 * kEps;

double distance_px(const gaze::PixelPosition& a, const gaze::PixelPosition& b) {
    return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

/// How far the position moves when its shares are off by du and dv.
double moved_px(const RadialMap& map, const gaze::PixelPosition& from, const LpShare& share,
                double du, double dv) {
    double radial = 0.0;
    double tangential = 0.0;
    for (const double sign : {-1.0, 1.0}) {
        const auto u = map.position({std::clamp(share.u + sign * du, 0.0, 1.0), share.v});
        const auto v = map.position({share.u, share.v + sign * dv});
        const double infinite = std::numeric_limits<double>::infinity();
        radial = std::max(radial, u ? distance_px(*u, from) : infinite);
        tangential = std::max(tangential, v ? distance_px(*v, from) : infinite);
    }
    return std::hypot(radial, tangential);
}

double half_ulp(double value) {
    const auto rounded = static_cast<float>(value);
    return 0.5 * static_cast<double>(std::nextafter(rounded, 2.0F) - rounded);
}

/// The relative error in radius: dr / r = dy ln2 / 2, where y = log2 q and q is the squared radius
/// over the greatest squared radius. dy has these parts: the relative error of q; y's table; its
/// sum with the exponent and its scaling (two roundings); and its root, which counts twice.
double radius_error(double q_error, double q) {
    const double y = std::abs(std::log2(q));
    return kHalfLn2 * (q_error / std::numbers::ln2 + kLog2Error + y * (3.0 * kEps + 2.0 * kSqrt));
}

}  // namespace

// The forward table's error is measured in double on the function itself, because no formula with
// K'' holds for every kernel. It is taken at three points of each cell, and increased by a quarter
// for what lies between them.
MapError::MapError(const RadialKernel& kernel) {
    std::visit(
        [&](const auto& k) {
            for (std::size_t i = 0; i < MapTables::kForwardSteps; ++i) {
                cell_errors_.push_back(
                    MapTables::interpolation_error(i, [&](double s) { return k(1.0 - s); }));
            }
        },
        kernel.kind());
}

MapError::MapError(const AcuityProfile& profile) {
    for (std::size_t i = 0; i < MapTables::kForwardSteps; ++i) {
        cell_errors_.push_back(MapTables::interpolation_error(
            i, [&](double s) { return MapTables::gaze_frame_u(profile, s); }));
    }
}

double MapError::table_error(double s) const {
    // The cell that rounding may have led to instead is a neighbour.
    const auto last = static_cast<std::ptrdiff_t>(MapTables::kForwardSteps) - 1;
    const auto cell =
        static_cast<std::ptrdiff_t>(std::sqrt(std::clamp(s, 0.0, 1.0)) * MapTables::kForwardSteps);
    double error = 0.0;
    for (std::ptrdiff_t i = cell - 1; i <= cell + 1; ++i) {
        error = std::max(
            error, cell_errors_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))]);
    }
    return error;
}

double MapError::forward_px(const LogPolarMap& map, const gaze::PixelPosition& position) const {
    const LpShare share = map.share(position);
    const double r = std::max(distance_px(position, map.fovea()), 1.0);
    const double q = std::pow(r / map.max_radius_px(), 2.0);
    // The fovea as floats, and the difference.
    const double offset = kEps * (std::hypot(map.fovea().x_px, map.fovea().y_px) + r);
    // Two products and a sum, 1 / rmax^2 and the product with it.
    const double radial = r * radius_error(4.0 * kEps, q);
    const double s = -std::log2(q) * 0.5 / map.log2_max_radius();
    // The entries' rounding, and the interpolated sum's.
    const double du = table_error(s) + 2.0 * kEps * share.u;
    return offset + radial + moved_px(map, position, share, du, kTurnsError);
}

double MapError::forward_px(const AcuityMap& map, const gaze::PixelPosition& position) const {
    const LpShare share = map.share(position);
    const GazeFrame& frame = map.frame();
    const glm::dmat3& m = frame.gaze_from_picture();
    const glm::dvec3 ray = m * glm::dvec3(position.x_px, position.y_px, 1.0);
    // A component of the ray: three entries, three products, two sums.
    const glm::dvec3 terms = glm::abs(m[0]) * std::abs(position.x_px) +
                             glm::abs(m[1]) * std::abs(position.y_px) + glm::abs(m[2]);
    const double ray_rad = 4.0 * kEps * glm::length(terms) / glm::length(ray);
    const double rho = std::max(frame.polar(position).rho, 1e-12);
    const double eccentricity = 2.0 * std::atan(rho);
    // Term by term: across^2 (two products, a sum); the length, in both factors (a root, and half
    // of the three roundings under it); their sum and product; the division; behind the eye, the
    // difference from 1.
    const double q_error = 3.0 * kEps + 2.0 * (kSqrt + 1.5 * kEps) + 2.0 * kEps + kDivision + kEps;
    const double half_sine = std::sin(0.5 * eccentricity);
    const double q = half_sine * half_sine;
    // d sin(e / 2) / sin(e / 2) = de / (2 tan(e / 2)).
    const double radial_rad = 2.0 * rho * radius_error(q_error, q);
    const double s = -std::log2(q) * MapTables::kGazeScale;
    const double du = table_error(s) + 2.0 * kEps * share.u;
    const glm::dvec3 direction = frame.view_from_gaze() * ray;
    return (ray_rad + radial_rad) * pixels_per_degree(frame.view(), direction).finest /
               kRadiansPerDegree +
           moved_px(map, position, share, du, kTurnsError);
}

double MapError::conditioning_px(const RadialMap& map, const gaze::PixelPosition& position) {
    const LpShare share = map.share(position);
    return moved_px(map, position, share, half_ulp(share.u), half_ulp(share.v));
}

double MapError::inverse_px(const LogPolarMap& map, const LpShare& centre) {
    const double r = map.radius_px(centre.u);
    const double exponent = std::log2(map.max_radius_px() / r);
    const double fovea = std::hypot(map.fovea().x_px, map.fovea().y_px);
    // Term by term: the exponent (the column's entry, log2 rmax and their product); 2^x; rmax and
    // the product with it; the direction's entries and the products with them. Then the sum with
    // the fovea.
    const double relative = std::numbers::ln2 * 3.0 * kEps * exponent + kExp2Error + 2.0 * kEps +
                            2.0 * std::numbers::sqrt2 * kEps;
    return r * relative + kEps * (2.0 * fovea + r);
}

double MapError::inverse_px(const AcuityMap& map, const LpShare& centre) {
    const auto position = map.position(centre);
    if (!position) {
        return std::numeric_limits<double>::infinity();
    }
    const GazeFrame& frame = map.frame();
    const glm::dvec3 ray =
        frame.gaze_from_picture() * glm::dvec3(position->x_px, position->y_px, 1.0);
    // The ray in the gaze's frame has 6 roundings, of components not longer than the ray. Across:
    // rho, the direction's entry and two products (4). Along: rho^2 (3) and the difference. The
    // rotation has 5: three entries, products and sums, of terms that together are at most 3 times
    // as long.
    const double ray_rad = (6.0 + 15.0) * kEps;
    return ray_rad * pixels_per_degree(frame.view(), frame.view_from_gaze() * ray).finest /
           kRadiansPerDegree;
}

}  // namespace gazeloop::foveation
