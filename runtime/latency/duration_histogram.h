#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gazeloop::latency {

/// Durations in fixed memory (about 73 KB) and without allocation after construction. Count, least,
/// greatest and mean are exact. Percentiles come from logarithmic bins, within 0.2 % of the true
/// sample for durations up to 73 minutes and within 7 % beyond.
class DurationHistogram {
  public:
    DurationHistogram();

    /// Negative durations are possible (a prediction that was overtaken) and binned as such.
    void add(std::int64_t duration_ns);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::optional<double> min_ms() const;
    [[nodiscard]] std::optional<double> max_ms() const;
    [[nodiscard]] std::optional<double> mean_ms() const;

    /// The percentile (nearest rank), `percent` in (0, 100). Withheld (nullopt) when fewer than
    /// 1 / (1 - percent/100) samples exist: it would only repeat the greatest one.
    [[nodiscard]] std::optional<double> percentile_ms(double percent) const;

  private:
    /// Bins of one sign by magnitude, the most negative sample first when read from the front.
    std::vector<std::uint32_t> bins_;
    std::uint64_t count_ = 0;
    std::int64_t min_ns_ = 0;
    std::int64_t max_ns_ = 0;
    __int128 sum_ns_ = 0;
};

}  // namespace gazeloop::latency
