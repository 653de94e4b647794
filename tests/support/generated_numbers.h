#pragma once

#include <rapidcheck.h>
#include <bit>
#include <cstdint>
#include <limits>

namespace gazeloop::tests {

/// For properties: evenly between two, both included. Of full size, since rapidcheck's ranges grow
/// with the test: of their own accord nine in ten numbers stay in the lower half.
inline rc::Gen<double> number_between(double low, double high) {
    constexpr std::int64_t kSteps = std::int64_t{1} << 30;
    return rc::gen::map(
        rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::int64_t>(0, kSteps + 1)),
        [low, high](std::int64_t step) {
            return low + (high - low) * static_cast<double>(step) / static_cast<double>(kSteps);
        });
}

inline double between(double low, double high) { return *number_between(low, high); }

/// Any double by its bits: normal numbers of every size, subnormals, infinities, not-a-numbers.
inline double any_double() { return std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>()); }

/// Any number, the ones that are none included, and many of the size of settings: rapidcheck's own
/// doubles are hardly ever between 0 and 1.
inline double anything() {
    return *rc::gen::oneOf(
        rc::gen::arbitrary<double>(), number_between(-2.0, 2.0), number_between(0.0, 100.0),
        rc::gen::element(0.0, -0.0, 1e-300, 1e300, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()));
}

}  // namespace gazeloop::tests
