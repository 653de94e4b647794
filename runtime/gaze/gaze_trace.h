#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::gaze {

/// A recorded gaze stream in our axes and units, whatever file it came from.
///
/// `sampled` of each sample is its time since the trace's first sample, Modelled, at the rate of
/// the host's clock where the file has host times and of the device's else. `uncertainty_ns` is
/// known where that clock counts in coarse steps. `arrived` is unknown unless the file has host
/// times. If it has, `arrived` is Modelled, on the same time line, and shifted so that the quickest
/// report took no time at all (TraceSource adds the tracker's delay). Times increase. Gaps in
/// `sequence` are what the tracker lost. What was dropped, mended or put in order is in the report.
/// At least one sample has a valid eye.
///
/// A recorded session's gaze is unchanged, in the order of its arrival, the first sample at 0:
/// `sampled` may be unknown or go back, `ready` may be known.
struct GazeTrace {
    std::string file{};
    std::string format{};  ///< "gazeloop", "htc-vive-pro"
    std::string device{};  ///< as the file states it, else the format's device
    std::vector<gaze::GazeSample> samples{};
    TraceReport report{};  ///< what the file's reader found
    /// Of the file, for each sample, while its readers judge it; empty else.
    std::vector<std::uint64_t> lines{};
};

}  // namespace gazeloop::gaze
