#include "drivers/trace/host_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "drivers/trace/clock_chain.h"
#include "drivers/trace/counter_wrap.h"
#include "drivers/trace/lag_steps.h"
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
/// Gaps not counted. What a shorter stretch shows as a slope is as likely the last bit of jitter.
constexpr std::int64_t kShortestOfASlope_ns = 5 * kSecond_ns;
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
        fit_.time_ns = device_.time_ns;
        fit_.delay_ns.assign(device_.time_ns.size(), std::nullopt);
        if (device_.by_host) {
            fit_.text = "the host's; no row has a reading of the device's clock";
            return std::move(fit_);
        }
        for (std::size_t i = 0; i < host_ns_.size(); ++i) {
            if (host_ns_[i]) {
                used_.push_back(i);
            }
        }
        leave_out_standing();
        leave_out_outliers();
        if (used_.size() < 2) {
            fit_.text = stood_          ? "the device's; the host's stood still"
                        : used_.empty() ? "the device's; no host times"
                                        : "the device's; one host time";
            if (!used_.empty() && !stood_) {
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

    /// Host times that stay the same while the device's clock goes on say nothing, but for the
    /// first. Where reports waited and were read all at once, the last of them is in time.
    void leave_out_standing() {
        std::vector<std::size_t> left;
        const auto end_of_run = [&](std::size_t from) {
            std::size_t end = from;
            while (end < used_.size() && host_ns_[used_[end]] == host_ns_[used_[from]]) {
                ++end;
            }
            return end;
        };
        for (std::size_t i = 0; i < used_.size();) {
            const std::size_t end = end_of_run(i);
            const std::size_t first = used_[i];
            const std::size_t last = used_[end - 1];
            const std::int64_t over_ns = device_.time_ns[last] - device_.time_ns[first];
            bool stood = over_ns > jitter_ns();
            if (stood && !left.empty()) {
                stood = excess(left.back(), last) < -static_cast<Wide>(jitter_ns());
            } else if (stood && end < used_.size()) {
                stood = excess(last, used_[end_of_run(end) - 1]) > jitter_ns();
            }
            if (stood) {
                left.push_back(first);
                report_stand(first, end - i, over_ns);
            } else {
                left.insert(left.end(), used_.begin() + static_cast<std::ptrdiff_t>(i),
                            used_.begin() + static_cast<std::ptrdiff_t>(end));
            }
            i = end;
        }
        used_ = std::move(left);
    }

    void report_stand(std::size_t row, std::size_t count, std::int64_t over_ns) {
        stood_ = true;
        fit_.findings.push_back(
            {.kind = TraceFindingKind::ClockStoodStill,
             .line = lines_[row],
             .rows = count,
             .dropped = 0,
             .span_ns = over_ns,
             .text = fmt::format("the host's clock stood still for {}, {} rows of one host time: "
                                 "they go by the device's clock, and how long they took to the "
                                 "host is unknown",
                                 in_words(over_ns), count)});
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

    void take_lags() {
        for (std::size_t i = 0; i < used_.size(); ++i) {
            lags_.push_back({device_.time_ns[used_[i]], lag(used_[i]),
                             i > 0 && is_cut(used_[i - 1], used_[i])});
        }
        trend_ = lag_trend(lags_);
    }

    /// Whether the clocks go at one rate, as two crystals do. Else the device's is taken alone.
    bool rates_agree() {
        constexpr double kGreatest = 1000e-6;
        if (const double ratio = rough_ratio(); ratio < 0.5 || ratio > 2.0) {
            fit_.host_per_device = ratio;
        } else if (trend_.known && std::abs(trend_.slope) > kGreatest + trend_.uncertainty) {
            fit_.host_per_device = 1.0 + trend_.slope;
        } else {
            return true;
        }
        const double ratio = fit_.host_per_device;
        const std::string faster =
            ratio < 0.5 || ratio > 2.0
                ? (ratio > 1.0 ? fmt::format("{:.0f} times as fast as", ratio)
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

    /// What goes by on the host's clock while 1 ns does on the device's: the median over quarters
    /// of the rows. 1 where these do not agree.
    [[nodiscard]] double rough_ratio() const {
        constexpr std::size_t kFewest = 64;
        if (used_.size() < kFewest) {
            return 1.0;
        }
        const std::size_t apart = used_.size() / 4;
        std::vector<double> ratios;
        for (std::size_t i = apart; i < used_.size(); ++i) {
            const std::int64_t device_ns =
                device_.time_ns[used_[i]] - device_.time_ns[used_[i - apart]];
            ratios.push_back(static_cast<double>(elapsed(used_[i - apart], used_[i])) /
                             static_cast<double>(device_ns));
        }
        std::sort(ratios.begin(), ratios.end());
        const double middle = ratios[ratios.size() / 2];
        const double lower = ratios[ratios.size() / 8];
        const double upper = ratios[ratios.size() - 1 - ratios.size() / 8];
        constexpr double kAgree = 1.25;
        return lower > 0.0 && upper < kAgree * lower ? middle : 1.0;
    }

    /// The steps in which the clocks count, where these are seen.
    [[nodiscard]] double resolution_ns() const {
        constexpr std::int64_t kFine_ns = kMillisecond_ns / 10;
        std::int64_t host_ns = 0;
        bool repeats = false;
        std::vector<std::int64_t> device_ns{device_.step_ns[used_.front()]};
        for (std::size_t i = 1; i < used_.size(); ++i) {
            const Wide step = elapsed(used_[i - 1], used_[i]);
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
        std::vector<Stretch> stretches;
        stretches.reserve(device_.sets.size());
        for (const std::size_t set : device_.sets) {
            stretches.push_back({set, 0, true});
        }
        for (const LagStep& step :
             lag_steps(lags_, trend_, resolution_ns(), 2.0 * static_cast<double>(jitter_ns()))) {
            const std::size_t before = used_[step.at - 1];
            const std::size_t now = used_[step.at];
            if (!is_set_in(before, now) || is_step_over_set(before, now)) {
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
        const Wide more = excess(before, now);
        return more > most_ns || more < -static_cast<Wide>(most_ns);
    }

    void note_step(std::size_t before, std::size_t now, Wide by_ns,
                   std::vector<Stretch>& stretches) {
        if (is_set_in(before, now)) {
            // Both were set: what the host's clock says of the time between is worth nothing.
            for (Stretch& stretch : stretches) {
                stretch.by_host &= stretch.first <= before || stretch.first > now;
            }
            report_host_set(now, by_ns);
        } else if (const auto row = device_step_near(now, by_ns)) {
            stretches.push_back({*row, 0, true});
            report_device_set(*row, -by_ns);
        } else {
            stretches.push_back({now, 0, false});
            report_host_set(now, by_ns);
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

    /// Fits the stretch.
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
        std::int64_t went_on_ns = 0;
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
            if (i > 0) {
                const std::int64_t step_ns = device_ns - device_.time_ns[fed[i - 1]];
                window_from_ns = step_ns > kFitForgets_ns ? device_ns : window_from_ns;
                went_on_ns += step_ns < kSecond_ns ? step_ns : 0;
            }
            const time::ClockReading reading = fit.add(device_ns, arrived_ns);
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
            const double change_ns = most->lag_ns - least->lag_ns;
            line.steep =
                change_ns > std::max(2.0 * static_cast<double>(line.within_ns), kNone_ns) &&
                went_on_ns >= kShortestOfASlope_ns;
            if (line.steep && !is_gradual(fed)) {
                line.steep = false;
                line.within_ns = std::max<std::int64_t>(line.within_ns, std::llround(change_ns));
            }
        }
        return line;
    }

    /// Whether the lowest lags of quarters of the rows lie on a line, rather than on both sides of
    /// a step too short to be told from noise where it is.
    [[nodiscard]] bool is_gradual(const std::vector<std::size_t>& rows) const {
        constexpr std::size_t kParts = 4;
        if (rows.size() < 2 * kParts) {
            return true;
        }
        std::vector<std::size_t> lowest;
        for (std::size_t part = 0; part < kParts; ++part) {
            const auto at = [&](std::size_t end) {
                return rows.begin() + static_cast<std::ptrdiff_t>(rows.size() * end / kParts);
            };
            lowest.push_back(
                *std::min_element(at(part), at(part + 1),
                                  [&](std::size_t a, std::size_t b) { return lag(a) < lag(b); }));
        }
        const auto apart = [&](std::size_t from, std::size_t to) {
            return static_cast<double>(device_.time_ns[to] - device_.time_ns[from]);
        };
        const auto total = static_cast<double>(excess(lowest.front(), lowest.back()));
        const double slope = total / apart(lowest.front(), lowest.back());
        for (std::size_t i = 1; i < lowest.size(); ++i) {
            const double off = static_cast<double>(excess(lowest[i - 1], lowest[i])) -
                               slope * apart(lowest[i - 1], lowest[i]);
            if (std::abs(off) > std::abs(total) / 2.0) {
                return false;
            }
        }
        return true;
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
                !host_ns_[i] || !host_ns_[i - 1] ||
                2 * magnitude(elapsed(i - 1, i) - device_.interval_ns) < magnitude(off);
            if (host_went_on && !device_.reckoned[i] && magnitude(off + by_ns) < least) {
                least = magnitude(off + by_ns);
                found = i;
            }
        }
        return found;
    }

    void report_device_set(std::size_t row, Wide by_ns) {
        const std::int64_t by = time::saturated(by_ns);
        fit_.findings.push_back(
            {.kind = TraceFindingKind::DeviceClockSet,
             .line = lines_[row],
             .rows = 1,
             .dropped = 0,
             .span_ns = by,
             .text = fmt::format("the device's clock steps {} by {}: times go on by the host's "
                                 "clock",
                                 by < 0 ? "back" : "ahead", in_words(by))});
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
    bool stood_ = false;             ///< the host's clock
    std::vector<LagRow> lags_;       ///< of used_
    LagTrend trend_;
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
