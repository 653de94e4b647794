#include "runtime/probe/light_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace gazeloop::probe {
namespace {

constexpr std::size_t kBins = 8192;

/// How often each brightness occurs. Bins are even in its square root, because cameras' noise is.
class Histogram {
  public:
    void add(double brightness, std::uint64_t times = 1) {
        const double root = std::sqrt(std::clamp(brightness, 0.0, 1.0));
        counts_[std::min(kBins - 1, static_cast<std::size_t>(root * kBins))] += times;
    }
    [[nodiscard]] static double value(std::size_t bin) {
        const double root = (static_cast<double>(bin) + 0.5) / kBins;
        return root * root;
    }
    [[nodiscard]] std::uint64_t count(std::size_t bin) const { return counts_[bin]; }

    /// Whether there is any in this bin or above.
    [[nodiscard]] bool any(std::size_t begin) const {
        return std::any_of(counts_.begin() + static_cast<std::ptrdiff_t>(begin), counts_.end(),
                           [](std::uint64_t count) { return count > 0; });
    }

    /// The bin in [begin, end) below which lies this share of what they hold.
    [[nodiscard]] std::size_t quantile(double share, std::size_t begin, std::size_t end) const {
        std::uint64_t all = 0;
        for (std::size_t bin = begin; bin < end; ++bin) {
            all += counts_[bin];
        }
        const double wanted = share * static_cast<double>(all);
        std::uint64_t below = 0;
        for (std::size_t bin = begin; bin < end; ++bin) {
            below += counts_[bin];
            if (static_cast<double>(below) > wanted) {
                return bin;
            }
        }
        return end - 1;
    }

  private:
    std::array<std::uint64_t, kBins> counts_{};
};

/// The first bin of the upper class; the lower one is never empty.
std::size_t split(const Histogram& histogram) {
    double low = Histogram::value(histogram.quantile(0.002, 0, kBins));
    double high = Histogram::value(histogram.quantile(0.998, 0, kBins));
    std::size_t border = 0;
    constexpr int kMostSteps = 100;
    for (int step = 0; step < kMostSteps; ++step) {
        const double middle = 0.5 * (low + high);
        std::size_t first_above = 0;
        std::array<double, 2> sums{};
        std::array<double, 2> counts{};
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            const bool above = Histogram::value(bin) > middle;
            first_above += above ? 0 : 1;
            const auto count = static_cast<double>(histogram.count(bin));
            sums[above ? 1 : 0] += count * Histogram::value(bin);
            counts[above ? 1 : 0] += count;
        }
        if (first_above == border) {
            break;
        }
        border = first_above;
        low = counts[0] > 0.0 ? sums[0] / counts[0] : low;
        high = counts[1] > 0.0 ? sums[1] / counts[1] : high;
    }
    return border;
}

}  // namespace

bool LightLevels::apart() const {
    // Normal noise alone, cut in two classes, gives levels 1.35 SD apart and a `noise` of 0.6 SD.
    constexpr double kNoises = 3.0;
    constexpr double kLeast = 0.001;  // three codes of an 8-bit picture at its dark end
    return bright - dark > std::max(kNoises * noise, kLeast);
}

LightLevels light_levels(const LightSeries& series, Light light) {
    if (series.size() == 0) {
        return {};
    }
    Histogram histogram;
    for (std::size_t frame = 0; frame < series.size(); ++frame) {
        histogram.add(series.at(light, frame));
    }
    const std::size_t border = split(histogram);
    const auto median = [&](std::size_t begin, std::size_t end) {
        return Histogram::value(histogram.quantile(0.5, begin, end));
    };
    LightLevels levels;
    levels.dark = median(0, border);
    levels.bright = histogram.any(border) ? median(border, kBins) : levels.dark;
    Histogram distances;
    for (std::size_t bin = 0; bin < border; ++bin) {
        distances.add(std::abs(Histogram::value(bin) - levels.dark), histogram.count(bin));
    }
    constexpr double kSdPerMedianDistance = 1.4826;  // of a normal distribution
    levels.noise = kSdPerMedianDistance * Histogram::value(distances.quantile(0.5, 0, kBins));
    return levels;
}

}  // namespace gazeloop::probe
