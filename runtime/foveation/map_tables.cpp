#include "runtime/foveation/map_tables.h"

#include <cmath>
#include <numbers>

namespace gazeloop::foveation {

MapTables build_map_tables(const PowerKernel& kernel, LpSize lp) {
    MapTables tables;
    for (std::size_t i = 0; i <= MapTables::kMantissaSteps; ++i) {
        const double fraction = static_cast<double>(i) / MapTables::kMantissaSteps;
        tables.log2_mantissa[i] = static_cast<float>(std::log2(1.0 + fraction));
        tables.exp2_fraction[i] = static_cast<float>(std::exp2(fraction));
    }
    for (std::size_t i = 0; i <= MapTables::kKernelSteps; ++i) {
        tables.kernel[i] =
            static_cast<float>(kernel(static_cast<double>(i) / MapTables::kKernelSteps));
    }
    const std::size_t half_columns = 2 * std::size_t{lp.width};
    tables.column.resize(half_columns + 1);
    for (std::size_t i = 0; i <= half_columns; ++i) {
        tables.column[i] = static_cast<float>(
            kernel.inverse(static_cast<double>(i) / static_cast<double>(half_columns)));
    }
    tables.row.resize(lp.height);
    for (std::size_t j = 0; j < lp.height; ++j) {
        const double angle = (static_cast<double>(j) + 0.5) * (2.0 * std::numbers::pi / lp.height);
        tables.row[j] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
    return tables;
}

}  // namespace gazeloop::foveation
