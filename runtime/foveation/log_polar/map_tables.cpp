#include "runtime/foveation/log_polar/map_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/foveation/picture/angles.h"

namespace gazeloop::foveation {
namespace {

/// What every map has in common.
MapTables common_tables(LpSize lp) {
    MapTables tables;
    for (std::size_t i = 0; i <= MapTables::kMantissaSteps; ++i) {
        const double fraction = static_cast<double>(i) / MapTables::kMantissaSteps;
        tables.log2_mantissa[i] = static_cast<float>(std::log2(1.0 + fraction));
        tables.exp2_fraction[i] = static_cast<float>(std::exp2(fraction));
    }
    tables.row.resize(lp.height);
    for (std::size_t j = 0; j < lp.height; ++j) {
        const double angle = (static_cast<double>(j) + 0.5) * (2.0 * std::numbers::pi / lp.height);
        tables.row[j] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
    return tables;
}

/// `u_at(s)` falls. Rounding of what is flat must not make it rise.
template <typename Function>
void fill_forward(MapTables& tables, const Function& u_at) {
    float least = 1.0F;
    for (std::size_t i = 0; i <= MapTables::kForwardSteps; ++i) {
        const double t = static_cast<double>(i) / MapTables::kForwardSteps;
        least = std::min(least, static_cast<float>(u_at(t * t)));
        tables.forward[i] = least;
    }
}

template <typename Function>
void fill_columns(MapTables& tables, std::uint32_t width, const Function& value_at) {
    const std::size_t half_columns = 2 * std::size_t{width};
    tables.column.resize(half_columns + 1);
    for (std::size_t i = 0; i <= half_columns; ++i) {
        tables.column[i] = static_cast<float>(
            value_at(static_cast<double>(i) / static_cast<double>(half_columns)));
    }
}

}  // namespace

double MapTables::gaze_frame_u(const AcuityProfile& profile, double s) {
    return profile.u(2.0 * std::asin(std::exp2(-s * kGazeOctaves)) * kDegreesPerRadian);
}

MapTables build_map_tables(const RadialKernel& kernel, LpSize lp) {
    MapTables tables = common_tables(lp);
    std::visit(
        [&](const auto& k) {
            fill_forward(tables, [&](double s) { return k(1.0 - s); });
            fill_columns(tables, lp.width, [&](double u) { return 1.0 - k.inverse(u); });
        },
        kernel.kind());
    return tables;
}

MapTables build_map_tables(const AcuityProfile& profile) {
    MapTables tables = common_tables(profile.lp());
    fill_forward(tables, [&](double s) { return MapTables::gaze_frame_u(profile, s); });
    fill_columns(tables, profile.lp().width, [&](double u) {
        return std::tan(0.5 * profile.eccentricity_of_u_deg(u) / kDegreesPerRadian);
    });
    return tables;
}

}  // namespace gazeloop::foveation
