#include "drivers/trace/clock/host_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "drivers/trace/clock/clock_pair.h"
#include "drivers/trace/clock/host_times.h"
#include "drivers/trace/clock/lag_line.h"
#include "drivers/trace/clock/lag_steps.h"
#include "drivers/trace/clock/time_text.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// A stretch of rows [first, end) over which neither clock was set.
struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
    bool by_host = false;  ///< the host's clock says how long after the stretch before it begins
};

class Fitting {
  public:
    Fitting(const DeviceTimes& device, std::span<const std::optional<std::int64_t>> host_ns,
            std::span<const std::uint64_t> lines)
        : device_(device), clocks_{device, host_ns}, lines_(lines) {}

    HostFit run() {
        fit_.time_ns = device_.time_ns;
        fit_.delay_ns.assign(device_.time_ns.size(), std::nullopt);
        if (device_.by_host) {
            fit_.text = "the host's; no row has a reading of the device's clock";
            return std::move(fit_);
        }
        HostTimes host = host_times(clocks_, lines_);
        used_ = std::move(host.rows);
        fit_.outliers = host.outliers;
        fit_.findings = std::move(host.findings);
        if (used_.size() < 2) {
            fit_.text = host.stood      ? "the device's; the host's stood still"
                        : used_.empty() ? "the device's; no host times"
                                        : "the device's; one host time";
            if (!used_.empty() && !host.stood) {
                fit_.delay_ns[used_.front()] = 0;
            }
            return std::move(fit_);
        }
        take_lags();
        if (!rates_agree()) {
            return std::move(fit_);
        }
        find_stretches();
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            lines_of_stretches_.push_back(line_of(s));
        }
        settle_lines();
        lay_out();
        if (!is_likely()) {
            return std::move(fit_);
        }
        describe();
        return std::move(fit_);
    }

  private:
    /// Whether one row and the next of used_ are of two stretches at any rate.
    [[nodiscard]] bool is_cut(std::size_t before, std::size_t after) const {
        return clocks_.is_set_in(before, after) ||
               clocks_.elapsed(before, after) < -static_cast<Wide>(clocks_.jitter_ns());
    }

    void take_lags() {
        for (std::size_t i = 0; i < used_.size(); ++i) {
            lags_.push_back({device_.time_ns[used_[i]], clocks_.lag(used_[i]),
                             i > 0 && is_cut(used_[i - 1], used_[i])});
        }
        trend_ = lag_trend(lags_);
    }

    /// Whether the clocks go at one rate, as two crystals do. Else the device's is taken alone.
    bool rates_agree() {
        constexpr double kGreatest = 1000e-6;
        const double rough = rough_slope();
        fit_.absurd_rates = is_absurd(1.0 + rough);
        if (fit_.absurd_rates || (!trend_.known && std::abs(rough) > kGreatest)) {
            fit_.host_per_device = 1.0 + rough;
        } else if (trend_.known && std::abs(trend_.slope) > kGreatest + trend_.uncertainty) {
            fit_.host_per_device = 1.0 + trend_.slope;
        } else {
            return true;
        }
        const double ratio = fit_.host_per_device;
        const std::string faster =
            is_absurd(ratio) ? (ratio > 1.0 ? fmt::format("{:.0f} times as fast as", ratio)
                                            : fmt::format("{:.0f} times slower than", 1.0 / ratio))
                             : fmt::format("{:.2g} % {} than", std::abs(ratio - 1.0) * 100.0,
                                           ratio > 1.0 ? "faster" : "slower");
        fit_.text = fmt::format("the device's; the host's goes {} it", faster);
        fit_.findings.push_back(
            {.kind = TraceFindingKind::ClockRates,
             .line = lines_[used_.front()],
             .rows = used_.size(),
             .dropped = 0,
             .span_ns = device_.time_ns.back(),
             .text = fmt::format("the host's clock goes {} the device's, and no crystals differ by "
                                 "so much: times are the device's alone; give the times of both "
                                 "clocks in nanoseconds",
                                 faster)});
        return false;
    }

    /// Twice as fast or half, give or take what jitter makes of it.
    [[nodiscard]] static bool is_absurd(double ratio) {
        constexpr double kTwice = 1.9;
        return ratio > kTwice || ratio < 1.0 / kTwice;
    }

    /// The lag's slope however short the trace: the median over rows a quarter of them apart. 0
    /// where these do not agree, as on both sides of a step, or where the lag changes by no more
    /// than the way to the host may.
    [[nodiscard]] double rough_slope() const {
        constexpr std::size_t kFewest = 16;
        constexpr double kDelaysChange_ns = 10e6;
        if (used_.size() < kFewest) {
            return 0.0;
        }
        const std::size_t apart = used_.size() / 4;
        memory::LongVector<double> slopes;
        for (std::size_t i = apart; i < used_.size(); ++i) {
            const std::int64_t device_ns =
                device_.time_ns[used_[i]] - device_.time_ns[used_[i - apart]];
            slopes.push_back(static_cast<double>(clocks_.excess(used_[i - apart], used_[i])) /
                             static_cast<double>(device_ns));
        }
        std::sort(slopes.begin(), slopes.end());
        const double middle = slopes[slopes.size() / 2];
        const double lower = slopes[slopes.size() / 8];
        const double upper = slopes[slopes.size() - 1 - slopes.size() / 8];
        const std::int64_t span_ns = device_.time_ns[used_.back()] - device_.time_ns[used_.front()];
        const bool agree = upper - lower < std::abs(middle) / 2.0;
        const bool is_more = std::abs(middle) * static_cast<double>(span_ns) >
                             kDelaysChange_ns + static_cast<double>(device_.interval_ns);
        return agree && is_more ? middle : 0.0;
    }

    /// The steps in which the clocks count, where these are seen.
    [[nodiscard]] double resolution_ns() const {
        constexpr std::int64_t kFine_ns = kMillisecond_ns / 10;
        std::int64_t host_ns = 0;
        bool repeats = false;
        memory::LongVector<std::int64_t> device_ns{device_.step_ns[used_.front()]};
        for (std::size_t i = 1; i < used_.size(); ++i) {
            const Wide step = clocks_.elapsed(used_[i - 1], used_[i]);
            host_ns = std::gcd(host_ns, time::saturated(step < 0 ? -step : step));
            repeats |= step == 0;
            device_ns.push_back(device_.step_ns[used_[i]]);
        }
        const auto middle = device_ns.begin() + static_cast<std::ptrdiff_t>(device_ns.size() / 2);
        std::nth_element(device_ns.begin(), middle, device_ns.end());
        const bool counts = host_ns >= kFine_ns && (repeats || host_ns < device_.interval_ns);
        return static_cast<double>(counts ? host_ns : 0) + static_cast<double>(*middle);
    }

    /// Cuts the rows where a clock was set.
    void find_stretches() {
        memory::LongVector<Stretch> stretches;
        stretches.reserve(device_.sets.size());
        for (const std::size_t set : device_.sets) {
            stretches.push_back({set, 0, true});
        }
        for (const LagStep& step : lag_steps(lags_, trend_, resolution_ns(),
                                             2.0 * static_cast<double>(clocks_.jitter_ns()))) {
            const std::size_t before = used_[step.at - 1];
            const std::size_t now = used_[step.at];
            if (!clocks_.is_set_in(before, now) || is_step_over_set(before, now)) {
                note_step(before, now, step.by_ns, stretches);
            }
        }
        std::sort(stretches.begin(), stretches.end(),
                  [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
        fit_.steps = stretches.size();
        stretches_.push_back({0, device_.time_ns.size(), false});
        for (const Stretch& stretch : stretches) {
            split_at(stretches_.size() - 1, stretch.first, stretch.by_host);
        }
    }

    /// Where the device's clock was set, its times go on by the two host times there, late as these
    /// may be. So what is left is no step, unless it shows in these two.
    [[nodiscard]] bool is_step_over_set(std::size_t before, std::size_t now) const {
        const std::int64_t most_ns =
            10 * kMillisecond_ns + (device_.time_ns[now] - device_.time_ns[before]) / 1000;
        const Wide more = clocks_.excess(before, now);
        return more > most_ns || more < -static_cast<Wide>(most_ns);
    }

    void note_step(std::size_t before, std::size_t now, Wide by_ns,
                   memory::LongVector<Stretch>& stretches) {
        if (clocks_.is_set_in(before, now)) {
            // Both were set: what the host's clock says of the time between is worth nothing.
            for (Stretch& stretch : stretches) {
                stretch.by_host &= stretch.first <= before || stretch.first > now;
            }
            report_set(TraceFindingKind::HostClockSet, now, by_ns);
        } else if (const auto row = device_step_near(now, by_ns)) {
            stretches.push_back({*row, 0, true});
            report_set(TraceFindingKind::DeviceClockSet, *row, -by_ns);
        } else {
            stretches.push_back({now, 0, false});
            report_set(TraceFindingKind::HostClockSet, now, by_ns);
        }
    }

    void split_at(std::size_t stretch, std::size_t row, bool by_host) {
        const std::size_t end = std::exchange(stretches_[stretch].end, row);
        stretches_.insert(stretches_.begin() + static_cast<std::ptrdiff_t>(stretch) + 1,
                          {row, end, by_host});
    }

    void report_set(TraceFindingKind clock, std::size_t row, Wide by_ns) {
        const bool of_host = clock == TraceFindingKind::HostClockSet;
        const std::int64_t by = time::saturated(by_ns);
        fit_.findings.push_back(
            {.kind = clock,
             .line = lines_[row],
             .rows = 1,
             .dropped = 0,
             .span_ns = by,
             .text = fmt::format(
                 "the {} clock steps {} by {}: times go on by the {}",
                 of_host ? "host's" : "device's", by < 0 ? "back" : "ahead", in_words(by),
                 of_host ? "device's clock, and both are fitted anew" : "host's clock")});
    }

    /// Fits the stretch. Times that are reckoned say nothing of the device's clock.
    LagLine line_of(std::size_t s) {
        const std::int64_t origin_ns = device_.time_ns[stretches_[s].first];
        memory::LongVector<LagRow> fed;
        const auto [from, to] = used_in(stretches_[s]);
        for (auto row = from; row != to; ++row) {
            if (!device_.reckoned[*row]) {
                fed.push_back({device_.time_ns[*row], clocks_.lag(*row)});
            }
        }
        if (!fed.empty()) {
            return fit_lag_line(fed, origin_ns, trend_.known ? trend_.slope : 0.0);
        }
        LagLine line;
        line.origin_ns = origin_ns;
        if (from != to) {
            line.known = true;
            line.base_ns = clocks_.lag(*from);
        }
        return line;
    }

    /// Its rows with a host time.
    [[nodiscard]] std::pair<memory::LongVector<std::size_t>::const_iterator,
                            memory::LongVector<std::size_t>::const_iterator>
    used_in(const Stretch& stretch) const {
        const auto from = std::lower_bound(used_.begin(), used_.end(), stretch.first);
        return {from, std::lower_bound(from, used_.end(), stretch.end)};
    }

    /// Where the lag's step can be seen in the steps of the device's own readings, while the
    /// host's clock went on as usual.
    [[nodiscard]] std::optional<std::size_t> device_step_near(std::size_t row, Wide by_ns) const {
        constexpr std::size_t kNear = 12;
        const auto magnitude = [](Wide ns) { return ns < 0 ? -ns : ns; };
        std::optional<std::size_t> found;
        Wide least = magnitude(by_ns) / 2;
        const std::size_t end = std::min(row + kNear + 1, device_.time_ns.size());
        for (std::size_t i = row > kNear ? row - kNear : 1; i < end; ++i) {
            const Wide off = static_cast<Wide>(device_.time_ns[i]) - device_.time_ns[i - 1] -
                             device_.interval_ns;
            const bool host_went_on =
                !clocks_.host_ns[i] || !clocks_.host_ns[i - 1] ||
                2 * magnitude(clocks_.elapsed(i - 1, i) - device_.interval_ns) < magnitude(off);
            if (host_went_on && !device_.reckoned[i] && magnitude(off + by_ns) < least) {
                least = magnitude(off + by_ns);
                found = i;
            }
        }
        return found;
    }

    /// Stretches too short to show a skew get that of the longest that does. All lines end up below
    /// the rows' lags, where the quickest touches them.
    void settle_lines() {
        const LagLine* longest = nullptr;
        std::int64_t longest_ns = -1;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            const std::int64_t length_ns =
                device_.time_ns[stretches_[s].end - 1] - device_.time_ns[stretches_[s].first];
            const LagLine& line = lines_of_stretches_[s];
            if (line.steep && length_ns > longest_ns) {
                longest_ns = length_ns;
                longest = &line;
            }
        }
        double slope = 0.0;
        if (longest != nullptr) {
            const LagKnot& a = longest->knots.front();
            const LagKnot& b = longest->knots.back();
            slope = (b.lag_ns - a.lag_ns) / static_cast<double>(b.device_ns - a.device_ns);
        }
        fit_.skew_ppm = slope * 1e6;
        std::int64_t widest_ns = 0;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            LagLine& line = lines_of_stretches_[s];
            widest_ns = std::max(widest_ns, line.within_ns);
            if (!line.steep) {
                line.knots.clear();
                line.slope = slope;
            }
            lower(line, stretches_[s]);
        }
        fit_.within_ns = longest != nullptr ? longest->within_ns : widest_ns;
    }

    void lower(LagLine& line, const Stretch& stretch) const {
        std::optional<Wide> least;
        const auto [from, to] = used_in(stretch);
        for (auto row = from; row != to; ++row) {
            const Wide above = above_line(line, *row);
            least = std::min(least.value_or(above), above);
        }
        line.base_ns += least.value_or(0);
    }

    [[nodiscard]] Wide above_line(const LagLine& line, std::size_t row) const {
        return clocks_.lag(row) - line.base_ns - std::llround(line.at(device_.time_ns[row]));
    }

    void lay_out() {
        Wide shift = 0;
        for (std::size_t s = 0; s < stretches_.size(); ++s) {
            const Stretch& stretch = stretches_[s];
            const LagLine& line = lines_of_stretches_[s];
            const auto raw = [&](std::size_t row) {
                const std::int64_t device_ns = device_.time_ns[row];
                return static_cast<Wide>(device_ns) + std::llround(line.at(device_ns));
            };
            if (s == 0) {
                shift = -raw(0);
            } else {
                const LagLine& before = lines_of_stretches_[s - 1];
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

    /// Whether reports took the way to the host that they take. A host's clock that is set again
    /// and again, about once a second, shows no single step; the line below all rows then lies far
    /// below most. Else the device's is taken alone: of gaze that comes so late, none would count.
    bool is_likely() {
        constexpr std::int64_t kLongest_ns = 500 * kMillisecond_ns;
        constexpr std::size_t kOneOf = 10;
        const auto is_late = [&](std::size_t row) { return *fit_.delay_ns[row] > kLongest_ns; };
        const auto late = static_cast<std::size_t>(std::ranges::count_if(used_, is_late));
        if (late * kOneOf <= used_.size()) {
            return true;
        }
        const std::uint64_t first_line = lines_[*std::ranges::find_if(used_, is_late)];
        fit_.time_ns = device_.time_ns;
        fit_.delay_ns.assign(device_.time_ns.size(), std::nullopt);
        fit_.skew_ppm = 0.0;
        fit_.within_ns = 0;
        fit_.steps = 0;
        fit_.text = "the device's; by the host's reports took too long";
        fit_.findings.push_back(
            {.kind = TraceFindingKind::HostClockSet,
             .line = first_line,
             .rows = late,
             .dropped = 0,
             .span_ns = device_.time_ns.back(),
             .text =
                 fmt::format("by the host's clock {} of {} reports took over {} to the host: it "
                             "was set again and again, or stamps reports in batches; times are "
                             "the device's alone",
                             late, used_.size(), in_words(kLongest_ns))});
        return false;
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
    ClockPair clocks_;
    std::span<const std::uint64_t> lines_;
    memory::LongVector<std::size_t> used_;  ///< rows whose host time is used
    memory::LongVector<LagRow> lags_;       ///< of used_
    LagTrend trend_;
    memory::LongVector<Stretch> stretches_;
    memory::LongVector<LagLine> lines_of_stretches_;
    HostFit fit_;
};

}  // namespace

HostFit fit_to_host(const DeviceTimes& device, std::span<const std::optional<std::int64_t>> host_ns,
                    std::span<const std::uint64_t> lines) {
    return Fitting(device, host_ns, lines).run();
}

}  // namespace gazeloop::drivers
