#include "runtime/gaze/trace_report.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace gazeloop::gaze {

void TraceReport::add(TraceFinding finding) {
    TraceFindingCount& all = counts_[static_cast<std::size_t>(finding.kind)];
    ++all.times;
    all.rows += finding.rows;
    all.dropped += finding.dropped;
    all.span_ns += std::abs(finding.span_ns);
    if (all.times <= kKeptOfEachKind) {
        findings_.push_back(std::move(finding));
    }
}

std::uint64_t TraceReport::rows_dropped() const {
    std::uint64_t dropped = 0;
    for (const TraceFindingCount& all : counts_) {
        dropped += all.dropped;
    }
    return dropped;
}

bool TraceReport::worth_a_warning() const {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    for (const TraceFindingKind always : {TraceFindingKind::Axes, TraceFindingKind::OtherRecording,
                                          TraceFindingKind::NotRead, TraceFindingKind::OddTimes}) {
        if (count(always).times > 0) {
            return true;
        }
    }
    std::uint64_t concerned = 0;
    std::int64_t span_ns = 0;
    for (std::size_t kind = 0; kind < kTraceFindingKinds; ++kind) {
        const auto which = static_cast<TraceFindingKind>(kind);
        // The tracker's own bits refuse an eye at every blink; what text is like changes nothing.
        if (which == TraceFindingKind::Text || which == TraceFindingKind::RefusedByBit) {
            continue;
        }
        concerned += counts_[kind].rows;
        span_ns = std::max(span_ns, counts_[kind].span_ns);
    }
    return concerned * 100 > rows || span_ns > kSecond_ns;
}

}  // namespace gazeloop::gaze
