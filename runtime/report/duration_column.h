#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/time/span.h"

namespace gazeloop::report {

/// One number for each row, or unknown; all exact, whatever they are. Rows come in blocks. A block
/// whose rows are all alike takes one number, one whose numbers lie within 2^31 of its first one
/// takes 4 bytes a row, any other 8 and a bit.
class NumberColumn {
  public:
    void add(std::optional<std::int64_t> number);
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Precondition: row < size().
    [[nodiscard]] std::optional<std::int64_t> at(std::size_t row) const;

  private:
    class Block {
      public:
        void add(std::optional<std::int64_t> number);
        [[nodiscard]] std::optional<std::int64_t> at(std::size_t row) const;

      private:
        enum class Form : std::uint8_t { Alike, Near, Any };

        [[nodiscard]] std::optional<std::int32_t> near(std::optional<std::int64_t> number) const;
        void spread();
        void widen();

        Form form_ = Form::Alike;
        std::size_t rows_ = 0;
        std::optional<std::int64_t> first_;  ///< Alike: of every row
        std::int64_t base_ = 0;              ///< what Near counts from
        std::vector<std::int32_t> near_;
        std::vector<std::int64_t> any_;
        std::vector<bool> known_;  ///< of any_
    };

    static constexpr std::size_t kBlockRows = 4096;

    std::vector<Block> blocks_;
    std::size_t size_ = 0;
};

/// What a column's numbers are.
enum class Unit : std::uint8_t {
    Nanoseconds,
    Microdegrees,  ///< 1e-6 degrees
    Count,
};

/// Ends the names that programs read: "_ms", "_degrees", nothing for counts.
std::string_view unit_suffix(Unit unit);

/// What a reduced plot shows of some rows that follow each other.
struct Bin {
    std::size_t first = 0;  ///< row
    std::size_t end = 0;    ///< the row after the last one
    std::size_t known = 0;  ///< rows that know their number; where 0, there is nothing below
    std::int64_t least = 0;
    std::int64_t greatest = 0;
    double mean = 0.0;
};

/// One quantity over the frames of a session.
class DurationColumn {
  public:
    /// `key` is for programs, `label` for people.
    DurationColumn(std::string key, std::string label, Unit unit = Unit::Nanoseconds);

    void add(const time::Span& span);

    [[nodiscard]] const std::string& key() const { return key_; }
    [[nodiscard]] const std::string& label() const { return label_; }
    [[nodiscard]] Unit unit() const { return unit_; }

    [[nodiscard]] std::size_t size() const { return numbers_.size(); }
    /// None: unknown, or the frame has no such thing. Precondition: row < size().
    [[nodiscard]] std::optional<std::int64_t> at(std::size_t row) const { return numbers_.at(row); }

    /// Frames that know it.
    [[nodiscard]] std::uint64_t known() const { return known_; }
    /// Frames by how it was obtained. Unknown counts only frames that should know it.
    [[nodiscard]] const std::array<std::uint64_t, time::kStampKindCount>& frames_by_kind() const {
        return frames_by_kind_;
    }
    /// A row that this is not about, e.g. a frame without gaze: it is not even unknown.
    void skip() { numbers_.add(std::nullopt); }
    /// Makes every number of the frames that this is about unknown.
    void forget();
    /// Frames whose number is below 0: a clock or a prediction was wrong there.
    [[nodiscard]] std::uint64_t negative() const { return negative_; }
    [[nodiscard]] std::optional<std::int64_t> least() const;
    [[nodiscard]] std::optional<std::int64_t> greatest() const;
    [[nodiscard]] std::optional<double> mean() const;

    /// Each of these percentiles (latency::nearest_rank), exactly one of the numbers. None: it is
    /// withheld, because there are too few.
    [[nodiscard]] std::vector<std::optional<std::int64_t>> percentiles(
        std::span<const double> percents) const;

    /// Rows [first, end) in at most `count` bins of as many rows as possible alike, in order; fewer
    /// where there are fewer rows. Every number is within its bin's least and greatest, so that no
    /// spike is lost. Precondition: first <= end <= size().
    [[nodiscard]] std::vector<Bin> bins(std::size_t first, std::size_t end,
                                        std::size_t count) const;

  private:
    std::string key_;
    std::string label_;
    Unit unit_;
    NumberColumn numbers_;
    std::array<std::uint64_t, time::kStampKindCount> frames_by_kind_{};
    std::uint64_t known_ = 0;
    std::uint64_t negative_ = 0;
    std::int64_t least_ = 0;
    std::int64_t greatest_ = 0;
    __int128 sum_ = 0;
};

}  // namespace gazeloop::report
