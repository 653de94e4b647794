#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/trace/row_samples.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// A trace as its file has it, before its directions are judged.
struct BuiltTrace {
    std::string file;
    std::string format;
    std::string device;
    std::shared_ptr<RowSamples> samples;
    memory::LongVector<std::uint64_t> lines;  ///< of the file, for each sample
    gaze::TraceReport report;
};

}  // namespace gazeloop::drivers
