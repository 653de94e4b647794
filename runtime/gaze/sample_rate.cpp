#include "runtime/gaze/sample_rate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

struct Interval {
    double length_ns = 0.0;
    double reports = 1.0;  ///< from the one sample to the other, by their numbers

    [[nodiscard]] double per_report_ns() const { return length_ns / reports; }
};

double at_share(std::vector<double>& values, double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

double sample_rate_hz(std::span<const GazeSample> samples) {
    std::vector<Interval> intervals;
    std::size_t counted_by_one = 0;
    std::optional<std::size_t> before;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const GazeSample& now = samples[i];
        if (!now.sampled.known() || (before && now.sampled.ns < samples[*before].sampled.ns)) {
            continue;
        }
        if (before) {
            const std::uint64_t last = samples[*before].sequence;
            const std::uint64_t counted = now.sequence > last ? now.sequence - last : 1;
            counted_by_one += now.sequence == last + 1 ? 1U : 0U;
            intervals.push_back(
                {static_cast<double>(time::between(samples[*before].sampled, now.sampled).ns),
                 static_cast<double>(counted)});
        }
        before = i;
    }
    if (intervals.empty()) {
        return 0.0;
    }
    if (2 * counted_by_one <= intervals.size()) {
        for (Interval& interval : intervals) {
            interval.reports = 1.0;
        }
    }
    std::vector<double> lengths_ns;
    lengths_ns.reserve(intervals.size());
    for (const Interval& interval : intervals) {
        lengths_ns.push_back(interval.per_report_ns());
    }
    constexpr double kUpperQuartile = 0.75;
    constexpr double kHardly = 1.25;
    constexpr double kGap = 8.0;
    constexpr double kLoss = 1.75;
    const double median_ns = at_share(lengths_ns, 0.5);
    const bool even = at_share(lengths_ns, kUpperQuartile) <= kHardly * median_ns;
    const double longest_ns = (even ? kLoss : kGap) * median_ns;
    double sum_ns = 0.0;
    double reports = 0.0;
    for (const Interval& interval : intervals) {
        if (interval.per_report_ns() <= longest_ns) {
            sum_ns += interval.length_ns;
            reports += interval.reports;
        }
    }
    return sum_ns > 0.0 ? 1e9 * reports / sum_ns : 0.0;
}

}  // namespace gazeloop::gaze
