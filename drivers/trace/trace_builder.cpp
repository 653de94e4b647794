#include "drivers/trace/trace_builder.h"

#include <fmt/format.h>

#include <utility>

namespace gazeloop::drivers {

TraceBuilder::TraceBuilder(std::string file, std::string_view format, std::string_view device) {
    trace_.file = std::move(file);
    trace_.format = format;
    trace_.device = device;
}

void TraceBuilder::add(const gaze::GazeSample& sample) {
    if (sequence_ && sample.sequence > *sequence_) {
        trace_.rows_missing += sample.sequence - *sequence_ - 1;
    }
    sequence_ = sample.sequence;

    if (!trace_.samples.empty() && sample.sampled.ns <= trace_.samples.back().sampled.ns) {
        ++trace_.rows_out_of_order;
        return;
    }
    trace_.samples.push_back(sample);
    any_valid_ = any_valid_ || sample.eyes[0].valid || sample.eyes[1].valid;
}

Expected<gaze::GazeTrace> TraceBuilder::finish() {
    if (trace_.samples.empty()) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: no rows after the header", trace_.file)});
    }
    if (!any_valid_) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("no valid gaze in {}", trace_.file)});
    }
    return std::move(trace_);
}

}  // namespace gazeloop::drivers
