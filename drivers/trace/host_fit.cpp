#include "drivers/trace/host_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <utility>

#include "drivers/trace/clock_chain.h"
#include "drivers/trace/counter_wrap.h"
#include "drivers/trace/time_text.h"
#include "runtime/time/clock_fit.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1000 * kMillisecond_ns;
/// What ClockFit's line rests on, without gaps; it is best in the middle.
constexpr std::int64_t kWindow_ns = 16 * kSecond_ns;
/// After a longer gap ClockFit begins anew.
constexpr std::int64_t kFitForgets_ns = 120 * kSecond_ns;

/// A stretch of rows [first, end) over which neither clock was set.
struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
    bool by_host = false;  ///< the host's clock says how long after the stretch before it begins
};

/// Host time less device time, over device time. From `base_ns`.
struct Knot {
    std::int64_t device_ns = 0;
    double lag_ns = 0.0;
};
struct Line {
    bool known = false;
    Wide base_ns = 0;
    std::vector<Knot> knots;  ///< ascending; none: `slope` from the stretch's first row
    std::int64_t origin_ns = 0;
    double slope = 0.0;
    std::int64_t within_ns = 0;  ///< 0: not known
    bool steep = false;          ///< more so than the uncertainty explains

    [[nodiscard]] double at(std::int64_t device_ns) const {
        if (knots.size() < 2) {
            return slope * static_cast<double>(device_ns - origin_ns);
        }
        auto after =
            std::upper_bound(knots.begin(), knots.end(), device_ns,
                             [](std::int64_t ns, const Knot& knot) { return ns < knot.device_ns; });
        after = std::clamp(after, knots.begin() + 1, knots.end() - 1);
        const Knot& a = *std::prev(after);
        const Knot& b = *after;
        return a.lag_ns + (b.lag_ns - a.lag_ns) * (static_cast<double>(device_ns - a.device_ns) /
                                                   static_cast<double>(b.device_ns - a.device_ns));
    }
};

class Fitting {
  public:
    Fitting(const DeviceTimes& device, std::span<const std::optional<std::int64_t>> host_ns,
            std::span<const std::uint64_t> lines)
        : device_(device), host_ns_(host_ns), lines_(lines) {}

    HostFit run() {
        for (std::size_t i = 0; i < host_ns_.size(); ++i) {
            if (host_ns_[i]) {
                used_.push_back(i);
            }
        }
        leave_out_outliers();
        fit_.time_ns = device_.time_ns;
        fit_.delay_ns.assign(device_.time_ns.size(), std::nullopt);
        if (used_.size() < 2) {
            fit_.text =
                used_.empty() ? "the device's; no host times" : "the device's; one host time";
            if (!used_.empty()) {
                fit_.delay_ns[used_.front()] = 0;
            }
            return std::move(fit_);
        }
        find_stretches();
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            lines_of_stretches_.push_back(line_of(s));  // may split the stretch
        }
        settle_lines();
        lay_out();
        describe();
        return std::move(fit_);
    }

  private:
    [[nodiscard]] Wide lag(std::size_t row) const {
        return static_cast<Wide>(*host_ns_[row]) - device_.time_ns[row];
    }
    /// By how much more the host's clock went on than the device's.
    [[nodiscard]] Wide excess(std::size_t before, std::size_t after) const {
        return lag(after) - lag(before);
    }
    [[nodiscard]] Wide elapsed(std::size_t before, std::size_t after) const {
        return static_cast<Wide>(*host_ns_[after]) - *host_ns_[before];
    }
    [[nodiscard]] std::int64_t jitter_ns() const {
        constexpr std::int64_t kIntervals = 8;
        return std::max(time::saturated(static_cast<Wide>(kIntervals) * device_.interval_ns),
                        50 * kMillisecond_ns);
    }

    void leave_out_outliers() {
        constexpr Wide kDay_ns = Wide{86'400} * kSecond_ns;
        const ClockSteps steps{
            .joins =
                [&](std::size_t before, std::size_t after) {
                    const Wide more = excess(used_[before], used_[after]);
                    return more >= -jitter_ns() && more <= jitter_ns();
                },
            .doubt =
                [&](std::size_t before, std::size_t after) {
                    const bool impossible =
                        elapsed(used_[before], used_[after]) < -static_cast<Wide>(jitter_ns()) ||
                        excess(used_[before], used_[after]) > kDay_ns;
                    return impossible ? kImpossibleStep : 0.0;
                },
        };
        std::vector<bool> kept = readings_in_step(used_.size(), steps);
        constexpr std::size_t kFewest = 16;
        constexpr std::int64_t kLatest_ns = 10 * kSecond_ns;
        if (used_.size() >= kFewest) {
            kept.front() = kept.front() && excess(used_[0], used_[1]) <= kLatest_ns;
            kept.back() = kept.back() &&
                          excess(used_[used_.size() - 2], used_[used_.size() - 1]) <= kLatest_ns;
        }
        std::vector<std::size_t> left;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (kept[i]) {
                left.push_back(used_[i]);
            }
        }
        fit_.outliers = used_.size() - left.size();
        used_ = std::move(left);
    }

    /// Whether the device's clock was set after one row and not after another.
    [[nodiscard]] bool is_set_in(std::size_t before, std::size_t after) const {
        const auto set = std::upper_bound(device_.sets.begin(), device_.sets.end(), before);
        return set != device_.sets.end() && *set <= after;
    }

    /// Whether one row and the next of used_ are of two stretches at any rate.
    [[nodiscard]] bool is_cut(std::size_t before, std::size_t after) const {
        return is_set_in(before, after) || elapsed(before, after) < -static_cast<Wide>(jitter_ns());
    }

    /// The least lag of some rows that follow one another, as some come and others go.
    class Lowest {
      public:
        void add(std::int64_t device_ns, Wide lag_ns) {
            while (!rising_.empty() && rising_.back().lag_ns >= lag_ns) {
                rising_.pop_back();
            }
            rising_.push_back({device_ns, lag_ns});
            ++count_;
        }
        /// Forgets rows that are more than 10 s away.
        void forget_far_from(std::int64_t device_ns) {
            while (std::abs(rising_.front().device_ns - device_ns) > kAround_ns) {
                rising_.pop_front();
            }
        }
        void clear() {
            rising_.clear();
            count_ = 0;
        }
        [[nodiscard]] bool rests_on_many() const { return count_ >= kMany; }
        [[nodiscard]] Wide lag_ns() const { return rising_.front().lag_ns; }

      private:
        static constexpr std::int64_t kAround_ns = 10 * kSecond_ns;
        static constexpr std::size_t kMany = 8;
        struct Row {
            std::int64_t device_ns;
            Wide lag_ns;
        };
        std::deque<Row> rising_;
        std::size_t count_ = 0;  ///< since it was cleared
    };

    struct After {
        Wide lag_ns = 0;  ///< the least of 10 s from here on
        bool many = false;
    };

    [[nodiscard]] std::vector<After> lowest_after() const {
        std::vector<After> after(used_.size());
        Lowest lowest;
        for (std::size_t i = used_.size(); i-- > 0;) {
            if (i + 1 < used_.size() && is_cut(used_[i], used_[i + 1])) {
                lowest.clear();
            }
            lowest.add(device_.time_ns[used_[i]], lag(used_[i]));
            lowest.forget_far_from(device_.time_ns[used_[i]]);
            after[i] = {lowest.lag_ns(), lowest.rests_on_many()};
        }
        return after;
    }

    /// Where lags are lower, or higher, from some row on than they were before, a clock was set. A
    /// host that is late is in time again sooner or later.
    void find_stretches() {
        constexpr std::int64_t kShortest_ns = 10 * kMillisecond_ns;
        std::vector<Stretch> stretches;
        stretches.reserve(device_.sets.size());
        for (const std::size_t set : device_.sets) {
            stretches.push_back({set, 0, true});
        }
        const std::vector<After> after = lowest_after();
        Lowest lowest;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            const std::size_t now = used_[i];
            const std::int64_t now_ns = device_.time_ns[now];
            if (i > 0) {
                const std::size_t before = used_[i - 1];
                const std::int64_t went_on_ns = now_ns - device_.time_ns[before];
                const bool many = lowest.rests_on_many() && after[i].many;
                const std::int64_t tolerance_ns =
                    (many ? kShortest_ns : 2 * jitter_ns()) + went_on_ns / 1000;
                const auto is_more = [&](Wide ns) {
                    return ns > tolerance_ns || ns < -static_cast<Wide>(tolerance_ns);
                };
                if (is_more(excess(before, now)) && is_more(after[i].lag_ns - lowest.lag_ns())) {
                    note_step(before, now, after[i].lag_ns - lowest.lag_ns(), stretches);
                    lowest.clear();
                } else if (is_cut(before, now)) {
                    lowest.clear();
                }
            }
            lowest.add(now_ns, lag(now));
            lowest.forget_far_from(now_ns);
        }
        std::sort(stretches.begin(), stretches.end(),
                  [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
        fit_.steps = stretches.size();
        stretches_.push_back({0, device_.time_ns.size(), false});
        for (const Stretch& stretch : stretches) {
            split_at(stretches_.size() - 1, stretch.first, stretch.by_host);
        }
    }

    void note_step(std::size_t before, std::size_t now, Wide by_ns,
                   std::vector<Stretch>& stretches) {
        if (is_set_in(before, now)) {
            // Both were set: what the host's clock says of the time between is worth nothing.
            for (Stretch& stretch : stretches) {
                stretch.by_host &= stretch.first <= before || stretch.first > now;
            }
            report_host_set(now, by_ns);
        } else {
            stretches.push_back({now, 0, report_step(before, now, by_ns)});
        }
    }

    void split_at(std::size_t stretch, std::size_t row, bool by_host) {
        const std::size_t end = std::exchange(stretches_[stretch].end, row);
        stretches_.insert(stretches_.begin() + static_cast<std::ptrdiff_t>(stretch) + 1,
                          {row, end, by_host});
    }

    void report_host_set(std::size_t row, Wide by_ns) {
        const std::int64_t by = time::saturated(by_ns);
        fit_.findings.push_back(
            {.kind = TraceFindingKind::HostClockSet,
             .line = lines_[row],
             .rows = 1,
             .dropped = 0,
             .span_ns = by,
             .text = fmt::format("the host's clock steps {} by {}: times go on by the device's "
                                 "clock, and both are fitted anew",
                                 by < 0 ? "back" : "ahead", in_words(by))});
    }

    /// Fits the stretch, and splits it where the fit sees that a clock was set.
    Line line_of(std::size_t s) {
        const std::size_t first_row = stretches_[s].first;
        const auto from = std::lower_bound(used_.begin(), used_.end(), first_row);
        const auto to = std::lower_bound(from, used_.end(), stretches_[s].end);
        Line line;
        line.origin_ns = device_.time_ns[first_row];
        std::vector<std::size_t> fed;
        for (auto row = from; row != to; ++row) {
            if (!device_.reckoned[*row]) {
                fed.push_back(*row);
            }
        }
        if (fed.empty()) {
            if (from != to) {
                line.known = true;
                line.base_ns = lag(*from);
            }
            return line;
        }
        line.known = true;
        line.base_ns = lag(fed.front());

        time::ClockFit fit;
        std::int64_t window_from_ns = device_.time_ns[fed.front()];
        std::optional<Knot> last;
        double last_slope = 0.0;
        const auto lag_of_fit = [&](std::int64_t device_ns) {
            const double slope = fit.skew_ppm() * 1e-6;
            const auto from_last = static_cast<double>(device_ns - last->device_ns);
            return last->lag_ns + slope * from_last;
        };
        for (std::size_t i = 0; i < fed.size(); ++i) {
            const std::int64_t device_ns = device_.time_ns[fed[i]];
            // As the fit has it, host times are those since the stretch's first.
            const std::int64_t arrived_ns = time::saturated(lag(fed[i]) - line.base_ns + device_ns);
            if (i > 0 && device_ns - device_.time_ns[fed[i - 1]] > kFitForgets_ns) {
                window_from_ns = device_ns;
            }
            const time::ClockReading reading = fit.add(device_ns, arrived_ns);
            if (reading.stepped) {
                if (const std::size_t at = step_in(fed, i); at > 0) {
                    const bool device_set =
                        report_step(fed[at - 1], fed[at], excess(fed[at - 1], fed[at]));
                    split_at(s, fed[at], device_set);
                    ++fit_.steps;
                    break;
                }
            }
            if (reading.verdict == time::ClockVerdict::Unusable) {
                continue;
            }
            last = Knot{device_ns, static_cast<double>(fit.offset_ns())};
            last_slope = fit.skew_ppm() * 1e-6;
            line.within_ns = reading.uncertainty_ns;
            const std::int64_t middle_ns = device_ns - kWindow_ns / 2;
            const bool is_due =
                line.knots.empty() || middle_ns - line.knots.back().device_ns >= kWindow_ns / 2;
            if (device_ns - window_from_ns >= kWindow_ns && is_due) {
                if (line.knots.empty()) {
                    line.knots.push_back({line.origin_ns, lag_of_fit(line.origin_ns)});
                }
                if (middle_ns > line.knots.back().device_ns) {
                    line.knots.push_back({middle_ns, lag_of_fit(middle_ns)});
                }
            }
        }
        if (last) {
            if (line.knots.empty() && last->device_ns > line.origin_ns) {
                const auto length_ns = static_cast<double>(last->device_ns - line.origin_ns);
                line.knots.push_back({line.origin_ns, last->lag_ns - last_slope * length_ns});
            }
            if (!line.knots.empty() && last->device_ns > line.knots.back().device_ns) {
                line.knots.push_back(*last);
            }
        }
        if (line.knots.size() >= 2) {
            const auto [least, most] = std::minmax_element(
                line.knots.begin(), line.knots.end(),
                [](const Knot& a, const Knot& b) { return a.lag_ns < b.lag_ns; });
            // Twice, for two knots; and a long trace has many, of which the odd one is off.
            constexpr double kNone_ns = 50e3;
            line.steep = most->lag_ns - least->lag_ns >
                         std::max(2.0 * static_cast<double>(line.within_ns), kNone_ns);
        }
        return line;
    }

    /// Of the rows fed up to the `now`th: where the lag jumps most among the last few, which is
    /// where a clock was set. 0: nowhere.
    [[nodiscard]] std::size_t step_in(const std::vector<std::size_t>& fed, std::size_t now) const {
        constexpr std::size_t kLast = 12;
        std::size_t at = 0;
        Wide most = 0;
        for (std::size_t i = now; i > 0 && now - i < kLast; --i) {
            const Wide more = excess(fed[i - 1], fed[i]);
            const Wide jump = more < 0 ? -more : more;
            if (jump > most) {
                most = jump;
                at = i;
            }
        }
        return at;
    }

    /// The clock that was set is the one whose step is less usual; a gap is none that was set.
    /// Whether it is the device's.
    bool report_step(std::size_t before, std::size_t now, Wide by_ns) {
        constexpr Wide kGapIntervals = 8;
        const auto off = [&](Wide step_ns) {
            const Wide off_ns = step_ns - device_.interval_ns;
            return off_ns < 0 ? -off_ns : off_ns;
        };
        const Wide went_on_ns = device_.time_ns[now] - device_.time_ns[before];
        const auto rows = static_cast<Wide>(now - before);
        const bool device_set = went_on_ns <= (kGapIntervals + rows) * device_.interval_ns &&
                                off(went_on_ns) > off(elapsed(before, now));
        if (!device_set) {
            report_host_set(now, by_ns);
            return false;
        }
        const std::int64_t by = time::saturated(-by_ns);
        fit_.findings.push_back(
            {.kind = TraceFindingKind::DeviceClockSet,
             .line = lines_[now],
             .rows = 1,
             .dropped = 0,
             .span_ns = by,
             .text = fmt::format("the device's clock steps {} by {}: times go on by the host's "
                                 "clock",
                                 by < 0 ? "back" : "ahead", in_words(by))});
        return true;
    }

    /// Stretches too short to show a skew get that of the longest that does. All lines end up below
    /// the rows' lags, where the quickest touches them.
    void settle_lines() {
        const Line* longest = nullptr;
        std::int64_t longest_ns = -1;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            const std::int64_t length_ns =
                device_.time_ns[stretches_[s].end - 1] - device_.time_ns[stretches_[s].first];
            const Line& line = lines_of_stretches_[s];
            if (line.steep && length_ns > longest_ns) {
                longest_ns = length_ns;
                longest = &line;
            }
        }
        double slope = 0.0;
        if (longest != nullptr) {
            const Knot& a = longest->knots.front();
            const Knot& b = longest->knots.back();
            slope = (b.lag_ns - a.lag_ns) / static_cast<double>(b.device_ns - a.device_ns);
        }
        fit_.skew_ppm = slope * 1e6;
        std::int64_t widest_ns = 0;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            Line& line = lines_of_stretches_[s];
            widest_ns = std::max(widest_ns, line.within_ns);
            if (!line.steep) {
                line.knots.clear();
                line.slope = slope;
            }
            lower(line, stretches_[s]);
        }
        fit_.within_ns = longest != nullptr ? longest->within_ns : widest_ns;
    }

    void lower(Line& line, const Stretch& stretch) const {
        std::optional<Wide> least;
        const auto from = std::lower_bound(used_.begin(), used_.end(), stretch.first);
        const auto to = std::lower_bound(from, used_.end(), stretch.end);
        for (auto row = from; row != to; ++row) {
            const Wide above = above_line(line, *row);
            least = std::min(least.value_or(above), above);
        }
        line.base_ns += least.value_or(0);
    }

    [[nodiscard]] Wide above_line(const Line& line, std::size_t row) const {
        return lag(row) - line.base_ns - std::llround(line.at(device_.time_ns[row]));
    }

    void lay_out() {
        Wide shift = 0;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            const Stretch& stretch = stretches_[s];
            const Line& line = lines_of_stretches_[s];
            const auto raw = [&](std::size_t row) {
                const std::int64_t device_ns = device_.time_ns[row];
                return static_cast<Wide>(device_ns) + std::llround(line.at(device_ns));
            };
            if (s == 0) {
                shift = -raw(0);
            } else {
                const Line& before = lines_of_stretches_[s - 1];
                const std::size_t last = stretch.first - 1;
                if (stretch.by_host && line.known && before.known) {
                    shift += line.base_ns - before.base_ns;
                } else {
                    const std::int64_t step_ns =
                        device_.time_ns[stretch.first] - device_.time_ns[last];
                    const double skewed = static_cast<double>(step_ns) * fit_.skew_ppm * 1e-6;
                    shift = fit_.time_ns[last] + static_cast<Wide>(step_ns) + std::llround(skewed) -
                            raw(stretch.first);
                }
                const Wide earliest = static_cast<Wide>(fit_.time_ns[last]) +
                                      std::max<std::int64_t>(1, device_.interval_ns / 4);
                shift += std::max<Wide>(0, earliest - (raw(stretch.first) + shift));
            }
            for (std::size_t row = stretch.first; row < stretch.end; ++row) {
                Wide at = raw(row) + shift;
                if (row > 0) {
                    at = std::max(at, static_cast<Wide>(fit_.time_ns[row - 1]) + 1);
                }
                fit_.time_ns[row] = time::saturated(at);
            }
        }
        std::size_t s = 0;
        for (const std::size_t row : used_) {
            while (row >= stretches_[s].end) {
                ++s;
            }
            fit_.delay_ns[row] =
                time::saturated(std::max<Wide>(0, above_line(lines_of_stretches_[s], row)));
        }
    }

    void describe() {
        fit_.text = fit_.skew_ppm == 0.0
                        ? "fitted to the host's clock: the same rate"
                        : fmt::format("fitted to the host's clock: {:+.0f} ppm", fit_.skew_ppm);
        if (fit_.within_ns > 0) {
            fit_.text +=
                fmt::format(", within {:.2f} ms", static_cast<double>(fit_.within_ns) * 1e-6);
        }
        if (fit_.steps > 0) {
            fit_.text += fmt::format(", {} {}", fit_.steps, fit_.steps == 1 ? "step" : "steps");
        }
        if (fit_.outliers > 0) {
            fit_.text += fmt::format(", {} host {} left out", fit_.outliers,
                                     fit_.outliers == 1 ? "time" : "times");
        }
    }

    const DeviceTimes& device_;
    std::span<const std::optional<std::int64_t>> host_ns_;
    std::span<const std::uint64_t> lines_;
    std::vector<std::size_t> used_;  ///< rows whose host time is used
    std::vector<Stretch> stretches_;
    std::vector<Line> lines_of_stretches_;
    HostFit fit_;
};

}  // namespace

HostFit fit_to_host(const DeviceTimes& device, std::span<const std::optional<std::int64_t>> host_ns,
                    std::span<const std::uint64_t> lines) {
    return Fitting(device, host_ns, lines).run();
}

}  // namespace gazeloop::drivers
