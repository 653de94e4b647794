#include "runtime/latency/duration_histogram.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace gazeloop::latency {
namespace {

/// Any magnitude is as likely as any other, below 2^bits.
rc::Gen<std::int64_t> durations(int bits) {
    return rc::gen::map(
        rc::gen::pair(rc::gen::arbitrary<std::uint64_t>(), rc::gen::inRange(0, 2 * bits)),
        [bits](const std::pair<std::uint64_t, int>& drawn) {
            const std::uint64_t magnitude = drawn.first >> (64 - drawn.second / 2 - 1);
            const auto value = static_cast<std::int64_t>(magnitude >> (bits == 64));
            return drawn.second % 2 == 0 ? value : -value;
        });
}

/// The nearest rank of a percentage in thousandths, in whole numbers.
std::int64_t exact_percentile(const std::vector<std::int64_t>& sorted, std::uint64_t per_mille) {
    const std::uint64_t rank = (per_mille * sorted.size() + 999) / 1000;
    return sorted[std::max<std::uint64_t>(rank, 1) - 1];
}

void check_against_sort(std::vector<std::int64_t> values, double tolerance) {
    DurationHistogram histogram;
    double sum = 0.0;
    for (const std::int64_t value : values) {
        histogram.add(value);
        sum += static_cast<double>(value);
    }
    std::sort(values.begin(), values.end());
    RC_ASSERT(histogram.count() == values.size());
    if (values.empty()) {
        return;
    }
    RC_ASSERT(*histogram.min_ms() == static_cast<double>(values.front()) / 1e6);
    RC_ASSERT(*histogram.max_ms() == static_cast<double>(values.back()) / 1e6);
    const double greatest = std::max(std::abs(*histogram.min_ms()), std::abs(*histogram.max_ms()));
    RC_ASSERT(std::abs(*histogram.mean_ms() - sum / static_cast<double>(values.size()) / 1e6) <=
              1e-12 * greatest);

    for (std::uint64_t per_mille = 1; per_mille < 1000; ++per_mille) {
        const auto percentile = histogram.percentile_ms(static_cast<double>(per_mille) / 10.0);
        const bool enough = values.size() * (1000 - per_mille) >= 1000;
        RC_ASSERT(percentile.has_value() == enough);
        if (enough) {
            const double exact = static_cast<double>(exact_percentile(values, per_mille)) / 1e6;
            RC_ASSERT(std::abs(*percentile - exact) <= tolerance * std::abs(exact) + 1e-15);
        }
    }
}

RC_GTEST_PROP(DurationHistogram, AgreesWithSortingUpTo73Minutes, ()) {
    check_against_sort(*rc::gen::container<std::vector<std::int64_t>>(durations(42)), 0.002);
}

RC_GTEST_PROP(DurationHistogram, AgreesWithSortingUpToTheExtremes, ()) {
    check_against_sort(*rc::gen::container<std::vector<std::int64_t>>(durations(64)), 0.07);
}

RC_GTEST_PROP(DurationHistogram, IsSymmetrical, ()) {
    const auto value = *durations(64);
    DurationHistogram forward;
    DurationHistogram mirrored;
    for (int i = 0; i < 2; ++i) {
        forward.add(value / 2);
        forward.add(value);
        mirrored.add(-(value / 2));
        mirrored.add(-value);
    }
    const bool rising = value >= 0;
    RC_ASSERT(*forward.percentile_ms(rising ? 75.0 : 25.0) ==
              -*mirrored.percentile_ms(rising ? 25.0 : 75.0));
}

}  // namespace
}  // namespace gazeloop::latency
