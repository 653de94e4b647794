#include "runtime/latency/span_series.h"

#include <algorithm>
#include <cstddef>

#include "runtime/latency/weakest_kind.h"

namespace gazeloop::latency {

time::StampKind DurationRow::kind() const { return weakest_kind(frames_by_kind); }

bool DurationRow::mixed() const {
    return std::count_if(frames_by_kind.begin() + 1, frames_by_kind.end(),
                         [](std::uint64_t frames) { return frames > 0; }) > 1;
}

void SpanSeries::add(const time::Span& span) {
    ++frames_by_kind_[static_cast<std::size_t>(span.kind)];
    if (span.known()) {
        histogram_.add(span.ns);
    }
}

DurationRow SpanSeries::row() const {
    return {.count = histogram_.count(),
            .frames_by_kind = frames_by_kind_,
            .min_ms = histogram_.min_ms(),
            .mean_ms = histogram_.mean_ms(),
            .p50_ms = histogram_.percentile_ms(50.0),
            .p95_ms = histogram_.percentile_ms(95.0),
            .p99_ms = histogram_.percentile_ms(99.0),
            .max_ms = histogram_.max_ms()};
}

}  // namespace gazeloop::latency
