#include "drivers/trace/clock/device_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "drivers/trace/clock/clock_chain.h"
#include "drivers/trace/clock/coarse_times.h"
#include "drivers/trace/clock/counter_wrap.h"
#include "drivers/trace/clock/row_order.h"
#include "drivers/trace/clock/time_text.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr Wide kMillisecond_ns = 1'000'000;
constexpr Wide kSecond_ns = 1000 * kMillisecond_ns;
constexpr Wide kDay_ns = 86'400 * kSecond_ns;
/// A step of more intervals is a gap, in question.
constexpr Wide kGapIntervals = 8;
/// A gap at either end with a single row beyond it is that row's error.
constexpr Wide kEndGapIntervals = 50;
/// No single step is longer in the time line, so that sums of steps do not overflow.
constexpr Wide kLongestStep_ns = 1000 * kDay_ns;

/// What the readings are in nanoseconds. Exact for whole ticks; from the first reading else.
memory::LongVector<Wide> readings_ns(const RowsRead& rows, bool by_host, double tick_ns) {
    constexpr double kWholeBelow = 1e12;
    const bool whole = tick_ns < kWholeBelow && tick_ns == std::floor(tick_ns);
    memory::LongVector<Wide> at_ns(rows.size());
    std::optional<std::int64_t> first;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& reading = by_host ? rows[i].host_ns : rows[i].device_ticks;
        if (!reading) {
            continue;
        }
        if (by_host || whole) {
            at_ns[i] = static_cast<Wide>(*reading) * (by_host ? 1 : static_cast<Wide>(tick_ns));
        } else {
            first = first.value_or(*reading);
            // At most 2^64 * 1e18 or so, which is in range; a larger tick is no clock's.
            constexpr double kLongestTick_ns = 1e18;
            at_ns[i] = static_cast<Wide>(static_cast<double>(static_cast<Wide>(*reading) - *first) *
                                         std::min(tick_ns, kLongestTick_ns));
        }
    }
    return at_ns;
}

class DeviceClock {
  public:
    DeviceClock(const RowsRead& rows, double tick_ns)
        : rows_(rows),
          by_host_(std::ranges::none_of(
              rows.clocks(), [](const RowClock& clock) { return clock.device_ticks.has_value(); })),
          absolute_(by_host_ || tick_ns == 1.0),
          at_ns_(readings_ns(rows, by_host_, tick_ns)) {}

    DeviceTimes run() {
        take_readable();
        if (used_.empty()) {
            return std::move(times_);
        }
        unwrap();
        interval_ns_ = median_step_ns();
        drop(readings_in_step(used_.size(), far_steps()));
        RowOrder order = rows_in_order(rows_, at_ns_, std::move(used_), interval_ns_);
        used_ = std::move(order.rows);
        move_to_end(order.findings, times_.findings);
        report_repeats(order.repeats);
        drop(readings_in_step(used_.size(), near_steps()));
        doubt_the_ends();
        lay_out();
        return std::move(times_);
    }

  private:
    void take_readable() {
        gaze::TraceFinding bad{.kind = TraceFindingKind::BadTime,
                               .line = 0,
                               .rows = 0,
                               .dropped = 0,
                               .span_ns = 0,
                               .text = {}};
        used_.reserve(rows_.size());
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (by_host_ ? rows_[i].host_ns.has_value() : rows_[i].device_ticks.has_value()) {
                used_.push_back(i);
            } else {
                bad.line = bad.rows == 0 ? rows_[i].line : bad.line;
                ++bad.rows;
            }
        }
        times_.by_host = by_host_ && !used_.empty();
        if (times_.by_host) {
            times_.findings.push_back(
                {.kind = TraceFindingKind::BadTime,
                 .line = rows_[0].line,
                 .rows = used_.size(),
                 .dropped = 0,
                 .span_ns = 0,
                 .text = "no row has a readable time of the device's clock: times are the host's, "
                         "at arrival"});
        }
        if (bad.rows > 0) {
            bad.dropped = bad.rows;
            bad.text = fmt::format("{} {} without a readable time: dropped", bad.rows,
                                   bad.rows == 1 ? "row" : "rows");
            times_.findings.push_back(std::move(bad));
        }
    }

    /// Counts on where one row and the next are before and after a wrap, either way round.
    void unwrap() {
        if (unwrap_by_host()) {
            return;
        }
        // Before anything is known of the interval: what most steps are shorter than.
        const std::int64_t step_ns = 4 * median_step_ns();
        Wide epoch_ns = 0;
        Wide most_ns = 0;
        for (std::size_t i = 1; i < used_.size(); ++i) {
            const std::size_t before = used_[i - 1];
            const std::size_t now = used_[i];
            const Wide raw_before = at_ns_[before] - epoch_of_last_ns_;
            const Wide raw = at_ns_[now];
            const auto range =
                raw < raw_before
                    ? wrapped_range(raw_before, raw, step_ns, elapsed_by_host(i - 1, i),
                                    elapsed_by_count(i - 1, i, step_ns / 4))
                    : std::nullopt;
            if (range) {
                epoch_ns += *range;
                if (epoch_ns > most_ns) {
                    most_ns = epoch_ns;
                    report_wrap(now, *range);
                }
            } else if (epoch_ns > 0) {
                // Only what was counted on can be counted back.
                const auto back = wrapped_range(raw, raw_before, step_ns);
                epoch_ns -= back && epoch_ns >= *back ? *back : 0;
            }
            at_ns_[now] = raw + epoch_ns;
            epoch_of_last_ns_ = epoch_ns;
        }
    }

    /// A counter that wraps every few rows says too little alone. Where the host's clock says how
    /// long it was from row to row, it is known how often the counter wrapped in between.
    bool unwrap_by_host() {
        const std::optional<Wide> range = short_range();
        if (!range) {
            return false;
        }
        Wide epoch_ns = 0;
        Wide raw_before = at_ns_[used_.front()];
        std::size_t wraps = 0;
        std::size_t first = 0;
        for (std::size_t i = 1; i < used_.size(); ++i) {
            const Wide raw = at_ns_[used_[i]];
            const Wide more_ns = wrapped_by_host(i, raw - raw_before).value_or(0);
            Wide times = (more_ns + (more_ns < 0 ? -*range : *range) / 2) / *range;
            // What was set back is the host's clock.
            times = times >= -1 ? times : 0;
            times = times == 0 && raw < raw_before && more_ns <= 0 ? 1 : times;
            epoch_ns = std::max<Wide>(0, epoch_ns + times * *range);
            if (times > 0) {
                first = wraps++ == 0 ? used_[i] : first;
            }
            at_ns_[used_[i]] = raw + epoch_ns;
            raw_before = raw;
        }
        times_.findings.push_back(
            {.kind = TraceFindingKind::CounterWrapped,
             .line = rows_[first].line,
             .rows = wraps,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("the device's counter began anew {} times, every {}: counted on "
                                 "by the host's clock",
                                 wraps, in_words(time::saturated(*range)))});
        return true;
    }

    /// The range of a counter that begins anew every few rows, as the host's clock has it.
    [[nodiscard]] std::optional<Wide> short_range() const {
        constexpr std::size_t kFewestWraps = 4;
        constexpr std::size_t kRowsPerWrap = 64;
        constexpr Wide kJitter = 4;  // one in so many of the range
        memory::LongVector<Wide> more_ns;
        std::size_t back = 0;
        Wide least = at_ns_[used_.front()];
        Wide most = least;
        for (std::size_t i = 1; i < used_.size(); ++i) {
            least = std::min(least, at_ns_[used_[i]]);
            most = std::max(most, at_ns_[used_[i]]);
            const Wide step_ns = step(i - 1, i);
            if (step_ns < 0) {
                ++back;
                if (const auto more = wrapped_by_host(i, step_ns)) {
                    more_ns.push_back(*more);
                }
            }
        }
        if (more_ns.size() < kFewestWraps || back * kRowsPerWrap < used_.size() ||
            more_ns.size() * 2 < back) {
            return std::nullopt;
        }
        const auto middle = more_ns.begin() + static_cast<std::ptrdiff_t>(more_ns.size() / 2);
        std::nth_element(more_ns.begin(), middle, more_ns.end());
        const std::optional<Wide> range = counter_range(*middle, most - least);
        const auto agreeing = std::ranges::count_if(more_ns, [&](Wide more) {
            const Wide off = range && more > 0 ? (more + *range / 2) % *range - *range / 2 : more;
            return more > 0 && kJitter * (off < 0 ? -off : off) <= range.value_or(0);
        });
        return static_cast<std::size_t>(agreeing) * 4 >= more_ns.size() * 3 ? range : std::nullopt;
    }

    /// By how much more the host's clock went on before a position than the device's reading did.
    [[nodiscard]] std::optional<Wide> wrapped_by_host(std::size_t position, Wide step_ns) const {
        const auto& a = rows_[used_[position - 1]].host_ns;
        const auto& b = rows_[used_[position]].host_ns;
        return by_host_ || !a || !b ? std::nullopt
                                    : std::optional(static_cast<Wide>(*b) - *a - step_ns);
    }

    void report_wrap(std::size_t row, Wide range_ns) {
        times_.findings.push_back(
            {.kind = TraceFindingKind::CounterWrapped,
             .line = rows_[row].line,
             .rows = 1,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("the device's counter began anew after {}: counted on",
                                 in_words(time::saturated(range_ns)))});
    }

    /// Of steps forward between neighbours, once each few rows have been sorted.
    [[nodiscard]] std::int64_t median_step_ns() const {
        constexpr std::size_t kSorted = 2 * kOrderWindow;
        memory::LongVector<std::int64_t> steps;
        steps.reserve(used_.size());
        std::vector<Wide> some;
        for (std::size_t first = 0; first < used_.size(); first += kSorted) {
            const std::size_t end = std::min(first + kSorted, used_.size());
            some.clear();
            for (std::size_t i = first; i < end; ++i) {
                some.push_back(at_ns_[used_[i]]);
            }
            std::sort(some.begin(), some.end());
            for (std::size_t i = 1; i < some.size(); ++i) {
                if (some[i] > some[i - 1]) {
                    steps.push_back(time::saturated(some[i] - some[i - 1]));
                }
            }
        }
        if (steps.empty()) {
            return 0;
        }
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
        std::nth_element(steps.begin(), middle, steps.end());
        // So that sums of a few of them are safe.
        return std::min<std::int64_t>(*middle, static_cast<std::int64_t>(kDay_ns));
    }

    [[nodiscard]] Wide step(std::size_t before, std::size_t after) const {
        return at_ns_[used_[after]] - at_ns_[used_[before]];
    }

    /// By the host's clock; unknown where it goes back too.
    [[nodiscard]] std::optional<Wide> host_step(std::size_t before, std::size_t after) const {
        const auto& a = rows_[used_[before]].host_ns;
        const auto& b = rows_[used_[after]].host_ns;
        if (by_host_ || !a || !b || *b < *a) {
            return std::nullopt;
        }
        return static_cast<Wide>(*b) - *a;
    }

    [[nodiscard]] Wide host_tolerance_ns(Wide elapsed_ns) const {
        return std::max<Wide>(kGapIntervals * interval_ns_, 50 * kMillisecond_ns) +
               elapsed_ns / 1000;
    }

    /// By the sequence numbers, how many reports there were; unknown where they do not count up.
    [[nodiscard]] std::optional<Wide> reports(std::size_t before, std::size_t after) const {
        const auto& a = rows_[used_[before]].sequence;
        const auto& b = rows_[used_[after]].sequence;
        if (!a || !b || *b <= *a) {
            return std::nullopt;
        }
        return static_cast<Wide>(*b) - *a;
    }

    [[nodiscard]] bool reports_agree(std::size_t before, std::size_t after) const {
        const auto count = reports(before, after);
        const Wide step_ns = step(before, after);
        const Wide counted_ns = count.value_or(0) * interval_ns_;
        const Wide difference = step_ns > counted_ns ? step_ns - counted_ns : counted_ns - step_ns;
        return count && *count > 1 && difference <= step_ns / 5;
    }

    /// Whether the numbers count on as if far less time had gone by.
    [[nodiscard]] bool reports_object(std::size_t before, std::size_t after) const {
        constexpr Wide kFarLess = 4;
        const auto count = reports(before, after);
        return count && kFarLess * *count * interval_ns_ < step(before, after);
    }

    /// So many rows in a row may be left out.
    [[nodiscard]] std::size_t longest_burst() const {
        constexpr Wide kBurst_ns = 50 * kMillisecond_ns;
        return static_cast<std::size_t>(
            std::clamp<Wide>(kBurst_ns / std::max<Wide>(1, interval_ns_), kLongestBurst,
                             3 * static_cast<Wide>(kLongestBurst)));
    }

    /// Whether the host says that less time went by than the device's clock has it.
    [[nodiscard]] bool host_objects(std::size_t before, std::size_t after) const {
        const auto host_ns = host_step(before, after);
        return host_ns && *host_ns < step(before, after) - host_tolerance_ns(*host_ns) &&
               !reports_agree(before, after);
    }

    [[nodiscard]] bool host_agrees(std::size_t before, std::size_t after) const {
        const auto host_ns = host_step(before, after);
        return host_ns && *host_ns >= step(before, after) - host_tolerance_ns(*host_ns);
    }

    [[nodiscard]] Wide longest_joined_ns(std::size_t before, std::size_t after) const {
        return (kGapIntervals + static_cast<Wide>(after - before)) * interval_ns_;
    }

    [[nodiscard]] double doubt(std::size_t before, std::size_t after) const {
        const Wide step_ns = step(before, after);
        if (step_ns < 0) {
            return wrap_between(before, after) ? 0.0 : kImpossibleStep;
        }
        if (step_ns <= longest_joined_ns(before, after)) {
            return 0.0;
        }
        if (host_objects(before, after)) {
            return kImpossibleStep;
        }
        if (host_agrees(before, after) || reports_agree(before, after)) {
            return 0.0;
        }
        if (reports_object(before, after)) {
            return kImpossibleStep;
        }
        // Less than a row is worth: a row between two gaps is none to be left out.
        constexpr double kGap = 0.25;
        return step_ns > kDay_ns ? kImpossibleStep : kGap;
    }

    /// A wrap with something else in between.
    [[nodiscard]] std::optional<Wide> wrap_between(std::size_t before, std::size_t after) const {
        if (step(before, after) >= 0) {
            return std::nullopt;
        }
        const std::int64_t step_ns = time::saturated(4 * static_cast<Wide>(interval_ns_) *
                                                     static_cast<Wide>(after - before));
        return wrapped_range(at_ns_[used_[before]], at_ns_[used_[after]], step_ns,
                             elapsed_by_host(before, after),
                             elapsed_by_count(before, after, interval_ns_));
    }

    [[nodiscard]] std::optional<OtherwiseElapsed> elapsed_by_host(std::size_t before,
                                                                  std::size_t after) const {
        const auto host_ns = host_step(before, after);
        return host_ns ? std::optional(OtherwiseElapsed{*host_ns, host_tolerance_ns(*host_ns)})
                       : std::nullopt;
    }

    /// A count of one says nothing: a tracker that stood still counts on from where it was.
    [[nodiscard]] std::optional<OtherwiseElapsed> elapsed_by_count(std::size_t before,
                                                                   std::size_t after,
                                                                   std::int64_t interval_ns) const {
        constexpr Wide kWithin = 5;  // one in so many
        const Wide elapsed_ns = reports(before, after).value_or(0) * interval_ns;
        return elapsed_ns > interval_ns
                   ? std::optional(OtherwiseElapsed{elapsed_ns, elapsed_ns / kWithin})
                   : std::nullopt;
    }

    /// Leaves aside that rows may be mixed up.
    [[nodiscard]] ClockSteps far_steps() const {
        const Wide reach_ns = static_cast<Wide>(kOrderWindow) * interval_ns_;
        return {.joins =
                    [this, reach_ns](std::size_t before, std::size_t after) {
                        const Wide step_ns = step(before, after);
                        return step_ns >= -reach_ns && step_ns <= reach_ns;
                    },
                .doubt =
                    [this, reach_ns](std::size_t before, std::size_t after) {
                        const Wide step_ns = step(before, after);
                        return step_ns < 0 && step_ns >= -reach_ns ? 0.0 : doubt(before, after);
                    },
                .longest_burst = longest_burst()};
    }

    [[nodiscard]] ClockSteps near_steps() const {
        return {
            .joins =
                [this](std::size_t before, std::size_t after) {
                    const Wide step_ns = step(before, after);
                    return step_ns >= 0 && 2 * step_ns <= 3 * static_cast<Wide>(interval_ns_);
                },
            .doubt = [this](std::size_t before, std::size_t after) { return doubt(before, after); },
            .longest_burst = longest_burst()};
    }

    void drop(const memory::LongVector<bool>& kept) {
        memory::LongVector<std::size_t> left;
        left.reserve(used_.size());
        for (std::size_t i = 0; i < used_.size();) {
            if (kept[i]) {
                left.push_back(used_[i++]);
                continue;
            }
            std::size_t end = i;
            while (end < used_.size() && !kept[end]) {
                ++end;
            }
            report_outlier(i, end);
            i = end;
        }
        used_ = std::move(left);
    }

    /// Of used_, [first, end).
    void report_outlier(std::size_t first, std::size_t end) {
        const Wide off_ns = first > 0            ? step(first - 1, first)
                            : end < used_.size() ? -step(end - 1, end)
                                                 : 0;
        times_.findings.push_back(
            {.kind = TraceFindingKind::TimeOutlier,
             .line = rows_[used_[first]].line,
             .rows = end - first,
             .dropped = end - first,
             .span_ns = 0,
             .text = fmt::format("{} {} {} the rest: dropped", in_words(time::saturated(off_ns)),
                                 off_ns < 0 ? "behind" : "ahead of",
                                 first > 0 ? "what is before, not so" : "what follows, not so")});
    }

    void doubt_the_ends() {
        constexpr std::size_t kFewest = 16;
        const auto is_alone = [&](std::size_t before, std::size_t after) {
            const Wide step_ns = step(before, after);
            return step_ns > std::max(kSecond_ns, kEndGapIntervals * interval_ns_) &&
                   !host_agrees(before, after) && !reports_agree(before, after);
        };
        if (used_.size() < kFewest) {
            return;
        }
        memory::LongVector<bool> kept(used_.size(), true);
        kept.front() = !is_alone(0, 1);
        kept.back() = !is_alone(used_.size() - 2, used_.size() - 1);
        drop(kept);
    }

    void report_repeats(const memory::LongVector<std::size_t>& repeats) {
        if (repeats.empty()) {
            return;
        }
        const std::size_t first = *std::min_element(repeats.begin(), repeats.end());
        times_.findings.push_back(
            {.kind = TraceFindingKind::Repeat,
             .line = rows_[first].line,
             .rows = repeats.size(),
             .dropped = repeats.size(),
             .span_ns = 0,
             .text = fmt::format("{} {} the same report as before, with the same time: dropped",
                                 repeats.size(), repeats.size() == 1 ? "row is" : "rows are")});
    }

    /// From each row to the next, with the clock's sets mended; then rows of one time apart.
    void lay_out() {
        memory::LongVector<TimedRow> timed(used_.size());
        Wide epoch_ns = 0;
        times_.reading_ns.reserve(used_.size());
        times_.time_ns.reserve(used_.size());
        for (std::size_t i = 0; i < used_.size(); ++i) {
            timed[i].line = rows_[used_[i]].line;
            timed[i].host_ns = by_host_ ? std::nullopt : rows_[used_[i]].host_ns;
            if (i == 0) {
                times_.reading_ns.push_back(0);
                continue;
            }
            const Wide step_ns = step(i - 1, i);
            const auto range = wrap_between(i - 1, i);
            if (range) {
                report_wrap(used_[i], *range);
                epoch_ns += *range;
                timed[i].step_ns = time::saturated(step_ns + *range);
            } else if (step_ns < 0 || (step_ns > longest_joined_ns(i - 1, i) &&
                                       host_objects(i - 1, i) && !catches_up(i))) {
                timed[i].set = true;
                timed[i].step_ns = time::saturated(step_over_set(i));
                report_set(i, step_ns - timed[i].step_ns);
            } else {
                timed[i].step_ns = time::saturated(std::min(step_ns, kLongestStep_ns));
            }
            times_.reading_ns.push_back(
                time::saturated(at_ns_[used_[i]] + epoch_ns - at_ns_[used_[0]]));
        }
        if (absolute_) {
            for (std::int64_t& reading_ns : times_.reading_ns) {
                reading_ns = time::saturated(reading_ns + at_ns_[used_[0]]);
            }
        }
        for (std::size_t i = 0; i < timed.size(); ++i) {
            if (timed[i].set) {
                times_.sets.push_back(i);
            }
        }
        SpreadTimes apart = spread(timed, interval_ns_);
        move_to_end(apart.findings, times_.findings);
        times_.sets.insert(times_.sets.end(), apart.sets.begin(), apart.sets.end());
        std::sort(times_.sets.begin(), times_.sets.end());
        times_.interval_ns = apart.interval_ns;
        times_.step_ns = std::move(apart.coarse_ns);
        times_.reckoned = std::move(apart.reckoned);
        Wide at = 0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            at += i == 0 ? 0 : std::max<std::int64_t>(1, apart.step_ns[i]);
            times_.time_ns.push_back(time::saturated(at));
        }
        times_.rows = std::move(used_);
    }

    /// Whether the clock stood before, and has gone on by now as the host's clock did meanwhile.
    [[nodiscard]] bool catches_up(std::size_t position) const {
        std::size_t first = position - 1;
        while (first > 0 && step(first - 1, first) == 0) {
            --first;
        }
        return first + 1 < position && host_agrees(first, position);
    }

    /// What went by while the device's clock was set.
    [[nodiscard]] Wide step_over_set(std::size_t after) const {
        const auto host_ns = host_step(after - 1, after);
        if (host_ns && *host_ns > 0) {
            return std::min(*host_ns, kLongestStep_ns);
        }
        constexpr Wide kMostLost = 1000;
        const Wide count = reports(after - 1, after).value_or(1);
        return interval_ns_ * (count <= kMostLost ? count : 1);
    }

    /// Whether the report numbers go back where the clock does.
    [[nodiscard]] bool begins_anew(std::size_t position) const {
        const auto& before = rows_[used_[position - 1]].sequence;
        const auto& now = rows_[used_[position]].sequence;
        return step(position - 1, position) < 0 && before && now && *now < *before;
    }

    void report_set(std::size_t position, Wide by_ns) {
        const auto host_ns = host_step(position - 1, position);
        const bool counted = reports(position - 1, position).value_or(0) > 1;
        const std::string_view goes_on =
            host_ns && *host_ns > 0 ? "the host's clock"
            : counted               ? "the usual interval and the report numbers"
                                    : "the usual interval: how long it really was is not known";
        times_.findings.push_back(
            {.kind = TraceFindingKind::DeviceClockSet,
             .line = rows_[used_[position]].line,
             .rows = 1,
             .dropped = 0,
             .span_ns = time::saturated(by_ns),
             .text = fmt::format("the device's clock steps {} by {}{}: times go on by {}",
                                 by_ns < 0 ? "back" : "ahead", in_words(time::saturated(by_ns)),
                                 begins_anew(position)
                                     ? " and its report numbers begin anew (the tracker was "
                                       "restarted, or another recording follows: split the file)"
                                     : "",
                                 goes_on)});
    }

    static void move_to_end(std::vector<gaze::TraceFinding>& from,
                            std::vector<gaze::TraceFinding>& to) {
        to.insert(to.end(), std::make_move_iterator(from.begin()),
                  std::make_move_iterator(from.end()));
    }

    const RowsRead& rows_;
    bool by_host_;                    ///< no row has a reading of the device's clock
    bool absolute_;                   ///< readings are given as they are
    memory::LongVector<Wide> at_ns_;  ///< of all rows, wraps counted on
    Wide epoch_of_last_ns_ = 0;
    memory::LongVector<std::size_t> used_;
    std::int64_t interval_ns_ = 0;  ///< between readings that differ
    DeviceTimes times_;
};

}  // namespace

DeviceTimes device_times(const RowsRead& rows, double tick_ns) {
    return DeviceClock(rows, tick_ns).run();
}

}  // namespace gazeloop::drivers
