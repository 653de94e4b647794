#include "drivers/trace/bids/joined_eyes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "drivers/trace/clock/counter_wrap.h"
#include "drivers/trace/clock/rows_read.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

/// A file's rows in the order of their times, which neither outliers nor steps of its clock move.
struct TimedRows {
    memory::LongVector<std::size_t> rows;
    memory::LongVector<Wide> at_ns;
};

TimedRows timed(const DeviceTimes& times) {
    TimedRows found{times.rows, {}};
    for (const std::int64_t time_ns : times.time_ns) {
        found.at_ns.push_back(static_cast<Wide>(times.reading_ns.front()) + time_ns);
    }
    return found;
}

bool same_times(const EyeRows& first, const EyeRows& second) {
    return std::ranges::equal(first.rows, second.rows, {}, &TraceRow::device_ticks,
                              &TraceRow::device_ticks);
}

void add_eyes(const EyeRows& from, const TraceRow& row, TraceRow& to) {
    for (const gaze::Eye eye : gaze::kEyes) {
        if (from.of[gaze::index(eye)]) {
            to.eyes[gaze::index(eye)] = row.eyes[gaze::index(eye)];
        }
    }
    to.head = to.head ? to.head : row.head;
}

/// What is wrong with one file's times alone, and rows without any.
void take_alone(const EyeRows& eye, const DeviceTimes& times, JoinedEyes& joined) {
    for (const TraceRow& row : eye.rows) {
        if (!row.device_ticks) {
            joined.rows.push_back(row);
        }
    }
    for (gaze::TraceFinding finding : times.findings) {
        if (finding.kind == TraceFindingKind::TimeOutlier ||
            finding.kind == TraceFindingKind::Repeat ||
            finding.kind == TraceFindingKind::OutOfOrder) {
            joined.dropped += finding.dropped;
            finding.text = fmt::format("{}: {}", eye.name, finding.text);
            joined.findings.push_back(std::move(finding));
        }
    }
}

/// No two eyes are looked at at rates so far apart: a unit is wrong.
constexpr double kMostApart = 50.0;

/// How many times longer one's usual interval is than the other's, from 1 on; 1 where either has
/// none.
double rates_apart(const DeviceTimes& one, const DeviceTimes& other) {
    if (one.interval_ns <= 0 || other.interval_ns <= 0) {
        return 1.0;
    }
    const double factor =
        static_cast<double>(one.interval_ns) / static_cast<double>(other.interval_ns);
    return std::max(factor, 1.0 / factor);
}

std::string span_text(const TimedRows& timed) {
    if (timed.at_ns.empty()) {
        return "no times";
    }
    return fmt::format("{:.3f} s to {:.3f} s", static_cast<double>(timed.at_ns.front()) * 1e-9,
                       static_cast<double>(timed.at_ns.back()) * 1e-9);
}

gaze::TraceFinding told_of_pairs(const EyeRows& first, const EyeRows& second, std::uint64_t pairs,
                                 const std::string& spans) {
    const std::uint64_t all = first.rows.size() + second.rows.size();
    const std::uint64_t alone = all - 2 * pairs;
    if (10 * alone <= all) {
        return {.kind = TraceFindingKind::Text,
                .text = fmt::format("two recordings, of which {} rows have the same times", pairs)};
    }
    return {.kind = TraceFindingKind::OddTimes,
            .rows = alone,
            .text = fmt::format("the eyes' times do not match: of {} rows of {} and {} of {} only "
                                "{} have the same{}; the others have one eye each: give both "
                                "files the same timestamps",
                                first.rows.size(), first.name, second.rows.size(), second.name,
                                pairs, spans)};
}

}  // namespace

std::vector<gaze::TraceFinding> doubt_stated_rate(const EyeRows& eye, const DeviceTimes& times) {
    constexpr std::size_t kFewest = 16;
    constexpr double kOff = 0.1;
    if (times.rows.size() < kFewest || times.interval_ns <= 0) {
        return {};
    }
    // Where rows are missing here and there, the mean is as good a rate as the usual interval's.
    constexpr std::int64_t kGap = 8;  // usual intervals
    std::int64_t sum_ns = 0;
    std::int64_t count = 0;
    for (std::size_t i = 1; i < times.time_ns.size(); ++i) {
        const std::int64_t interval_ns = times.time_ns[i] - times.time_ns[i - 1];
        if (interval_ns <= kGap * times.interval_ns) {
            sum_ns += interval_ns;
            ++count;
        }
    }
    const double rate_hz = 1e9 / static_cast<double>(times.interval_ns);
    const double mean_hz =
        sum_ns > 0 ? 1e9 * static_cast<double>(count) / static_cast<double>(sum_ns) : rate_hz;
    const auto [low_hz, high_hz] = std::minmax(rate_hz, mean_hz);
    if (eye.stated_rate_hz * (1.0 + kOff) >= low_hz &&
        eye.stated_rate_hz * (1.0 - kOff) <= high_hz) {
        return {};
    }
    return {{.kind = TraceFindingKind::OddTimes,
             .rows = times.rows.size(),
             .text = fmt::format("{}: its sidecar states a SamplingFrequency of {:.4g} Hz, its "
                                 "timestamps are those of {:.4g} Hz: mend the one that is wrong, "
                                 "or the timestamp's Units",
                                 eye.name, eye.stated_rate_hz, rate_hz)}};
}

Expected<JoinedEyes> join_eyes(const EyeRows& first, const EyeRows& second) {
    JoinedEyes joined;
    const DeviceTimes times = device_times(RowsRead(first.rows), 1.0);
    joined.findings = doubt_stated_rate(first, times);
    const bool same = same_times(first, second);
    const DeviceTimes others = same ? times : device_times(RowsRead(second.rows), 1.0);
    if (const double factor = rates_apart(times, others); factor > kMostApart) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}, {}: one goes on {:.3g} times as fast as the other: mend the "
                              "timestamp's Units in the JSON of the one that is wrong",
                              first.name, second.name, factor)});
    }
    for (gaze::TraceFinding& doubt : doubt_stated_rate(second, others)) {
        joined.findings.push_back(std::move(doubt));
    }
    if (same) {
        joined.rows = first.rows;
        for (std::size_t i = 0; i < joined.rows.size(); ++i) {
            add_eyes(second, second.rows[i], joined.rows[i]);
        }
        joined.findings.push_back(told_of_pairs(first, second, joined.rows.size(), ""));
        return joined;
    }
    take_alone(first, times, joined);
    take_alone(second, others, joined);
    const TimedRows a = timed(times);
    const TimedRows b = timed(others);
    const Wide same_ns = times.interval_ns / 1000;
    std::uint64_t pairs = 0;
    std::size_t i = 0;
    std::size_t k = 0;
    while (i < a.rows.size() || k < b.rows.size()) {
        if (i == a.rows.size()) {
            joined.rows.push_back(second.rows[b.rows[k++]]);
            continue;
        }
        if (k == b.rows.size()) {
            joined.rows.push_back(first.rows[a.rows[i++]]);
            continue;
        }
        const TraceRow& left = first.rows[a.rows[i]];
        const TraceRow& right = second.rows[b.rows[k]];
        const Wide apart_ns = a.at_ns[i] - b.at_ns[k];
        if (left.device_ticks == right.device_ticks ||
            (apart_ns <= same_ns && -apart_ns <= same_ns)) {
            joined.rows.push_back(left);
            add_eyes(second, right, joined.rows.back());
            ++pairs;
            ++i;
            ++k;
        } else if (apart_ns < 0) {
            joined.rows.push_back(left);
            ++i;
        } else {
            joined.rows.push_back(right);
            ++k;
        }
    }
    joined.findings.push_back(told_of_pairs(
        first, second, pairs, fmt::format(" ({}, and {})", span_text(a), span_text(b))));
    return joined;
}

}  // namespace gazeloop::drivers
