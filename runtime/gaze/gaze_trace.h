#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"
#include "runtime/gaze/sample_rate.h"
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
};

/// The same of any length: its samples are read as often as they are asked for.
struct GazeRecording {
    std::string file{};
    std::string format{};
    std::string device{};
    std::shared_ptr<SampleSource> samples{};  ///< never null
    TraceReport report{};
};

/// Reads all of them.
[[nodiscard]] GazeTrace in_memory(GazeRecording recording);

/// Either, for whoever looks at it from front to back; it must be there meanwhile.
struct RecordingView {
    RecordingView(const GazeTrace& trace)  // NOLINT(*-explicit-*): as a span
        : file(trace.file),
          format(trace.format),
          device(trace.device),
          samples(trace.samples),
          report(trace.report) {}
    RecordingView(const GazeRecording& recording)  // NOLINT(*-explicit-*)
        : file(recording.file),
          format(recording.format),
          device(recording.device),
          samples(*recording.samples),
          report(recording.report) {}

    /// sample_rate.h, which the reader of a file has asked already.
    [[nodiscard]] double rate_hz() const {
        return report.rate_hz > 0.0 ? report.rate_hz : sample_rate_hz(samples);
    }

    const std::string& file;
    const std::string& format;
    const std::string& device;
    SampleRange samples;
    const TraceReport& report;
};

}  // namespace gazeloop::gaze
