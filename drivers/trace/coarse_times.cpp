#include "drivers/trace/coarse_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr std::size_t kTimesTheUsual = 4;
constexpr std::size_t kFewestOfAStand = 8;
/// One row in so many shares its time: then the clock counts in steps all along.
constexpr std::size_t kRowsPerShared = 20;

/// Rows of one time, [first, end).
struct Group {
    std::size_t first = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t size() const { return end - first; }
};

std::vector<Group> groups_of(std::span<const TimedRow> rows) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i > 0 && rows[i].step_ns == 0 && !rows[i].set) {
            ++groups.back().end;
        } else {
            groups.push_back({i, i + 1});
        }
    }
    return groups;
}

std::size_t median_size(const std::vector<Group>& groups) {
    std::vector<std::size_t> sizes;
    sizes.reserve(groups.size());
    for (const Group& group : groups) {
        sizes.push_back(group.size());
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

/// The median step of the host's clock; 0: too few are known.
std::int64_t host_interval_ns(std::span<const TimedRow> rows) {
    std::vector<std::int64_t> steps;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].host_ns && rows[i - 1].host_ns && *rows[i].host_ns > *rows[i - 1].host_ns) {
            steps.push_back(
                time::saturated(static_cast<__int128>(*rows[i].host_ns) - *rows[i - 1].host_ns));
        }
    }
    if (steps.empty()) {
        return 0;
    }
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

class Spreading {
  public:
    Spreading(std::span<const TimedRow> rows, std::int64_t tick_ns)
        : rows_(rows), tick_ns_(tick_ns), groups_(groups_of(rows)) {
        const std::size_t usual = median_size(groups_);
        // Without two readings that differ there is no step.
        longest_ = tick_ns_ == 0 ? 1 : std::max(kFewestOfAStand, kTimesTheUsual * usual) - 1;
        std::size_t shared = 0;
        std::size_t counted = 0;
        for (const Group& group : groups_) {
            if (group.size() <= longest_) {
                shared += group.size() > 1 ? group.size() : 0;
                counted += group.size();
            }
        }
        coarse_ = shared * kRowsPerShared > counted;
        if (tick_ns_ == 0) {
            tick_ns_ = host_interval_ns(rows);
        }
        spread_.interval_ns = coarse_ ? mean_interval_ns() : tick_ns_;
    }

    SpreadTimes run() {
        for (const TimedRow& row : rows_) {
            spread_.step_ns.push_back(row.step_ns);
        }
        spread_.coarse_ns.assign(rows_.size(), coarse_ ? tick_ns_ : 0);
        spread_.reckoned.assign(rows_.size(), false);
        for (const Group& group : groups_) {
            if (group.size() > longest_) {
                go_on(group);
            } else if (group.size() > 1) {
                spread_evenly(group, std::min(tick_ns_, step_after(group)), tick_ns_);
                if (shared_rows_ == 0) {
                    first_line_ = rows_[group.first].line;
                }
                shared_rows_ += group.size();
            }
        }
        if (shared_rows_ > 0) {
            spread_.findings.push_back(
                {.kind = TraceFindingKind::CoarseTimes,
                 .line = first_line_,
                 .rows = shared_rows_,
                 .dropped = 0,
                 .span_ns = tick_ns_,
                 .text = fmt::format("{} rows share their time with others: spread, in their "
                                     "order, over the clock's step of {} ms",
                                     shared_rows_, static_cast<double>(tick_ns_) * 1e-6)});
        }
        return std::move(spread_);
    }

  private:
    /// From row to row, where the clock neither stands nor leaves a gap.
    [[nodiscard]] std::int64_t mean_interval_ns() const {
        constexpr std::int64_t kGapTicks = 8;
        __int128 sum = 0;
        __int128 count = 0;
        for (std::size_t g = 1; g < groups_.size(); ++g) {
            const TimedRow& row = rows_[groups_[g].first];
            if (groups_[g - 1].size() <= longest_ && !row.set &&
                row.step_ns / kGapTicks <= tick_ns_) {
                sum += row.step_ns;
                count += static_cast<__int128>(groups_[g - 1].size());
            }
        }
        return count == 0 ? tick_ns_ : std::max<std::int64_t>(1, time::saturated(sum / count));
    }

    /// To the reading that follows; the tick if none does, or the clock was set.
    [[nodiscard]] std::int64_t step_after(const Group& group) const {
        const bool followed = group.end < rows_.size() && !rows_[group.end].set;
        return followed ? rows_[group.end].step_ns : tick_ns_;
    }

    void spread_evenly(const Group& group, std::int64_t over_ns, std::int64_t coarse_ns) {
        const auto size = static_cast<__int128>(group.size());
        std::int64_t before = 0;
        for (std::size_t i = 0; i < group.size(); ++i) {
            const auto since = static_cast<std::int64_t>(static_cast<__int128>(over_ns) * i / size);
            if (i > 0) {
                spread_.step_ns[group.first + i] = since - before;
            }
            before = since;
            spread_.coarse_ns[group.first + i] = coarse_ns;
        }
        if (group.end < rows_.size() && !rows_[group.end].set) {
            spread_.step_ns[group.end] = rows_[group.end].step_ns - before;
        }
    }

    /// What went by on the host's clock from one row to another, if it did.
    [[nodiscard]] std::optional<std::int64_t> host_step(std::size_t from, std::size_t to) const {
        const auto& a = rows_[from].host_ns;
        const auto& b = rows_[to].host_ns;
        if (!a || !b || *b <= *a) {
            return std::nullopt;
        }
        return time::saturated(static_cast<__int128>(*b) - *a);
    }

    /// The clock stood for the whole group.
    void go_on(const Group& group) {
        const bool followed = group.end < rows_.size();
        const std::size_t last = followed ? group.end : group.end - 1;
        const std::int64_t usual = time::saturated(static_cast<__int128>(spread_.interval_ns) *
                                                   static_cast<__int128>(last - group.first));
        const std::int64_t elapsed = host_step(group.first, last).value_or(usual);
        const bool caught_up =
            followed && !rows_[group.end].set && rows_[group.end].step_ns >= elapsed / 2;
        const auto steps = static_cast<__int128>(last - group.first);
        std::int64_t before = 0;
        for (std::size_t i = group.first + 1; i <= last; ++i) {
            const std::int64_t over_ns = caught_up ? rows_[group.end].step_ns : elapsed;
            const auto since = static_cast<std::int64_t>(
                static_cast<__int128>(over_ns) * static_cast<__int128>(i - group.first) / steps);
            if (i < group.end || !rows_[i].set) {
                spread_.step_ns[i] = since - before;
            }
            before = since;
        }
        if (!caught_up && followed && !rows_[group.end].set) {
            spread_.sets.push_back(group.end);
        }
        for (std::size_t i = group.first + 1; i < group.end; ++i) {
            spread_.reckoned[i] = true;
            spread_.coarse_ns[i] = spread_.interval_ns;
        }
        spread_.findings.push_back(
            {.kind = TraceFindingKind::ClockStoodStill,
             .line = rows_[group.first].line,
             .rows = group.size(),
             .dropped = 0,
             .span_ns = elapsed,
             .text = fmt::format("{} rows of one time: {}", group.size(),
                                 caught_up ? "spread up to the next"
                                 : host_step(group.first, last)
                                     ? "they follow the host's clock"
                                     : "they follow one another at the usual interval")});
    }

    std::span<const TimedRow> rows_;
    std::int64_t tick_ns_;
    std::vector<Group> groups_;
    std::size_t longest_ = 0;  ///< group of a clock that counts in steps
    bool coarse_ = false;
    SpreadTimes spread_;
    std::size_t shared_rows_ = 0;
    std::uint64_t first_line_ = 0;
};

}  // namespace

SpreadTimes spread(std::span<const TimedRow> rows, std::int64_t tick_ns) {
    return rows.empty() ? SpreadTimes{} : Spreading(rows, tick_ns).run();
}

}  // namespace gazeloop::drivers
