#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gazeloop::calibration {

/// The middle one, of an even number the upper of both. Reorders the values. Precondition: there is
/// one.
[[nodiscard]] inline double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace gazeloop::calibration
