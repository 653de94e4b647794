#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gazeloop::latency {

/// Values that come and go, kept in order, in memory that is there from the start. So percentiles
/// of a window that moves on are exact at any time, and cost nothing. A value that takes another's
/// place moves only what lies between the two.
class OrderedValues {
  public:
    explicit OrderedValues(std::size_t capacity);

    /// Preconditions: `gone` is there; there is room for `come` once it has gone.
    void replace(std::optional<std::int64_t> gone, std::optional<std::int64_t> come);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// In ascending order.
    [[nodiscard]] std::span<const std::int64_t> values() const { return {values_.data(), size_}; }

    /// The smallest value that at least `percent` of all do not exceed (nearest rank). Withheld
    /// where fewer than 1 / (1 - percent/100) are there, as in every report. Precondition: 1 to 99.
    [[nodiscard]] std::optional<std::int64_t> percentile(unsigned percent) const;

  private:
    std::vector<std::int64_t> values_;
    std::size_t size_ = 0;
};

}  // namespace gazeloop::latency
