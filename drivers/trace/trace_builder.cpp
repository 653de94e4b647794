#include "drivers/trace/trace_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/host_fit.h"
#include "drivers/trace/clock/sequence_numbers.h"
#include "drivers/trace/clock/standing_gaze.h"
#include "drivers/trace/clock/time_text.h"
#include "runtime/gaze/sample_rate.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// One row in so many may be dropped, or be one at which a clock was set.
constexpr std::uint64_t kRowsPerRepair = 10;

std::unexpected<Error> bad_input(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

void move_to(std::vector<gaze::TraceFinding>& findings, gaze::TraceReport& report) {
    for (gaze::TraceFinding& finding : findings) {
        report.add(std::move(finding));
    }
    findings.clear();
}

std::uint64_t first_line(const gaze::TraceReport& report, auto&& is_meant) {
    std::optional<std::uint64_t> first;
    for (const gaze::TraceFinding& finding : report.findings()) {
        if (is_meant(finding)) {
            first = std::min(first.value_or(finding.line), finding.line);
        }
    }
    return first.value_or(0);
}

/// Whether rows dropped so say nothing against the others: a recorder that was stopped cuts the
/// last line of a good file, and a file may hold several recordings.
bool is_harmless(TraceFindingKind kind) {
    return kind == TraceFindingKind::CutRow || kind == TraceFindingKind::OtherRecording;
}

/// Of what is dropped and tells against a file: "time outlier 83, repeat 2"
std::string reasons(const gaze::TraceReport& report) {
    std::string text;
    for (std::size_t kind = 0; kind < gaze::kTraceFindingKinds; ++kind) {
        const auto& count = report.count(static_cast<TraceFindingKind>(kind));
        if (count.dropped > 0 && !is_harmless(static_cast<TraceFindingKind>(kind))) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", gaze::kTraceFindingNames[kind],
                                count.dropped);
        }
    }
    return text;
}

/// What is wrong with a trace of which so much was dropped or changed; nothing if it will do.
Expected<void> check_repairs(const std::string& file, const gaze::TraceReport& report,
                             const NotUnderstood& not_understood) {
    const std::uint64_t harmless = report.count(TraceFindingKind::CutRow).dropped +
                                   report.count(TraceFindingKind::OtherRecording).dropped;
    const std::uint64_t dropped = report.rows_dropped() - harmless;
    const std::uint64_t rows = report.rows - harmless;
    if (dropped * kRowsPerRepair > rows) {
        const auto bad_time = std::ranges::find(report.findings(), TraceFindingKind::BadTime,
                                                &gaze::TraceFinding::kind);
        if (2 * report.count(TraceFindingKind::BadTime).dropped > dropped) {
            return bad_input(
                fmt::format("{}:{}: {}; mend the column, or --accept-repairs leaves these rows out",
                            file, bad_time->line, bad_time->text));
        }
        const std::uint64_t line = first_line(report, [](const auto& finding) {
            return finding.dropped > 0 && !is_harmless(finding.kind);
        });
        return bad_input(
            fmt::format("{}:{}: {} of {} rows cannot be used ({}), the first of them "
                        "here; --accept-repairs plays the others",
                        file, line, dropped, rows, reasons(report)));
    }
    // A few cells refuse no file, however short.
    constexpr std::uint64_t kFewestNotUnderstood = 16;
    if (not_understood.rows >= kFewestNotUnderstood &&
        not_understood.rows * kRowsPerRepair > rows) {
        const auto cells = std::ranges::find(report.findings(), TraceFindingKind::BadCells,
                                             &gaze::TraceFinding::kind);
        return bad_input(fmt::format(
            "{}:{}: {} of {} rows have no gaze that is understood, the first of them here{}; mend "
            "these cells, or --accept-repairs plays the other rows",
            file, not_understood.first_line, not_understood.rows, rows,
            cells == report.findings().end() ? "" : fmt::format(" ({})", cells->text)));
    }
    const std::uint64_t sets = report.count(TraceFindingKind::DeviceClockSet).times +
                               report.count(TraceFindingKind::HostClockSet).times;
    if (sets * kRowsPerRepair > rows) {
        const std::uint64_t line = first_line(report, [](const auto& finding) {
            return finding.kind == TraceFindingKind::DeviceClockSet ||
                   finding.kind == TraceFindingKind::HostClockSet;
        });
        return bad_input(
            fmt::format("{}:{}: the clocks step back or ahead in {} of {} rows, the "
                        "first of them here; --accept-repairs plays them in their "
                        "order all the same",
                        file, line, sets, rows));
    }
    return {};
}

/// The longest step of increasing times.
struct Gap {
    std::size_t after = 0;  ///< position of the row that ends it
    std::int64_t length_ns = 0;
};

Gap longest_gap(std::span<const std::int64_t> times_ns) {
    Gap longest;
    for (std::size_t i = 1; i < times_ns.size(); ++i) {
        const std::int64_t step_ns = times_ns[i] - times_ns[i - 1];
        if (step_ns > longest.length_ns) {
            longest = {i, step_ns};
        }
    }
    return longest;
}

Expected<void> check_gap(const std::string& file, std::uint64_t line, const Gap& gap,
                         const DeviceTimes& times, std::int64_t longest_ns) {
    constexpr std::int64_t kGapIntervals = 8;
    const std::int64_t shortest_ns = std::max(
        kSecond_ns, time::saturated(static_cast<__int128>(kGapIntervals) * times.interval_ns));
    const std::int64_t rest_ns = times.time_ns.back() - gap.length_ns;
    if (gap.length_ns > shortest_ns && gap.length_ns > rest_ns) {
        return bad_input(
            fmt::format("{}:{}: {} without a row, longer than all the rest of the "
                        "recording, {}; --accept-repairs plays it as {}",
                        file, line, in_words(gap.length_ns), in_words(rest_ns),
                        in_words(std::min(gap.length_ns, longest_ns))));
    }
    return {};
}

/// Shortens what is longer, and reports it.
void shorten_gaps(const RowsRead& rows, DeviceTimes& times, std::int64_t longest_ns,
                  gaze::TraceReport& report) {
    memory::LongVector<std::int64_t>& times_ns = times.time_ns;
    std::int64_t cut_ns = 0;
    std::int64_t before_ns = times_ns.front();
    for (std::size_t i = 1; i < times_ns.size(); ++i) {
        const std::int64_t step_ns = times_ns[i] - before_ns;
        before_ns = times_ns[i];
        if (step_ns > longest_ns) {
            cut_ns += step_ns - longest_ns;
            report.add({.kind = TraceFindingKind::GapShortened,
                        .line = rows[times.rows[i]].line,
                        .rows = 1,
                        .dropped = 0,
                        .span_ns = step_ns - longest_ns,
                        .text = fmt::format("{} without a row: played as {}", in_words(step_ns),
                                            in_words(longest_ns))});
        }
        times_ns[i] -= cut_ns;
    }
}

}  // namespace

TraceBuilder::TraceBuilder(TraceOrigin origin) : origin_(std::move(origin)) {}

void TraceBuilder::add(const TraceRow& row) {
    rows_.add(row);
    ++report_.rows;
    if (row.not_understood && !row.eyes[0].valid && !row.eyes[1].valid) {
        not_understood_.first_line =
            not_understood_.rows++ == 0 ? row.line : not_understood_.first_line;
    }
}

double TraceBuilder::choose_clock() {
    const std::span<RowClock> clocks = rows_.clocks();
    const auto first = std::ranges::find_if(
        clocks, [](const RowClock& row) { return row.device_ticks.has_value(); });
    const bool counts = std::any_of(first, clocks.end(), [&](const RowClock& row) {
        return row.device_ticks && row.device_ticks != first->device_ticks;
    });
    const auto differs = [&](const RowClock& row) {
        return row.other_ticks && row.other_ticks != clocks.front().other_ticks;
    };
    if (counts || std::ranges::none_of(clocks, differs)) {
        return origin_.device_tick_ns;
    }
    const std::string why = first == clocks.end()
                                ? fmt::format("{}, nor is it in any row", unread_time_)
                                : fmt::format("column '{}' says the same in all rows", clock_);
    for (RowClock& row : clocks) {
        row.device_ticks = row.other_ticks;
    }
    report_.add({.kind = TraceFindingKind::BadTime,
                 .line = clocks.front().line,
                 .rows = rows_.size(),
                 .text = fmt::format("{}: the times are those of '{}'", why, origin_.other_clock)});
    clock_is(std::string{origin_.other_clock}, origin_.other_tick_ns);
    return origin_.other_tick_ns;
}

void TraceBuilder::doubt_rate(const DeviceTimes& times, std::size_t samples,
                              gaze::TraceReport& report) const {
    constexpr std::size_t kFewest = 16;
    constexpr double kSlowest_hz = 5.0;
    constexpr double kFastest_hz = 5000.0;
    const bool shortened = report.count(TraceFindingKind::GapShortened).times > 0;
    const double rate_hz = shortened && times.interval_ns > 0
                               ? 1e9 / static_cast<double>(times.interval_ns)
                               : report.rate_hz;
    if (samples < kFewest || rate_hz <= 0.0 || (rate_hz >= kSlowest_hz && rate_hz <= kFastest_hz)) {
        return;
    }
    struct Unit {
        double ns;
        std::string_view name;
    };
    constexpr double kUsualFrom_hz = 20.0;
    constexpr double kUsualTo_hz = 2000.0;
    std::string as;
    std::string_view stated = "the unit that is asked for";
    for (const Unit& unit :
         {Unit{1.0, "nanoseconds"}, Unit{100.0, "100 ns"}, Unit{1e3, "microseconds"},
          Unit{1e6, "milliseconds"}, Unit{1e9, "seconds"}}) {
        const double as_hz = rate_hz * clock_unit_ns_ / unit.ns;
        if (unit.ns == clock_unit_ns_) {
            stated = unit.name;
        } else if (as_hz >= kUsualFrom_hz && as_hz <= kUsualTo_hz) {
            as += fmt::format("{}{:.3g} in {}", as.empty() ? "" : ", ", as_hz, unit.name);
        }
    }
    const bool of_device = !times.by_host && knows_clock();
    report.add({.kind = TraceFindingKind::OddTimes,
                .rows = samples,
                .text = fmt::format(
                    "{:.3g} rows a second by {}, and eye trackers have {:g} to {:g}: {}", rate_hz,
                    of_device ? fmt::format("'{}'", clock_) : std::string("the host's times"),
                    kSlowest_hz, kFastest_hz,
                    !of_device || as.empty()
                        ? std::string("look at the unit of the times")
                        : fmt::format("they would be {}; write the times in {}", as, stated))});
}

Expected<BuiltTrace> TraceBuilder::finish(const ReadOptions& options) {
    const double tick_ns = choose_clock();
    RowsRead rows = std::move(rows_);
    gaze::TraceReport report = std::move(report_);
    const std::string& file = origin_.file;
    if (rows.empty()) {
        return bad_input(fmt::format("{}: no rows after the header", file));
    }
    DeviceTimes times = device_times(rows, tick_ns);
    for (gaze::TraceFinding& finding : times.findings) {
        if (finding.kind == TraceFindingKind::BadTime && !unread_time_.empty()) {
            finding.text = unread_time_ + "; " + finding.text;
        }
    }
    move_to(times.findings, report);
    if (times.rows.empty()) {
        return bad_input(fmt::format("{}:{}: no row has a readable time{}{}", file, rows[0].line,
                                     unread_time_.empty() ? "" : ": ", unread_time_));
    }
    if (times.rows.size() > 1 && times.interval_ns == 0) {
        return bad_input(
            fmt::format("{}:{}: all {} rows have the same time, and no host time says "
                        "how long they took",
                        file, rows[0].line, times.rows.size()));
    }
    memory::LongVector<std::optional<std::int64_t>> host_ns;
    memory::LongVector<std::uint64_t> lines;
    host_ns.reserve(times.rows.size());
    lines.reserve(times.rows.size());
    for (const std::size_t row : times.rows) {
        host_ns.push_back(rows[row].host_ns);
        lines.push_back(rows[row].line);
    }
    HostFit fit = fit_to_host(times, host_ns, lines);
    if (fit.absurd_rates && !options.accept_repairs) {
        return bad_input(fmt::format("{}:{}: {}, or --accept-repairs plays them as they are", file,
                                     fit.findings.back().line, fit.findings.back().text));
    }
    move_to(fit.findings, report);
    report.clock = std::move(fit.text);

    DeviceTimes fitted = std::move(times);
    fitted.time_ns = std::move(fit.time_ns);
    SequenceNumbers sequence = sequence_numbers(rows, fitted);
    move_to(sequence.findings, report);
    report.lost_by_tracker = sequence.lost;
    std::vector<gaze::TraceFinding> standing = standing_gaze(rows, fitted);
    move_to(standing, report);
    const Gap gap = longest_gap(fitted.time_ns);
    report.longest_gap_ns = gap.length_ns;
    const std::int64_t longest_gap_ns = std::llround(options.longest_gap_s * 1e9);
    if (!options.accept_repairs) {
        for (const Expected<void>& check :
             {check_repairs(file, report, not_understood_),
              check_gap(file, lines[gap.after], gap, fitted, longest_gap_ns)}) {
            if (!check) {
                return std::unexpected(check.error());
            }
        }
    }
    shorten_gaps(rows, fitted, longest_gap_ns, report);
    constexpr std::int64_t kYear_ns = 31'622'400 * kSecond_ns;
    if (fitted.time_ns.back() > kYear_ns) {
        return bad_input(
            fmt::format("{}:{}: more than a year after the first row; a smaller "
                        "longest gap makes it shorter",
                        file, lines.back()));
    }

    for (const std::size_t row : fitted.rows) {
        for (const gaze::Eye eye : gaze::kEyes) {
            report.valid[gaze::index(eye)] += rows.kept(row).valid(eye) ? 1 : 0;
        }
    }
    BuiltTrace trace{.file = file,
                     .format = std::string{origin_.format},
                     .device = origin_.device,
                     .samples = std::make_shared<RowSamples>(
                         rows.rows(), RowSamples::Judged{.rows = std::move(fitted.rows),
                                                         .numbers = std::move(sequence.numbers),
                                                         .device_ns = std::move(fitted.reading_ns),
                                                         .time_ns = std::move(fitted.time_ns),
                                                         .delay_ns = std::move(fit.delay_ns),
                                                         .step_ns = std::move(fitted.step_ns)}),
                     .lines = std::move(lines),
                     .report = {}};
    rows = {};  // its clocks are not needed any more
    report.rate_hz = gaze::sample_rate_hz(*trace.samples);
    doubt_rate(fitted, trace.samples->size(), report);
    if (report.valid[0] + report.valid[1] == 0) {
        return bad_input(fmt::format("no valid gaze in {}", file));
    }
    trace.report = std::move(report);
    return trace;
}

}  // namespace gazeloop::drivers
