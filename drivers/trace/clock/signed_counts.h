#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace gazeloop::drivers {

/// What a file's report numbers tell of a counter of 8, 16 or 32 bits that was written with a sign:
/// behind the top of its positive half it goes on at the bottom of its negative one.
class SignedCounts {
  public:
    void add(std::uint64_t number) { most_ = std::max(most_.value_or(0), number); }
    /// `what` says where it stands, "column 'n': '-7'". It is called for the first only.
    template <typename What>
    void add_negative(std::int64_t number, const What& what) {
        if (first_.empty()) {
            first_ = what();
        }
        least_ = std::min(least_, number);
        greatest_ = std::max(greatest_, number);
    }

    [[nodiscard]] bool any_negative() const { return !first_.empty(); }
    [[nodiscard]] const std::string& first_negative() const { return first_; }
    /// Whether a number is a negative one in two's complement of 64 bits.
    [[nodiscard]] static bool is_negative(std::uint64_t number) {
        return static_cast<std::int64_t>(number) < 0;
    }

    /// What to add to negative numbers so that they count on; none where they are no such
    /// counter's. It is one where, of so many rows, numbers lie near both the top and the bottom,
    /// or where all are negative and not the same.
    [[nodiscard]] std::optional<std::uint64_t> range(std::uint64_t rows) const {
        for (const unsigned bits : {8U, 16U, 32U}) {
            const std::int64_t half = std::int64_t{1} << (bits - 1);
            constexpr std::int64_t kAnyhow = 64;
            constexpr std::int64_t kTimesTheRows = 4;
            constexpr std::uint64_t kMostRows = 1'000'000'000;
            const std::int64_t near = std::min(
                half / 4,
                kAnyhow + kTimesTheRows * static_cast<std::int64_t>(std::min(rows, kMostRows)));
            const bool turns = most_ && *most_ < static_cast<std::uint64_t>(half) &&
                               *most_ >= static_cast<std::uint64_t>(half - near) &&
                               least_ <= near - half;
            const bool below = !most_ && least_ != greatest_ && bits == 32U;
            if (least_ >= -half && (turns || below)) {
                return static_cast<std::uint64_t>(half) * 2;
            }
        }
        return std::nullopt;
    }

  private:
    std::optional<std::uint64_t> most_;
    std::int64_t least_ = 0;
    std::int64_t greatest_ = std::numeric_limits<std::int64_t>::min();
    std::string first_;
};

}  // namespace gazeloop::drivers
