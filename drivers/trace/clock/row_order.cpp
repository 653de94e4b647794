#include "drivers/trace/clock/row_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "drivers/trace/clock/time_text.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

/// Whether no other report looks like this one: noise or its number make it differ.
bool is_telling(const RowsRead& rows, std::size_t row) {
    const KeptRow& kept = rows.kept(row);
    return kept.valid(gaze::Eye::Left) || kept.valid(gaze::Eye::Right) ||
           rows[row].sequence.has_value();
}

/// The work on the rows of one file.
class Ordering {
  public:
    Ordering(const RowsRead& rows, std::span<Wide> at_ns, memory::LongVector<std::size_t> used,
             std::int64_t interval_ns)
        : rows_(rows), at_ns_(at_ns), interval_ns_(interval_ns) {
        order_.rows = std::move(used);
    }

    RowOrder run() {
        turn_round();
        leave_out_repeats();
        jitters_ = jitters();
        const Wide reach_ns = static_cast<Wide>(interval_ns_) * kOrderWindow;
        for (std::size_t i = 1; i < order_.rows.size(); ++i) {
            const Wide back_ns = at(i - 1) - at(i);
            if (back_ns > 0 && back_ns <= reach_ns) {
                i = std::max(i, sort_around(i));
            }
        }
        leave_out_repeats();
        return std::move(order_);
    }

  private:
    [[nodiscard]] Wide at(std::size_t position) const { return at_ns_[order_.rows[position]]; }
    [[nodiscard]] const RowClock& row(std::size_t position) const {
        return rows_[order_.rows[position]];
    }

    void turn_round() {
        constexpr std::size_t kFewest = 4;
        constexpr std::size_t kNearlyAll = 10;  // all but one in so many
        const std::size_t count = order_.rows.size();
        std::size_t back = 0;
        std::size_t against = 0;
        std::size_t counted_on = 0;
        for (std::size_t i = 1; i < count; ++i) {
            back += at(i) < at(i - 1) ? 1 : 0;
            against += at(i) > at(i - 1) ? 1 : 0;
            counted_on +=
                row(i - 1).sequence && row(i).sequence && *row(i).sequence > *row(i - 1).sequence
                    ? 1
                    : 0;
        }
        if (count < kFewest || against * kNearlyAll > back || counted_on * kNearlyAll > back) {
            return;
        }
        std::reverse(order_.rows.begin(), order_.rows.end());
        order_.findings.push_back({.kind = TraceFindingKind::OutOfOrder,
                                   .line = row(count - 1).line,
                                   .rows = count,
                                   .dropped = 0,
                                   .span_ns = 0,
                                   .text = "the last row is the earliest: read from the end"});
    }

    /// Those that hold the same report as one of the rows before, and its time.
    void leave_out_repeats() {
        const std::size_t count = order_.rows.size();
        std::size_t repeated = 0;
        std::size_t differing = 0;
        for (std::size_t i = 1; i < count; ++i) {
            if (at(i) == at(i - 1)) {
                const bool same = same_report(rows_, order_.rows[i], order_.rows[i - 1]);
                repeated += same && is_telling(rows_, order_.rows[i]) ? 1 : 0;
                differing += same ? 0 : 1;
            }
        }
        // Closed eyes look the same in all rows of a coarse clock's step.
        const bool closed_too = repeated >= differing;
        memory::LongVector<std::size_t> kept;
        kept.reserve(count);
        Wide latest = 0;
        for (const std::size_t index : order_.rows) {
            const bool may_be = !kept.empty() && at_ns_[index] <= latest &&
                                (closed_too || is_telling(rows_, index));
            if (may_be && has_twin(index, kept)) {
                order_.repeats.push_back(index);
                continue;
            }
            latest = kept.empty() ? at_ns_[index] : std::max(latest, at_ns_[index]);
            kept.push_back(index);
        }
        order_.rows = std::move(kept);
    }

    [[nodiscard]] bool has_twin(std::size_t index,
                                const memory::LongVector<std::size_t>& before) const {
        const std::size_t window = std::min(before.size(), kOrderWindow);
        return std::any_of(before.end() - static_cast<std::ptrdiff_t>(window), before.end(),
                           [&](std::size_t other) {
                               return at_ns_[index] == at_ns_[other] &&
                                      same_report(rows_, index, other);
                           });
    }

    /// Sorts the rows that are mixed up where time goes back to `back`, if that is what is the
    /// matter. The position of the last of them.
    std::size_t sort_around(std::size_t back) {
        std::size_t first = back - 1;
        std::size_t end = back + 1;
        Wide least = at(back);
        Wide most = at(back - 1);
        // A row moves by no more than a window, but those that move may follow one another all
        // along.
        const std::size_t earliest = back - std::min(back, kOrderWindow);
        std::size_t latest = std::min(back + kOrderWindow, order_.rows.size());
        for (bool grows = true; grows;) {
            grows = false;
            for (std::size_t i = earliest; i < first; ++i) {
                if (at(i) > least) {
                    grows = true;
                    most = std::max(most, highest(i, first));
                    least = std::min(least, lowest(i, first));
                    first = i;
                }
            }
            for (std::size_t i = latest; i-- > end;) {
                if (at(i) < most) {
                    grows = true;
                    most = std::max(most, highest(end, i + 1));
                    least = std::min(least, lowest(end, i + 1));
                    end = i + 1;
                    latest = std::min(i + kOrderWindow, order_.rows.size());
                    break;
                }
            }
        }
        sort(first, end);
        return end - 1;
    }

    [[nodiscard]] Wide highest(std::size_t first, std::size_t end) const {
        Wide most = at(first);
        for (std::size_t i = first; i < end; ++i) {
            most = std::max(most, at(i));
        }
        return most;
    }
    [[nodiscard]] Wide lowest(std::size_t first, std::size_t end) const {
        Wide least = at(first);
        for (std::size_t i = first; i < end; ++i) {
            least = std::min(least, at(i));
        }
        return least;
    }

    void sort(std::size_t first, std::size_t end) {
        memory::LongVector<std::size_t> sorted;  // positions
        for (std::size_t i = first; i < end; ++i) {
            sorted.push_back(i);
        }
        // A stable sort would take memory for half of them.
        std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
            return at(a) < at(b) || (at(a) == at(b) && a < b);
        });
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            const std::size_t from = sorted[i];
            const std::size_t to = first + i;
            if (std::max(from, to) - std::min(from, to) > kOrderWindow) {
                return;
            }
        }
        const memory::LongVector<std::size_t> rising = longest_rising(first, end);
        const bool numbers_count_on = counts_up(first, end, &RowClock::sequence);
        if (numbers_count_on || !is_better(sorted, rising)) {
            const Wide most_ns = furthest(sorted);
            if (!jitters_ || most_ns > static_cast<Wide>(interval_ns_) * kJitterIntervals) {
                return;
            }
            if (numbers_count_on || counts_up(first, end, &RowClock::host_ns)) {
                level(sorted, rising.size(), most_ns);
                return;
            }
        }
        const std::size_t moved = sorted.size() - rising.size();
        const auto out = std::find_if(sorted.begin(), sorted.end(), [&](std::size_t i) {
            return !std::binary_search(rising.begin(), rising.end(), i);
        });
        order_.findings.push_back(
            {.kind = TraceFindingKind::OutOfOrder,
             .line = row(out == sorted.end() ? first : *out).line,
             .rows = moved,
             .dropped = 0,
             .span_ns = time::saturated(at(sorted.back()) - at(sorted.front())),
             .text = fmt::format("{} of {} rows are not in the order of their times: put in order",
                                 moved, sorted.size())});
        memory::LongVector<std::size_t> rows;
        rows.reserve(sorted.size());
        for (const std::size_t i : sorted) {
            rows.push_back(order_.rows[i]);
        }
        std::copy(rows.begin(), rows.end(),
                  order_.rows.begin() + static_cast<std::ptrdiff_t>(first));
    }

    template <typename Number>
    [[nodiscard]] bool counts_up(std::size_t first, std::size_t end,
                                 std::optional<Number> RowClock::* number) const {
        for (std::size_t i = first; i < end; ++i) {
            const auto& now = row(i).*number;
            if (!now || (i > first && *now <= *(row(i - 1).*number))) {
                return false;
            }
        }
        return true;
    }

    /// By how much a time moves at most where times are put in order among rows that stay.
    [[nodiscard]] Wide furthest(const memory::LongVector<std::size_t>& sorted) const {
        std::size_t place = *std::min_element(sorted.begin(), sorted.end());
        Wide most_ns = 0;
        for (const std::size_t i : sorted) {
            const Wide by_ns = at(i) - at(place++);
            most_ns = std::max(most_ns, by_ns < 0 ? -by_ns : by_ns);
        }
        return most_ns;
    }

    /// Leaves the rows where they are, and puts their times in order. So many are as they stand.
    void level(const memory::LongVector<std::size_t>& sorted, std::size_t rising, Wide most_ns) {
        const std::size_t first = *std::min_element(sorted.begin(), sorted.end());
        memory::LongVector<Wide> times_ns;
        times_ns.reserve(sorted.size());
        for (const std::size_t i : sorted) {
            times_ns.push_back(at(i));
        }
        for (std::size_t i = 0; i < times_ns.size(); ++i) {
            at_ns_[order_.rows[first + i]] = times_ns[i];
        }
        order_.findings.push_back(
            {.kind = TraceFindingKind::OutOfOrder,
             .line = row(first).line,
             .rows = sorted.size() - rising,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("times jitter, {} of {} go back while the rows count on: levelled "
                                 "by up to {}",
                                 sorted.size() - rising, sorted.size(),
                                 in_words(time::saturated(most_ns)))});
    }

    /// Whether steps are usually off by much of an interval, so that one back is nothing special.
    [[nodiscard]] bool jitters() const {
        constexpr double kOff = 0.15;
        memory::LongVector<double> off;
        for (std::size_t i = 1; i < order_.rows.size(); ++i) {
            const auto step_ns = static_cast<double>(at(i) - at(i - 1));
            if (step_ns != 0.0) {  // of a coarse clock's rows many share a reading
                off.push_back(std::abs(step_ns / static_cast<double>(interval_ns_) - 1.0));
            }
        }
        if (off.empty() || interval_ns_ == 0) {
            return false;
        }
        const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
        std::nth_element(off.begin(), middle, off.end());
        return *middle > kOff;
    }

    /// The most rows of [first, end) whose times never go back, as positions.
    [[nodiscard]] memory::LongVector<std::size_t> longest_rising(std::size_t first,
                                                                 std::size_t end) const {
        memory::LongVector<std::size_t> ends;  // of the rising rows of each length, the least one
        memory::LongVector<std::size_t> before(end - first);
        for (std::size_t i = first; i < end; ++i) {
            const auto place =
                std::upper_bound(ends.begin(), ends.end(), i,
                                 [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
            before[i - first] = place == ends.begin() ? i : *std::prev(place);
            if (place == ends.end()) {
                ends.push_back(i);
            } else {
                *place = i;
            }
        }
        memory::LongVector<std::size_t> rising(ends.size());
        std::size_t i = ends.back();
        for (std::size_t length = ends.size(); length-- > 0; i = before[i - first]) {
            rising[length] = i;
        }
        return rising;
    }

    [[nodiscard]] bool is_better(const memory::LongVector<std::size_t>& sorted,
                                 const memory::LongVector<std::size_t>& rising) const {
        const auto counts_up = [&](const auto& positions) {
            return std::adjacent_find(positions.begin(), positions.end(),
                                      [&](std::size_t a, std::size_t b) {
                                          return !row(a).sequence || !row(b).sequence ||
                                                 *row(a).sequence > *row(b).sequence;
                                      }) == positions.end();
        };
        // A spike costs nearly one or more in its place too; a row left out at either end of the
        // file leaves no gap behind.
        constexpr double kAsGood = 0.25;
        const auto [least, greatest] = std::minmax_element(sorted.begin(), sorted.end());
        const std::size_t first = *least;
        const std::size_t last = *greatest;
        return counts_up(sorted) ||
               unevenness(sorted, first, last) < unevenness(rising, first, last) + kAsGood;
    }

    /// By how many intervals the steps are off, with the rows before and after; no step counts for
    /// more than one.
    [[nodiscard]] double unevenness(const memory::LongVector<std::size_t>& positions,
                                    std::size_t first, std::size_t last) const {
        double sum = 0.0;
        const auto add = [&](Wide step_ns) {
            sum += std::min(
                1.0,
                std::abs(static_cast<double>(step_ns) / static_cast<double>(interval_ns_) - 1.0));
        };
        if (first > 0) {
            add(at(positions.front()) - at(first - 1));
        }
        for (std::size_t i = 1; i < positions.size(); ++i) {
            add(at(positions[i]) - at(positions[i - 1]));
        }
        if (last + 1 < order_.rows.size()) {
            // What follows may be mixed up itself.
            const std::size_t end = std::min(last + 1 + kOrderWindow, order_.rows.size());
            add(lowest(last + 1, end) - at(positions.back()));
        }
        return sum;
    }

    const RowsRead& rows_;
    std::span<Wide> at_ns_;
    std::int64_t interval_ns_;
    bool jitters_ = false;
    RowOrder order_;
};

}  // namespace

bool same_report(const RowsRead& rows, std::size_t a, std::size_t b) {
    if (rows[a].sequence != rows[b].sequence) {
        return false;
    }
    const KeptRow& one = rows.kept(a);
    const KeptRow& other = rows.kept(b);
    return one.same_ray(other, gaze::Eye::Left) && one.same_ray(other, gaze::Eye::Right);
}

RowOrder rows_in_order(const RowsRead& rows, std::span<Wide> at_ns,
                       memory::LongVector<std::size_t> used, std::int64_t interval_ns) {
    return Ordering(rows, at_ns, std::move(used), interval_ns).run();
}

}  // namespace gazeloop::drivers
