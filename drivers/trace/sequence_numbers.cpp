#include "drivers/trace/sequence_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using Wide = __int128;

class Numbering {
  public:
    Numbering(std::span<const TraceRow> rows, const DeviceTimes& times)
        : rows_(rows), times_(times), count_(times.rows.size()), dropped_(rows.size(), true) {
        for (const std::size_t row : times.rows) {
            dropped_[row] = false;
        }
    }

    SequenceNumbers run() {
        std::vector<std::uint64_t> steps(count_, 1);
        std::uint64_t number = 0;
        if (counts()) {
            number = begin();
            for (std::size_t i = 1; i < count_; ++i) {
                steps[i] += take(i);
            }
        }
        Wide last = number;
        for (std::size_t i = 1; i < count_; ++i) {
            last += steps[i];
        }
        if (last > std::numeric_limits<std::uint64_t>::max()) {
            number = 0;
        }
        for (std::size_t i = 0; i < count_; ++i) {
            number += i == 0 ? 0 : steps[i];
            result_.numbers.push_back(number);
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] const std::optional<std::uint64_t>& sequence(std::size_t position) const {
        return rows_[times_.rows[position]].sequence;
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
        const bool is_outlier = count_ > 2 && sequence(1) && sequence(2) && !follows(0, 1) &&
                                !wraps(0, 1) && follows(1, 2);
        if (!is_outlier) {
            last_ = 0;
            return *sequence(0);
        }
        report_outlier(0);
        return *sequence(1) > 0 ? *sequence(1) - 1 : 0;
    }

    /// What was lost before this position, since the last number that counts.
    std::uint64_t take(std::size_t i) {
        if (!sequence(i)) {
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
        if (i + 1 < count_ && sequence(i + 1) && *sequence(i + 1) != *sequence(before) &&
            follows(before, i + 1)) {
            report_outlier(i);
            return 0;
        }
        last_ = i;
        if (const auto range = wraps(before, i)) {
            report_restart(i, fmt::format("the sequence wraps from {} to {}: counted on",
                                          *sequence(before), *sequence(i)));
            return lose(before, i, *sequence(i) + *range - *sequence(before));
        }
        report_restart(i, fmt::format("the sequence begins anew, {} after {}: counted on",
                                      *sequence(i), *sequence(before)));
        return 0;
    }

    /// Whether there was time for so many reports, give or take what a clock is off.
    [[nodiscard]] bool has_room(std::size_t before, std::size_t after, Wide reports) const {
        constexpr Wide kAnyhow = 64;
        constexpr Wide kTimesAsMany = 4;
        const Wide elapsed_ns = static_cast<Wide>(times_.time_ns[after]) - times_.time_ns[before];
        const Wide usual = elapsed_ns / std::max<std::int64_t>(1, times_.interval_ns);
        return reports >= 1 && reports <= kAnyhow + kTimesAsMany * usual;
    }

    [[nodiscard]] bool follows(std::size_t before, std::size_t after) const {
        return has_room(before, after, static_cast<Wide>(*sequence(after)) - *sequence(before));
    }

    [[nodiscard]] std::optional<std::uint64_t> wraps(std::size_t before, std::size_t after) const {
        for (const std::uint32_t bits : {8U, 16U, 32U}) {
            const std::uint64_t range = std::uint64_t{1} << bits;
            if (*sequence(before) < range && *sequence(after) < *sequence(before) &&
                has_room(before, after,
                         static_cast<Wide>(*sequence(after)) + range - *sequence(before))) {
                return range;
            }
        }
        return std::nullopt;
    }

    /// Counts what the tracker lost of so many steps of the sequence; some rows in between were
    /// left out by the reader.
    std::uint64_t lose(std::size_t before, std::size_t after, std::uint64_t steps) {
        // Rows with a number of their own in between had their turn: only numbers are left.
        const std::uint64_t positions = after - before;
        std::uint64_t missing = steps > positions ? steps - positions : 0;
        const std::size_t from = std::min(times_.rows[before], times_.rows[after]);
        const std::size_t to = std::max(times_.rows[before], times_.rows[after]);
        std::vector<std::uint64_t> left_out;
        for (std::size_t row = from + 1; row < to && missing > 0; ++row) {
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
        result_.lost += missing;
        return missing;
    }

    void report_outlier(std::size_t position) {
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

    std::span<const TraceRow> rows_;
    const DeviceTimes& times_;
    std::size_t count_;  ///< of used rows
    std::vector<bool> dropped_;
    std::optional<std::size_t> last_;  ///< position of the last number that counts
    SequenceNumbers result_;
};

}  // namespace

SequenceNumbers sequence_numbers(std::span<const TraceRow> rows, const DeviceTimes& times) {
    return Numbering(rows, times).run();
}

}  // namespace gazeloop::drivers
