#include "drivers/trace/clock/lag_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <numbers>
#include <utility>

#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kShort_ns = 2 * kSecond_ns;
constexpr std::int64_t kLong_ns = 10 * kSecond_ns;
/// However far apart rows are.
constexpr std::size_t kFewestOfAWindow = 24;
constexpr std::size_t kMany = 8;
/// Where a step is searched for around the row that shows it.
constexpr std::size_t kNear = 24;
/// What of it must be seen there.
constexpr double kWhole = 0.9;

double median(memory::LongVector<double>& values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Indices of the row with the lowest lag of each second; a new second begins after a gap or cut.
struct Seconds {
    memory::LongVector<std::size_t> lowest;
    memory::LongVector<std::size_t> of_row;  ///< which second it is in
    std::int64_t span_ns = 0;
};

Seconds seconds_of(std::span<const LagRow> rows) {
    Seconds seconds;
    std::int64_t begin_ns = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::int64_t now_ns = rows[i].device_ns;
        const std::int64_t step_ns = i == 0 ? 0 : now_ns - rows[i - 1].device_ns;
        const bool joined = i > 0 && !rows[i].cut && step_ns < kSecond_ns;
        seconds.span_ns += joined ? step_ns : 0;
        if (!joined || now_ns - begin_ns >= kSecond_ns) {
            begin_ns = now_ns;
            seconds.lowest.push_back(i);
        } else if (rows[i].lag_ns < rows[seconds.lowest.back()].lag_ns) {
            seconds.lowest.back() = i;
        }
        seconds.of_row.push_back(seconds.lowest.size() - 1);
    }
    return seconds;
}

/// The row with the lowest lag of those within a length of time, as rows are added one by one.
class Lowest {
  public:
    Lowest(std::span<const LagRow> rows, double slope, std::int64_t window_ns)
        : rows_(rows), slope_(slope), window_ns_(window_ns) {}

    void add(std::size_t row) {
        if (count_ == 0) {
            oldest_ = row;
        }
        while (!rising_.empty() && rises(row, rising_.back()) <= 0.0) {
            rising_.pop_back();
        }
        rising_.push_back(row);
        ++count_;
        while (count_ > kFewestOfAWindow &&
               std::abs(rows_[oldest_].device_ns - rows_[row].device_ns) > window_ns_) {
            if (rising_.front() == oldest_) {
                rising_.pop_front();
            }
            oldest_ = row > oldest_ ? oldest_ + 1 : oldest_ - 1;
            --count_;
        }
    }
    void clear() {
        rising_.clear();
        count_ = 0;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t row() const { return rising_.front(); }

  private:
    /// By how much the lag of `a` is above that of `b`, without the slope.
    [[nodiscard]] double rises(std::size_t a, std::size_t b) const {
        return static_cast<double>(rows_[a].lag_ns - rows_[b].lag_ns) -
               slope_ * static_cast<double>(rows_[a].device_ns - rows_[b].device_ns);
    }

    std::span<const LagRow> rows_;
    double slope_;
    std::int64_t window_ns_;
    std::deque<std::size_t> rising_;
    std::size_t oldest_ = 0;
    std::size_t count_ = 0;
};

struct Side {
    std::size_t row = 0;  ///< the lowest
    std::size_t count = 0;
};

class StepSearch {
  public:
    StepSearch(std::span<const LagRow> rows, const LagTrend& trend, double resolution_ns,
               double few_rows_ns)
        : rows_(rows),
          trend_(trend),
          resolution_ns_(resolution_ns),
          few_rows_ns_(few_rows_ns),
          before_short_(rows, trend.slope, kShort_ns),
          before_long_(rows, trend.slope, kLong_ns) {}

    memory::LongVector<LagStep> run() {
        look_ahead();
        before_.resize(rows_.size());
        std::size_t falls_at = 0;  // 0: nowhere
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (falls_at > 0 && (rows_[i].cut || !falls(i))) {
                begin_at(best_fall(falls_at), i);
                falls_at = 0;
            }
            before_[i] = side(before_long_);
            if (rises(i)) {
                i = best_rise(i);
                begin_at(i, i);
            } else if (falls(i)) {
                falls_at = i;
            }
            if (rows_[i].cut) {
                if (falls_at > 0) {
                    begin_at(i, i);
                    falls_at = 0;
                }
                before_short_.clear();
                before_long_.clear();
            }
            before_short_.add(i);
            before_long_.add(i);
        }
        if (falls_at > 0) {
            begin_at(best_fall(falls_at), rows_.size());
        }
        measure();
        return std::move(steps_);
    }

  private:
    [[nodiscard]] bool rises(std::size_t row) const {
        const Side before = side(before_short_);
        const Side& after = after_long_[row];
        // Who knows whether the last few rows are only late.
        const bool lasts = after.count >= kMany ||
                           (before.count > 0 && rise(before.row, after.row) > double{kLong_ns});
        return lasts && exceeds(before, after, 1.0);
    }
    [[nodiscard]] bool falls(std::size_t row) const {
        return exceeds(side(before_long_), after_short_[row], -1.0);
    }

    [[nodiscard]] static Side side(const Lowest& lowest) {
        return lowest.count() == 0 ? Side{} : Side{lowest.row(), lowest.count()};
    }

    void look_ahead() {
        after_short_.resize(rows_.size());
        after_long_.resize(rows_.size());
        Lowest lowest_short(rows_, trend_.slope, kShort_ns);
        Lowest lowest_long(rows_, trend_.slope, kLong_ns);
        for (std::size_t i = rows_.size(); i-- > 0;) {
            if (i + 1 < rows_.size() && rows_[i + 1].cut) {
                lowest_short.clear();
                lowest_long.clear();
            }
            lowest_short.add(i);
            lowest_long.add(i);
            after_short_[i] = side(lowest_short);
            after_long_[i] = side(lowest_long);
        }
    }

    [[nodiscard]] double rise(std::size_t from, std::size_t to) const {
        return static_cast<double>(rows_[to].lag_ns - rows_[from].lag_ns) -
               trend_.slope * static_cast<double>(rows_[to].device_ns - rows_[from].device_ns);
    }

    /// Whether the step from one side to the other, times `sign`, is more than may be.
    [[nodiscard]] bool exceeds(const Side& before, const Side& after, double sign) const {
        if (before.count == 0 || after.count == 0) {
            return false;
        }
        constexpr double kLeast_ns = 2e6;
        constexpr double kNoises = 8.0;
        // The lowest of n is 1 / n of the mean height too high; hardly ever by so much more.
        constexpr double kHeights = 16.0;
        const std::size_t fewer = std::min(before.count, after.count);
        const auto apart_ns =
            static_cast<double>(rows_[after.row].device_ns - rows_[before.row].device_ns);
        double least_ns = kLeast_ns + resolution_ns_ + kNoises * trend_.noise_ns +
                          kHeights * trend_.height_ns / static_cast<double>(fewer) +
                          trend_.uncertainty * apart_ns;
        if (fewer < kMany) {
            least_ns = std::max(least_ns, few_rows_ns_ + trend_.uncertainty * apart_ns);
        }
        return sign * rise(before.row, after.row) > least_ns;
    }

    /// Rows that are late by more than the least step may stand next to it on the side that is
    /// lower. So of the next few rows, the first from which on all are as high as from any.
    [[nodiscard]] std::size_t best_rise(std::size_t row) const {
        const std::size_t before = before_short_.row();
        std::size_t end = row + 1;
        while (end < rows_.size() && end - row < kNear && !rows_[end].cut &&
               after_long_[end].count >= kMany) {
            ++end;
        }
        double most_ns = 0.0;
        for (std::size_t i = row; i < end; ++i) {
            most_ns = std::max(most_ns, rise(before, after_long_[i].row));
        }
        while (rise(before, after_long_[row].row) < kWhole * most_ns) {
            ++row;
        }
        return row;
    }
    /// The same of a fall: of the last few rows, the last up to which all are as high.
    [[nodiscard]] std::size_t best_fall(std::size_t row) const {
        const std::size_t after = after_short_[row].row;
        const std::size_t earliest =
            std::max(steps_.empty() ? 0 : steps_.back().at, row > kNear ? row - kNear : 0);
        double most_ns = 0.0;
        for (std::size_t i = row; i > earliest && before_[i].count >= kMany; --i) {
            most_ns = std::max(most_ns, rise(after, before_[i].row));
        }
        while (row > earliest + 1 && rise(after, before_[row].row) < kWhole * most_ns) {
            --row;
        }
        return row;
    }

    /// Notes a step, and looks back no further than to it; the rows up to `now` are known already.
    void begin_at(std::size_t row, std::size_t now) {
        steps_.push_back({row, 0});
        before_short_.clear();
        before_long_.clear();
        for (std::size_t i = row; i < now; ++i) {
            before_short_.add(i);
            before_long_.add(i);
        }
    }

    /// Compares what is next to a step, up to the steps beside it.
    void measure() {
        for (std::size_t s = 0; s < steps_.size(); ++s) {
            const std::size_t at = steps_[s].at;
            Lowest before(rows_, trend_.slope, kShort_ns);
            const std::size_t earliest = s == 0 ? 0 : steps_[s - 1].at;
            for (std::size_t i = at; i > earliest && is_near(i - 1, at - 1); --i) {
                before.add(i - 1);
            }
            Lowest after(rows_, trend_.slope, kShort_ns);
            const std::size_t end = s + 1 < steps_.size() ? steps_[s + 1].at : rows_.size();
            for (std::size_t i = at; i < end && is_near(i, at); ++i) {
                after.add(i);
            }
            steps_[s].by_ns = static_cast<Wide>(rise(before.row(), after.row()));
        }
    }
    [[nodiscard]] bool is_near(std::size_t row, std::size_t to) const {
        return std::abs(rows_[row].device_ns - rows_[to].device_ns) <= kShort_ns;
    }

    std::span<const LagRow> rows_;
    const LagTrend& trend_;
    double resolution_ns_;
    double few_rows_ns_;
    memory::LongVector<Side> after_short_;
    memory::LongVector<Side> after_long_;
    memory::LongVector<Side> before_;  ///< long, as it was at each row
    Lowest before_short_;
    Lowest before_long_;
    memory::LongVector<LagStep> steps_;
};

}  // namespace

LagTrend lag_trend(std::span<const LagRow> rows) {
    // What crystals differ by, and a host's clock that is slewed.
    constexpr double kUnknown = 300e-6;
    constexpr double kDrift = 50e-6;
    constexpr std::size_t kFewest = 8;
    LagTrend trend{.uncertainty = kUnknown};
    const Seconds seconds = seconds_of(rows);
    const memory::LongVector<std::size_t>& lowest = seconds.lowest;
    trend.span_ns = seconds.span_ns;
    const auto rise = [&](std::size_t from, std::size_t to) {
        return static_cast<double>(rows[to].lag_ns - rows[from].lag_ns);
    };
    const auto apart = [&](std::size_t from, std::size_t to) {
        return static_cast<double>(rows[to].device_ns - rows[from].device_ns);
    };
    const std::size_t reach = std::max<std::size_t>(1, lowest.size() / kFewest);
    if (lowest.size() >= kFewest) {
        memory::LongVector<double> slopes;
        for (std::size_t i = reach; i < lowest.size(); ++i) {
            slopes.push_back(rise(lowest[i - reach], lowest[i]) /
                             apart(lowest[i - reach], lowest[i]));
        }
        trend.slope = median(slopes);
        trend.known = true;
    }
    memory::LongVector<double> differences;
    for (std::size_t i = 1; i < lowest.size(); ++i) {
        differences.push_back(std::abs(rise(lowest[i - 1], lowest[i]) -
                                       trend.slope * apart(lowest[i - 1], lowest[i])));
    }
    trend.noise_ns = median(differences);
    memory::LongVector<double> heights;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t least = lowest[seconds.of_row[i]];
        heights.push_back(rise(least, i) - trend.slope * apart(least, i));
    }
    // The mean over the median of an exponential distribution is 1 / ln 2.
    trend.height_ns = std::max(0.0, std::numbers::log2e * median(heights));
    if (trend.known) {
        trend.uncertainty = kDrift + trend.noise_ns / (static_cast<double>(reach) *
                                                       static_cast<double>(kSecond_ns));
    }
    return trend;
}

memory::LongVector<LagStep> lag_steps(std::span<const LagRow> rows, const LagTrend& trend,
                                      double resolution_ns, double few_rows_ns) {
    return StepSearch(rows, trend, resolution_ns, few_rows_ns).run();
}

}  // namespace gazeloop::drivers
