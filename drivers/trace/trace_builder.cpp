#include "drivers/trace/trace_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gazeloop::drivers {
namespace {

/// Arrivals were read on the host's clock since its first row, sample times on the device's. The
/// least difference of the two becomes zero: what the report took at least is unknown, what it took
/// more than that is in the file.
void align_arrivals(std::vector<gaze::GazeSample>& samples) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const gaze::GazeSample& sample : samples) {
        if (sample.arrived.known()) {
            least = std::min(least, sample.arrived.ns - sample.sampled.ns);
        }
    }
    for (gaze::GazeSample& sample : samples) {
        if (sample.arrived.known()) {
            sample.arrived.ns -= least;
        }
    }
}

}  // namespace

TraceBuilder::TraceBuilder(TraceOrigin origin) : tick_ns_(origin.device_tick_ns) {
    trace_.file = std::move(origin.file);
    trace_.format = origin.format;
    trace_.device = std::move(origin.device);
}

std::optional<std::int64_t> TraceBuilder::since_first_ns(std::optional<std::int64_t>& first,
                                                         std::int64_t reading, double tick_ns) {
    constexpr double kYear_ns = 366.0 * 24 * 3600 * 1e9;
    if (!first) {
        first = reading;
    }
    std::int64_t elapsed = 0;
    if (__builtin_sub_overflow(reading, *first, &elapsed) ||
        std::abs(static_cast<double>(elapsed) * tick_ns) > kYear_ns) {
        return std::nullopt;
    }
    return elapsed * static_cast<std::int64_t>(tick_ns);
}

void TraceBuilder::add(const TraceRow& row) {
    ++trace_.report.rows;
    gaze::GazeSample sample;
    sample.sequence = row.sequence.value_or(sequence_ ? *sequence_ + 1 : 0);
    if (sequence_ && sample.sequence > *sequence_) {
        trace_.rows_missing += sample.sequence - *sequence_ - 1;
    }
    sequence_ = sample.sequence;
    const auto time_ns =
        row.device_ticks ? since_first_ns(first_ticks_, *row.device_ticks, tick_ns_) : std::nullopt;
    if (!time_ns) {
        trace_.report.add({.kind = gaze::TraceFindingKind::BadTime,
                           .line = row.line,
                           .rows = 1,
                           .dropped = 1,
                           .text = "no readable time"});
        return;
    }
    sample.device_ns = tick_ns_ == 1.0 ? *row.device_ticks : *time_ns;
    sample.sampled = {*time_ns, time::StampKind::Modelled};
    if (row.host_ns) {
        if (const auto host_ns = since_first_ns(first_host_ns_, *row.host_ns, 1.0)) {
            sample.arrived = {*host_ns, time::StampKind::Modelled};
        }
    }
    sample.eyes = row.eyes;
    sample.head = row.head;
    if (!trace_.samples.empty() && sample.sampled.ns <= trace_.samples.back().sampled.ns) {
        ++trace_.rows_out_of_order;
        trace_.report.add({.kind = gaze::TraceFindingKind::TimeOutlier,
                           .line = trace_.report.rows + 1,
                           .rows = 1,
                           .dropped = 1,
                           .text = "its time is not later than that before; dropped"});
        return;
    }
    trace_.samples.push_back(sample);
    any_valid_ = any_valid_ || sample.eyes[0].valid || sample.eyes[1].valid;
    for (const std::size_t e : {0U, 1U}) {
        trace_.report.valid[e] += sample.eyes[e].valid ? 1 : 0;
    }
}

Expected<gaze::GazeTrace> TraceBuilder::finish(const ReadOptions& /*options*/) {
    if (trace_.samples.empty()) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: no rows after the header", trace_.file)});
    }
    if (!any_valid_) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("no valid gaze in {}", trace_.file)});
    }
    align_arrivals(trace_.samples);
    trace_.report.lost_by_tracker = trace_.rows_missing;
    return std::move(trace_);
}

}  // namespace gazeloop::drivers
