#include "drivers/trace/clock/standing_gaze.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "drivers/trace/clock/row_order.h"
#include "drivers/trace/clock/time_text.h"

namespace gazeloop::drivers {

std::vector<gaze::TraceFinding> standing_gaze(const RowsRead& rows, const DeviceTimes& times) {
    constexpr std::int64_t kStill_ns = 2'000'000'000;
    constexpr std::size_t kMostPolls = 7;
    constexpr std::size_t kRowsPerRepeat = 4;
    constexpr std::size_t kFewest = 8;
    const std::size_t count = times.rows.size();
    std::vector<gaze::TraceFinding> findings;
    std::size_t polled = 0;
    std::size_t first_polled = 0;
    const auto row = [&](std::size_t i) { return times.rows[i]; };
    const auto line = [&](std::size_t i) { return rows[row(i)].line; };
    for (std::size_t first = 0; first < count;) {
        std::size_t end = first + 1;
        const KeptRow& report = rows.kept(row(first));
        if (report.valid(gaze::Eye::Left) || report.valid(gaze::Eye::Right)) {
            while (end < count && same_report(rows, row(end), row(first))) {
                ++end;
            }
        }
        if (end - first == count && times.time_ns.back() - times.time_ns.front() > kStill_ns) {
            return {{.kind = gaze::TraceFindingKind::Text,
                     .line = line(first),
                     .rows = 0,
                     .dropped = 0,
                     .span_ns = 0,
                     .text = "the gaze is the same in all rows"}};
        }
        const std::size_t repeats = end - first - 1;
        const std::int64_t span_ns = times.time_ns[end - 1] - times.time_ns[first];
        if (repeats > 0 && span_ns > kStill_ns) {
            findings.push_back(
                {.kind = gaze::TraceFindingKind::Repeat,
                 .line = line(first + 1),
                 .rows = repeats,
                 .dropped = 0,
                 .span_ns = span_ns,
                 .text = fmt::format("the same report for {}, while times go on: the tracker or "
                                     "its recorder stood still; played as it is",
                                     in_words(span_ns))});
        } else if (repeats > 0 && repeats <= kMostPolls) {
            first_polled = polled == 0 ? first + 1 : first_polled;
            polled += repeats;
        }
        first = end;
    }
    if (polled >= kFewest && polled * kRowsPerRepeat >= count) {
        findings.push_back(
            {.kind = gaze::TraceFindingKind::Repeat,
             .line = line(first_polled),
             .rows = polled,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("{} of {} rows repeat the report before, with later times: the "
                                 "recorder polls faster than the tracker reports; played as it is",
                                 polled, count)});
    }
    return findings;
}

}  // namespace gazeloop::drivers
