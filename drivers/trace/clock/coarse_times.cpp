#include "drivers/trace/clock/coarse_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/trace/clock/stood_times.h"
#include "drivers/trace/clock/time_text.h"
#include "runtime/memory/long_vector.h"
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

memory::LongVector<Group> groups_of(std::span<const TimedRow> rows) {
    memory::LongVector<Group> groups;
    groups.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i > 0 && rows[i].step_ns == 0 && !rows[i].set) {
            ++groups.back().end;
        } else {
            groups.push_back({i, i + 1});
        }
    }
    return groups;
}

std::size_t median_size(const memory::LongVector<Group>& groups) {
    memory::LongVector<std::size_t> sizes;
    sizes.reserve(groups.size());
    for (const Group& group : groups) {
        sizes.push_back(group.size());
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

/// Of rows [first, end).
memory::LongVector<std::optional<std::int64_t>> host_times(std::span<const TimedRow> rows,
                                                           std::size_t first, std::size_t end) {
    memory::LongVector<std::optional<std::int64_t>> host_ns;
    for (std::size_t i = first; i < end; ++i) {
        host_ns.push_back(rows[i].host_ns);
    }
    return host_ns;
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
            tick_ns_ = host_interval_ns(host_times(rows, 0, rows.size()));
        }
        spread_.interval_ns = coarse_ ? mean_interval_ns() : tick_ns_;
    }

    SpreadTimes run() {
        spread_.step_ns.reserve(rows_.size());
        for (const TimedRow& row : rows_) {
            spread_.step_ns.push_back(row.step_ns);
        }
        spread_.coarse_ns.assign(rows_.size(), coarse_ ? tick_ns_ : 0);
        spread_.reckoned.assign(rows_.size(), false);
        for (const Group& group : groups_) {
            if (group.size() > longest_) {
                go_on(group);
                continue;
            }
            spread_over_tick(group);
            if (group.size() > 1) {
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
                                     "order, over the clock's step of {}",
                                     shared_rows_, in_words(tick_ns_))});
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

    /// A clock that counts in steps was read from within its first step on, and to within its last:
    /// at the usual interval, the few rows in these do not fill them.
    void spread_over_tick(const Group& group) {
        const std::int64_t usual_ns = time::saturated(static_cast<__int128>(spread_.interval_ns) *
                                                      static_cast<__int128>(group.size()));
        constexpr std::int64_t kMeanIsOffByOneIn = 50;
        const bool incomplete =
            coarse_ && usual_ns <= tick_ns_ - spread_.interval_ns + tick_ns_ / kMeanIsOffByOneIn;
        const bool followed = group.end < rows_.size() && !rows_[group.end].set;
        const bool at_an_end = group.first == 0 || !followed;
        std::int64_t over_ns = std::min(tick_ns_, step_after(group));
        if (incomplete && at_an_end) {
            over_ns = std::min(over_ns, usual_ns);
        }
        const auto size = static_cast<__int128>(group.size());
        std::int64_t before = 0;
        for (std::size_t i = 0; i < group.size(); ++i) {
            const auto since = static_cast<std::int64_t>(static_cast<__int128>(over_ns) * i / size);
            if (i > 0) {
                spread_.step_ns[group.first + i] = since - before;
            }
            before = since;
            spread_.coarse_ns[group.first + i] = coarse_ || group.size() > 1 ? tick_ns_ : 0;
        }
        if (followed) {
            const std::int64_t later_ns = group.first == 0 && incomplete ? tick_ns_ - usual_ns : 0;
            spread_.step_ns[group.end] =
                std::max<std::int64_t>(rows_[group.end].step_ns - later_ns, over_ns) - before;
        }
    }

    /// The clock stood for the whole group.
    void go_on(const Group& group) {
        const bool followed = group.end < rows_.size();
        const std::size_t last = followed ? group.end : group.end - 1;
        // A few more, to vouch for what the host's clock does at the end.
        constexpr std::size_t kMore = 8;
        const std::size_t end = std::min(group.end + kMore, rows_.size());
        const StoodTimes times =
            stood_times(host_times(rows_, group.first, end), spread_.interval_ns);
        const std::int64_t elapsed = times.since_ns[last - group.first];
        const bool caught_up =
            followed && !rows_[group.end].set && rows_[group.end].step_ns >= elapsed / 2;
        std::int64_t before = 0;
        for (std::size_t i = group.first + 1; i <= last; ++i) {
            std::int64_t since = times.since_ns[i - group.first];
            if (caught_up && elapsed > 0) {
                since = static_cast<std::int64_t>(static_cast<__int128>(rows_[group.end].step_ns) *
                                                  since / elapsed);
            }
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
             .text =
                 fmt::format("{} rows of one time: {}", group.size(),
                             caught_up       ? "spread up to the next"
                             : times.by_host ? "they follow the host's clock"
                                             : "they follow one another at the usual interval")});
    }

    std::span<const TimedRow> rows_;
    std::int64_t tick_ns_;
    memory::LongVector<Group> groups_;
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
