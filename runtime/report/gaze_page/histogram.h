#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/memory/long_vector.h"

namespace gazeloop::report::page {

/// How often a quantity lay where: about 40 bins of one width, from a multiple of it.
struct Histogram {
    double first = 0.0;                   ///< where the first bin begins
    double width = 1.0;                   ///< 1, 2 or 5 times a power of ten
    std::vector<std::uint64_t> counts{};  ///< of each bin; a number on an edge is in the bin above
    std::uint64_t above = 0;              ///< beyond the last bin
    std::uint64_t known = 0;              ///< all of them
};

/// Up to the 99th percentile of the finite ones; others are left out. `finest` > 0: no bin is
/// narrower.
[[nodiscard]] Histogram histogram(memory::LongVector<double> values, double finest);

}  // namespace gazeloop::report::page
