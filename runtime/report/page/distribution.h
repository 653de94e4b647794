#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/report/duration_column.h"

namespace gazeloop::report::page {

/// How often a quantity lay where: bins of the same width, and what is above the last one.
struct Distribution {
    std::int64_t first = 0;             ///< where the first bin begins
    std::int64_t width = 1;             ///< 1, 2 or 5 times a power of ten
    std::vector<std::uint64_t> frames;  ///< of each bin; a number on an edge is in the bin above
    std::uint64_t above = 0;            ///< frames beyond the last bin
    std::uint64_t known = 0;            ///< all of them
};

/// Of each column, all with the same bins, so that they can be seen side by side: about 60 of them,
/// from the least number to the greatest 99.9th percentile (to the greatest number, where that is
/// withheld). Empty distributions for columns without a number.
[[nodiscard]] std::vector<Distribution> distributions(
    std::span<const DurationColumn* const> columns);

}  // namespace gazeloop::report::page
