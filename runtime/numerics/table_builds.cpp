#include "runtime/numerics/table_builds.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/numerics/maps_of_interest.h"

namespace gazeloop::numerics {
namespace {

using foveation::ImageSize;
using foveation::LpSize;

template <typename Build>
double median_ms(const Build& build) {
    std::array<double, 9> ms{};
    for (double& each : ms) {
        const auto begin = std::chrono::steady_clock::now();
        const foveation::MapTables tables = build();
        each = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                   .count();
        if (tables.column.empty()) {
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
}

}  // namespace

std::vector<TableBuild> measure_table_builds(bool quick) {
    constexpr ImageSize kEye{2160, 2160};
    std::vector<TableBuild> builds;
    for (const NamedKernel& named : kernels_under_test(quick)) {
        const LpSize lp = value_or_throw(lp_buffer_size({.kernel = named.kernel}, kEye));
        builds.push_back(
            {named.name, median_ms([&] { return build_map_tables(named.kernel, lp); })});
    }
    const auto profile = value_or_throw(foveation::AcuityProfile::create({}, headset_view(kEye)));
    builds.push_back({"acuity m=0.022", median_ms([&] { return build_map_tables(profile); })});
    return builds;
}

}  // namespace gazeloop::numerics
