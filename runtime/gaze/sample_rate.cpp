#include "runtime/gaze/sample_rate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

struct Interval {
    double length_ns = 0.0;
    double reports = 1.0;  ///< from the one sample to the other, by their numbers

    [[nodiscard]] double per_report_ns() const { return length_ns / reports; }
};

double at_share(memory::LongVector<double>& values, double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

double sample_rate_hz(const SampleRange& samples) {
    memory::LongVector<Interval> intervals;
    std::size_t counted_by_one = 0;
    struct Before {
        time::Stamp sampled;
        std::uint64_t sequence;
    };
    std::optional<Before> before;
    for (const GazeSample& now : samples) {
        if (!now.sampled.known() || (before && now.sampled.ns < before->sampled.ns)) {
            continue;
        }
        if (before) {
            const std::uint64_t last = before->sequence;
            const std::uint64_t counted = now.sequence > last ? now.sequence - last : 1;
            counted_by_one += now.sequence == last + 1 ? 1U : 0U;
            intervals.push_back(
                {static_cast<double>(time::between(before->sampled, now.sampled).ns),
                 static_cast<double>(counted)});
        }
        before = {now.sampled, now.sequence};
    }
    if (intervals.empty()) {
        return 0.0;
    }
    if (2 * counted_by_one <= intervals.size()) {
        for (Interval& interval : intervals) {
            interval.reports = 1.0;
        }
    }
    memory::LongVector<double> lengths_ns;
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
