#include "runtime/latency/duration_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "runtime/latency/nearest_rank.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::latency {
namespace {

// Magnitudes below 2^9 ns have a bin each. Every power of two above is cut into equal bins. Up to
// 2^42 ns (73 minutes) there are 256, so that half a bin is at most 2^-9 (0.195 %) of the
// magnitude. Beyond, where only a broken clock leads, there are 8.
constexpr int kExactBits = 9;
constexpr int kFineLog2 = 8;
constexpr int kCoarseFrom = 42;
constexpr int kCoarseLog2 = 3;
constexpr std::size_t kExactBins = std::size_t{1} << kExactBits;
constexpr std::size_t kFineEnd = kExactBins + (std::size_t{kCoarseFrom - kExactBits} << kFineLog2);
constexpr std::size_t kBinsPerSign = kFineEnd + (std::size_t{64 - kCoarseFrom} << kCoarseLog2);

std::uint64_t magnitude(std::int64_t value) {
    return value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value)
                     : static_cast<std::uint64_t>(value);
}

std::size_t bin_of(std::uint64_t magnitude) {
    if (magnitude < kExactBins) {
        return magnitude;
    }
    const int octave = 63 - std::countl_zero(magnitude);
    const bool fine = octave < kCoarseFrom;
    const int log2 = fine ? kFineLog2 : kCoarseLog2;
    const std::size_t first = fine ? kExactBins : kFineEnd;
    const int octaves_before = octave - (fine ? kExactBits : kCoarseFrom);
    const std::uint64_t within = (magnitude >> (octave - log2)) - (std::uint64_t{1} << log2);
    return first + (static_cast<std::size_t>(octaves_before) << log2) + within;
}

/// The middle of a bin.
double magnitude_of(std::size_t bin) {
    if (bin < kExactBins) {
        return static_cast<double>(bin);
    }
    const bool fine = bin < kFineEnd;
    const int log2 = fine ? kFineLog2 : kCoarseLog2;
    const std::size_t rest = bin - (fine ? kExactBins : kFineEnd);
    const int octave = static_cast<int>(rest >> log2) + (fine ? kExactBits : kCoarseFrom);
    const std::size_t within = rest & ((std::size_t{1} << log2) - 1);
    const double width = std::ldexp(1.0, octave - log2);
    return std::ldexp(1.0, octave) + width * static_cast<double>(within) + (width - 1.0) / 2.0;
}

}  // namespace

DurationHistogram::DurationHistogram() : bins_(2 * kBinsPerSign) {}

void DurationHistogram::add(std::int64_t duration_ns) {
    const std::size_t bin = bin_of(magnitude(duration_ns));
    ++bins_[duration_ns < 0 ? kBinsPerSign - 1 - bin : kBinsPerSign + bin];
    min_ns_ = count_ == 0 ? duration_ns : std::min(min_ns_, duration_ns);
    max_ns_ = count_ == 0 ? duration_ns : std::max(max_ns_, duration_ns);
    sum_ns_ += duration_ns;
    ++count_;
}

std::optional<double> DurationHistogram::min_ms() const {
    if (count_ == 0) {
        return std::nullopt;
    }
    return static_cast<double>(min_ns_) / time::kNsPerMs;
}

std::optional<double> DurationHistogram::max_ms() const {
    if (count_ == 0) {
        return std::nullopt;
    }
    return static_cast<double>(max_ns_) / time::kNsPerMs;
}

std::optional<double> DurationHistogram::mean_ms() const {
    if (count_ == 0) {
        return std::nullopt;
    }
    return static_cast<double>(sum_ns_) / static_cast<double>(count_) / time::kNsPerMs;
}

std::optional<double> DurationHistogram::percentile_ms(double percent) const {
    const std::optional<std::uint64_t> rank = nearest_rank(percent, count_);
    if (!rank) {
        return std::nullopt;
    }
    std::size_t bin = 0;
    for (std::uint64_t seen = bins_[0]; seen < *rank; seen += bins_[bin]) {
        ++bin;
    }
    const double value_ns = bin < kBinsPerSign ? -magnitude_of(kBinsPerSign - 1 - bin)
                                               : magnitude_of(bin - kBinsPerSign);
    return std::clamp(value_ns, static_cast<double>(min_ns_), static_cast<double>(max_ns_)) /
           time::kNsPerMs;
}

}  // namespace gazeloop::latency
