#include "drivers/trace/clock/sequence_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using Wide = __int128;

class Numbering {
  public:
    Numbering(const RowsRead& rows, const DeviceTimes& times)
        : rows_(rows), times_(times), count_(times.rows.size()), dropped_(rows.size(), true) {
        for (const std::size_t row : times.rows) {
            dropped_[row] = false;
        }
    }

    SequenceNumbers run() {
        steps_.assign(count_, 1);
        std::uint64_t number = 0;
        if (const std::uint64_t stride = stride_of(); stride > 1) {
            report_stride(stride);
        } else if (counts()) {
            number = begin();
            for (std::size_t i = 1; i < count_; ++i) {
                steps_[i] += take(i);
            }
            if (!follows_a_count()) {
                number = 0;
                std::fill(steps_.begin(), steps_.end(), 1);
                report_no_count();
            } else {
                result_.lost = lost_is_known() ? std::optional(lost_) : std::nullopt;
            }
        }
        Wide last = number;
        for (std::size_t i = 1; i < count_; ++i) {
            last += steps_[i];
        }
        if (last > std::numeric_limits<std::uint64_t>::max()) {
            number = 0;
        }
        result_.numbers.reserve(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            number += i == 0 ? 0 : steps_[i];
            result_.numbers.push_back(number);
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] const std::optional<std::uint64_t>& sequence(std::size_t position) const {
        return rows_[times_.rows[position]].sequence;
    }

    /// By how much nearly every number is above the one before; 1 where numbers differ.
    [[nodiscard]] std::uint64_t stride_of() const {
        constexpr std::size_t kFewest = 16;
        constexpr std::size_t kNearlyAll = 10;  // all but one in so many
        memory::LongVector<std::uint64_t> steps;
        for (std::size_t i = 1; i < count_; ++i) {
            if (sequence(i - 1) && sequence(i) && *sequence(i) > *sequence(i - 1)) {
                steps.push_back(*sequence(i) - *sequence(i - 1));
            }
        }
        if (steps.size() < kFewest) {
            return 1;
        }
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
        std::nth_element(steps.begin(), middle, steps.end());
        const std::uint64_t stride = *middle;
        const auto same = static_cast<std::size_t>(std::ranges::count(steps, stride));
        return (count_ - 1 - same) * kNearlyAll <= count_ ? stride : 1;
    }

    void report_stride(std::uint64_t stride) {
        result_.findings.push_back(
            {.kind = TraceFindingKind::SequenceOutlier,
             .line = rows_[times_.rows.front()].line,
             .rows = count_,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("the sequence goes on by {} from row to row: whether it counts so "
                                 "or reports are missing all along is not known; numbered by row",
                                 stride)});
    }

    /// Whether there are numbers, and not the same one all over.
    [[nodiscard]] bool counts() const {
        std::optional<std::uint64_t> first;
        for (std::size_t i = 0; i < count_; ++i) {
            if (first && sequence(i) && *first != *sequence(i)) {
                return true;
            }
            first = first ? first : sequence(i);
        }
        return first.has_value() && count_ == 1;
    }

    /// The number of the first row.
    std::uint64_t begin() {
        if (!sequence(0)) {
            return 0;
        }
        const bool is_outlier = count_ > 2 && sequence(1) && sequence(2) &&
                                *sequence(0) != *sequence(1) && !follows(0, 1) && !wraps(0, 1) &&
                                follows(1, 2);
        if (!is_outlier) {
            last_ = 0;
            return *sequence(0);
        }
        report_outlier(0);
        return *sequence(1) > 0 ? *sequence(1) - 1 : 0;
    }

    /// What was lost before this position, since the last number that counts.
    std::uint64_t take(std::size_t i) {
        if (!sequence(i) || i < late_end_) {
            return 0;
        }
        if (!last_) {
            last_ = i;
            return 0;
        }
        const std::size_t before = *last_;
        if (*sequence(i) == *sequence(before)) {
            last_ = i;
            return 0;
        }
        if (follows(before, i)) {
            last_ = i;
            return lose(before, i, *sequence(i) - *sequence(before));
        }
        if (take_late_rows(before, i)) {
            return 0;
        }
        const auto range = wraps(before, i);
        if (i + 1 < count_ && sequence(i + 1) && *sequence(i + 1) != *sequence(before) &&
            follows(before, i + 1) && !(range && is_followed_by_late_rows(before, i, *range))) {
            report_outlier(i);
            return 0;
        }
        last_ = i;
        if (range) {
            report_restart(i, fmt::format("the sequence wraps from {} to {}: counted on",
                                          *sequence(before), *sequence(i)));
            return lose(before, i, *sequence(i) + *range - *sequence(before), *range);
        }
        note_break(i);
        const bool in_a_gap = had_time_for_more(before, i);
        restarted_in_a_gap_ = restarted_in_a_gap_ || in_a_gap;
        report_restart(i, fmt::format("the sequence begins anew, {} after {}: counted on{}",
                                      *sequence(i), *sequence(before),
                                      in_a_gap ? "; what was lost there is not known" : ""));
        return 0;
    }

    /// Whether reports may be missing between two rows, by the time, or because nobody knows how
    /// long it was.
    [[nodiscard]] bool had_time_for_more(std::size_t before, std::size_t after) const {
        const auto set = std::upper_bound(times_.sets.begin(), times_.sets.end(), before);
        const auto& host_before = rows_[times_.rows[before]].host_ns;
        const auto& host_after = rows_[times_.rows[after]].host_ns;
        const bool made_up = set != times_.sets.end() && *set <= after &&
                             !(host_before && host_after && *host_after > *host_before);
        return made_up || usual_reports(before, after) > static_cast<Wide>(after - before) + 1;
    }

    /// Not where the count begins anew across a gap, or many rows have no number.
    [[nodiscard]] bool lost_is_known() const {
        constexpr std::size_t kRowsPerUnknown = 10;
        std::size_t unknown = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            unknown += sequence(i) ? 0 : 1;
        }
        return !restarted_in_a_gap_ && unknown * kRowsPerUnknown <= count_;
    }

    /// Whether there was time for so many reports, give or take what a clock is off.
    [[nodiscard]] bool has_room(std::size_t before, std::size_t after, Wide reports) const {
        constexpr Wide kAnyhow = 64;
        constexpr Wide kTimesAsMany = 4;
        return reports >= 1 && reports <= kAnyhow + kTimesAsMany * usual_reports(before, after);
    }

    /// As many as usually come in the time from the one to the other.
    [[nodiscard]] Wide usual_reports(std::size_t before, std::size_t after) const {
        const Wide elapsed_ns = static_cast<Wide>(times_.time_ns[after]) - times_.time_ns[before];
        const Wide interval_ns = std::max<std::int64_t>(1, times_.interval_ns);
        return (elapsed_ns + interval_ns / 2) / interval_ns;
    }

    /// Whether the numbers count at all: few of them are out of place.
    [[nodiscard]] bool follows_a_count() const {
        constexpr std::size_t kAnyhow = 4;
        constexpr std::size_t kRowsPerBreak = 10;
        return breaks_ <= kAnyhow || breaks_ * kRowsPerBreak <= count_;
    }

    [[nodiscard]] bool follows(std::size_t before, std::size_t after) const {
        return has_room(before, after, static_cast<Wide>(*sequence(after)) - *sequence(before));
    }

    /// The range of a counter that began anew in between. One that was set to 0 looks the same but
    /// for this: it does not stand near its end, or the count over the wrap is not what the time
    /// that went by has room for.
    [[nodiscard]] std::optional<std::uint64_t> wraps(std::size_t before, std::size_t after) const {
        constexpr Wide kFew = 4;
        constexpr Wide kShare = 5;
        const Wide usual = usual_reports(before, after);
        for (const std::uint32_t bits : {8U, 16U, 32U}) {
            const std::uint64_t range = std::uint64_t{1} << bits;
            if (*sequence(before) >= range || *sequence(after) >= *sequence(before)) {
                continue;
            }
            const Wide reports = static_cast<Wide>(*sequence(after)) + range - *sequence(before);
            const Wide off = reports > usual ? reports - usual : usual - reports;
            const bool at_the_end = range - *sequence(before) <= kFew;
            if (off <= kFew + usual / kShare || (at_the_end && has_room(before, after, reports))) {
                return range;
            }
        }
        return std::nullopt;
    }

    /// Whether a number over a wrap comes before those that it left out, and the count goes on from
    /// it: else it is an outlier.
    [[nodiscard]] bool is_followed_by_late_rows(std::size_t before, std::size_t wrapped,
                                                std::uint64_t range) const {
        const Gap gap{.position = wrapped,
                      .before = *sequence(before),
                      .after = *sequence(wrapped) + range,
                      .missing = 0,
                      .range = range};
        std::size_t end = wrapped + 1;
        const std::size_t latest = std::min(count_, end + kMostLate);
        while (end < latest && sequence(end) && gap.holds(*sequence(end))) {
            ++end;
        }
        return end > wrapped + 1 && end < count_ && sequence(end) && follows(wrapped, end);
    }

    /// Whether the rows from here on, up to one that follows what is before, are those that seemed
    /// lost further up: they were filed late, and are lost no more.
    bool take_late_rows(std::size_t before, std::size_t first) {
        const std::size_t latest = std::min(count_, first + kMostLate);
        std::size_t end = first;
        while (end < latest && sequence(end) && gap_of(*sequence(end)) != nullptr) {
            ++end;
        }
        if (end == first || end == count_ || !sequence(end) || !follows(before, end)) {
            return false;
        }
        for (std::size_t i = first; i < end; ++i) {
            Gap& gap = *gap_of(*sequence(i));
            if (gap.missing > 0) {
                --gap.missing;
                --steps_[gap.position];
                --lost_;
            }
        }
        late_end_ = end;
        result_.findings.push_back(
            {.kind = TraceFindingKind::SequenceOutlier,
             .line = rows_[times_.rows[first]].line,
             .rows = end - first,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("{} {} of a gap further up, {} to {}, filed late: not lost, "
                                 "numbered where they stand",
                                 end - first, end - first == 1 ? "row" : "rows", *sequence(first),
                                 *sequence(end - 1))});
        return true;
    }

    /// Rows in a row that may be filed late.
    static constexpr std::size_t kMostLate = 256;

    /// Numbers that no row had, between two.
    struct Gap {
        std::size_t position = 0;  ///< of the row after it
        std::uint64_t before = 0;
        std::uint64_t after = 0;  ///< counted on over a wrap
        std::uint64_t missing = 0;
        std::uint64_t range = 0;  ///< of the counter that wrapped in it; 0: none did

        [[nodiscard]] bool holds(std::uint64_t number) const {
            const auto inside = [this](std::uint64_t counted) {
                return counted > before && counted < after;
            };
            return inside(number) || (range > 0 && inside(number + range));
        }
    };

    /// The gap that a number belongs to, of the latest.
    [[nodiscard]] Gap* gap_of(std::uint64_t number) {
        constexpr std::size_t kLatest = 16;
        const std::size_t looked_at = std::min(gaps_.size(), kLatest);
        const auto found =
            std::find_if(gaps_.end() - static_cast<std::ptrdiff_t>(looked_at), gaps_.end(),
                         [&](const Gap& gap) { return gap.holds(number); });
        return found == gaps_.end() ? nullptr : &*found;
    }

    /// Counts what the tracker lost of so many steps of the sequence; some rows in between were
    /// left out by the reader.
    std::uint64_t lose(std::size_t before, std::size_t after, std::uint64_t steps,
                       std::uint64_t range = 0) {
        // Rows with a number of their own in between had their turn: only numbers are left.
        const std::uint64_t positions = after - before;
        std::uint64_t missing = steps > positions ? steps - positions : 0;
        // What was left out may have been filed too early or too late.
        constexpr std::size_t kFiledOff = 256;
        const std::size_t first = std::min(times_.rows[before], times_.rows[after]);
        const std::size_t from = first - std::min(first, kFiledOff);
        const std::size_t to =
            std::min(rows_.size(), std::max(times_.rows[before], times_.rows[after]) + kFiledOff);
        std::vector<std::uint64_t> left_out;
        for (std::size_t row = from; row < to && missing > 0; ++row) {
            if (dropped_[row] && rows_[row].sequence) {
                const std::uint64_t since = *rows_[row].sequence - *sequence(before);
                if (since > 0 && since < steps) {
                    left_out.push_back(since);
                }
            }
        }
        std::sort(left_out.begin(), left_out.end());
        left_out.erase(std::unique(left_out.begin(), left_out.end()), left_out.end());
        missing -= std::min<std::uint64_t>(missing, left_out.size());
        lost_ += missing;
        if (missing > 0) {
            gaps_.push_back({after, *sequence(before), *sequence(before) + steps, missing, range});
        }
        return missing;
    }

    /// Instead of one finding for each.
    void report_no_count() {
        result_.findings.clear();
        result_.findings.push_back(
            {.kind = TraceFindingKind::SequenceOutlier,
             .line = rows_[times_.rows[first_break_]].line,
             .rows = breaks_,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("the sequence does not count: {} of {} numbers do not follow the "
                                 "one before; numbered by row, what was lost is not known",
                                 breaks_, count_)});
    }

    void note_break(std::size_t position) {
        first_break_ = breaks_ == 0 ? position : first_break_;
        ++breaks_;
    }

    void report_outlier(std::size_t position) {
        note_break(position);
        result_.findings.push_back(
            {.kind = TraceFindingKind::SequenceOutlier,
             .line = rows_[times_.rows[position]].line,
             .rows = 1,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("sequence {} is not between its neighbours': counted on",
                                 *sequence(position))});
    }

    void report_restart(std::size_t position, std::string text) {
        result_.findings.push_back({.kind = TraceFindingKind::SequenceRestarted,
                                    .line = rows_[times_.rows[position]].line,
                                    .rows = 1,
                                    .dropped = 0,
                                    .span_ns = 0,
                                    .text = std::move(text)});
    }

    const RowsRead& rows_;
    const DeviceTimes& times_;
    std::size_t count_;  ///< of used rows
    memory::LongVector<bool> dropped_;
    memory::LongVector<std::uint64_t> steps_;  ///< from the number before, of each position
    memory::LongVector<Gap> gaps_;
    std::size_t late_end_ = 0;         ///< up to here rows were filed late
    std::optional<std::size_t> last_;  ///< position of the last number that counts
    std::size_t breaks_ = 0;           ///< numbers that do not follow, wraps left aside
    std::size_t first_break_ = 0;      ///< the position of the first
    std::uint64_t lost_ = 0;
    bool restarted_in_a_gap_ = false;
    SequenceNumbers result_;
};

}  // namespace

SequenceNumbers sequence_numbers(const RowsRead& rows, const DeviceTimes& times) {
    return Numbering(rows, times).run();
}

}  // namespace gazeloop::drivers
