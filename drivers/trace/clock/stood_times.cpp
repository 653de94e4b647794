#include "drivers/trace/clock/stood_times.h"

#include <algorithm>
#include <cmath>

#include "drivers/trace/clock/clock_chain.h"
#include "drivers/trace/clock/counter_wrap.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

constexpr double kMillisecond_ns = 1e6;
constexpr double kDay_ns = 86'400e9;
/// Host times of rows this far apart tell the interval.
constexpr std::size_t kReach = 32;
/// A report that waited is in time again after so many rows.
constexpr std::size_t kLatest = 64;
/// Rows that a gap must have behind it.
constexpr std::size_t kFewestBehind = 4;

using HostTimes = std::span<const std::optional<std::int64_t>>;

memory::LongVector<std::size_t> known(HostTimes host_ns) {
    memory::LongVector<std::size_t> rows;
    for (std::size_t i = 0; i < host_ns.size(); ++i) {
        if (host_ns[i]) {
            rows.push_back(i);
        }
    }
    return rows;
}

double median_interval_ns(HostTimes host_ns, const memory::LongVector<std::size_t>& rows) {
    memory::LongVector<double> intervals;
    const std::size_t reach = std::min(kReach, rows.size() / 2);
    for (std::size_t i = reach; reach > 0 && i < rows.size(); ++i) {
        const Wide step = static_cast<Wide>(*host_ns[rows[i]]) - *host_ns[rows[i - reach]];
        if (step > 0) {
            intervals.push_back(static_cast<double>(step) /
                                static_cast<double>(rows[i] - rows[i - reach]));
        }
    }
    if (intervals.empty()) {
        return 0.0;
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>((intervals.size() - 1) / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
}

double interval_or(double interval_ns, std::int64_t usual_ns) {
    return std::min(interval_ns > 0.0 ? interval_ns : static_cast<double>(usual_ns), kDay_ns);
}

/// Rows that a line at one interval lies below.
class Following {
  public:
    Following(HostTimes host_ns, std::int64_t usual_ns)
        : host_ns_(host_ns),
          used_(known(host_ns)),
          interval_ns_(interval_or(median_interval_ns(host_ns, used_), usual_ns)),
          tolerance_ns_(std::max(50.0 * kMillisecond_ns, 8.0 * interval_ns_)) {}

    StoodTimes run(std::int64_t usual_ns) {
        leave_out_outliers();
        StoodTimes times;
        times.by_host = used_.size() >= 2;
        if (!times.by_host) {
            interval_ns_ = static_cast<double>(usual_ns);
        }
        memory::LongVector<Jump> jumps(host_ns_.size());
        if (times.by_host) {
            find_jumps(jumps);
            refine_interval(jumps);
        }
        double jumped_ns = 0.0;
        for (std::size_t i = 0; i < host_ns_.size(); ++i) {
            jumped_ns += jumps[i].went_by_ns;
            constexpr double kLongest_ns = 9e18;
            times.since_ns.push_back(std::llround(
                std::min(static_cast<double>(i) * interval_ns_ + jumped_ns, kLongest_ns)));
        }
        return times;
    }

  private:
    /// Before a row, beside the interval.
    struct Jump {
        double host_ns = 0.0;     ///< by the host's clock
        double went_by_ns = 0.0;  ///< less where that clock was set
    };

    /// How late a row is by the host's clock, if rows follow at the interval.
    [[nodiscard]] double late_ns(std::size_t i) const {
        const std::size_t row = used_[i];
        return static_cast<double>(static_cast<Wide>(*host_ns_[row]) - *host_ns_[used_.front()]) -
               interval_ns_ * static_cast<double>(row - used_.front());
    }

    void leave_out_outliers() {
        const ClockSteps steps{
            .joins =
                [this](std::size_t before, std::size_t after) {
                    return std::abs(late_ns(after) - late_ns(before)) <= tolerance_ns_;
                },
            .doubt =
                [this](std::size_t before, std::size_t after) {
                    const double more_ns = late_ns(after) - late_ns(before);
                    return more_ns < -tolerance_ns_ || more_ns > kDay_ns ? kImpossibleStep : 0.0;
                },
        };
        const memory::LongVector<bool> kept = readings_in_step(used_.size(), steps);
        memory::LongVector<std::size_t> left;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (kept[i]) {
                left.push_back(used_[i]);
            }
        }
        used_ = std::move(left);
    }

    /// The least lateness of a row and those that follow it.
    [[nodiscard]] memory::LongVector<double> least_after() const {
        memory::LongVector<double> least(used_.size());
        for (std::size_t i = 0; i < used_.size(); ++i) {
            least[i] = late_ns(i);
            const std::size_t end = std::min(i + kLatest, used_.size());
            for (std::size_t k = i + 1; k < end; ++k) {
                least[i] = std::min(least[i], late_ns(k));
            }
        }
        return least;
    }

    void find_jumps(memory::LongVector<Jump>& jumps) const {
        const memory::LongVector<double> least = least_after();
        std::size_t since = 0;  // the last jump
        for (std::size_t i = 1; i < used_.size(); ++i) {
            double before_ns = late_ns(i - 1);
            for (std::size_t k = i - 1; k > since && i - k < kLatest; --k) {
                before_ns = std::min(before_ns, late_ns(k - 1));
            }
            const double by_ns = least[i] - before_ns;
            const bool back = late_ns(i) < before_ns - tolerance_ns_;
            if (back || (by_ns > tolerance_ns_ && used_.size() - i >= kFewestBehind)) {
                jumps[used_[i]] = {by_ns, back || by_ns > kDay_ns ? 0.0 : by_ns};
                since = i;
            }
        }
    }

    /// By the lowest of the first and the last quarter of the rows.
    void refine_interval(const memory::LongVector<Jump>& jumps) {
        constexpr std::size_t kFewest = 64;
        if (used_.size() < kFewest) {
            return;
        }
        memory::LongVector<double> late;
        double jumped_ns = 0.0;
        std::size_t row = 0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            for (; row <= used_[i]; ++row) {
                jumped_ns += jumps[row].host_ns;
            }
            late.push_back(late_ns(i) - jumped_ns);
        }
        const auto quarter = static_cast<std::ptrdiff_t>(late.size() / 4);
        const auto first = std::min_element(late.begin(), late.begin() + quarter);
        const auto last = std::min_element(late.end() - quarter, late.end());
        const std::size_t from = used_[static_cast<std::size_t>(first - late.begin())];
        const std::size_t to = used_[static_cast<std::size_t>(last - late.begin())];
        interval_ns_ = std::clamp(interval_ns_ + (*last - *first) / static_cast<double>(to - from),
                                  0.0, kDay_ns);
    }

    HostTimes host_ns_;
    memory::LongVector<std::size_t> used_;
    double interval_ns_;
    double tolerance_ns_;
};

}  // namespace

std::int64_t host_interval_ns(HostTimes host_ns) {
    return std::llround(std::min(median_interval_ns(host_ns, known(host_ns)), kDay_ns));
}

StoodTimes stood_times(HostTimes host_ns, std::int64_t interval_ns) {
    return Following(host_ns, interval_ns).run(interval_ns);
}

}  // namespace gazeloop::drivers
