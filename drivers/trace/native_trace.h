#pragma once

#include <ostream>
#include <string>

#include "drivers/trace/trace_format.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// gazeloop's own trace: CSV with ',' and a header. Columns, in any order:
///
///     sequence                   counts up by one per report; gaps are losses
///     t_device_ns                the tracker's clock
///     t_host_ns                  host clock at the arrival; blank where nobody recorded it
///     left_valid                 1 or 0
///     left_x, left_y, left_z     unit vector in the head frame (+X right, +Y up, -Z forward)
///     left_origin_x_m, ...y_m, ...z_m
///     left_openness, left_confidence      0 .. 1; -1 or blank: unknown
///     right_...                  the same
///     head_x_m, head_y_m, head_z_m, head_qx, head_qy, head_qz, head_qw
///                                head in world; all blank where unknown
///     parallax_rad               as GazeSample has it; written where a sample has one
///
/// Only t_device_ns and, of one eye, validity and direction are needed: what has no column, a blank
/// cell or NaN is unknown. A direction or orientation that is not of unit length is made so; a
/// valid eye's direction that is zero makes the eye invalid, and counts as bad cells.
///
/// A JSON sidecar may stand beside it, FILE.json (of FILE.gz too): format "gazeloop-gaze", version
/// 1, axes
/// "+x right, +y up, -z forward", clock, rate_hz, device, calibration. If it is there, format,
/// version and axes must be these.
///
/// Writing a trace and reading it gives the same samples, bit for bit.
[[nodiscard]] const TraceFormat& native_trace();

/// The device that the sidecar of a trace file names: "" without a sidecar. Errors (BadInput): not
/// JSON, another format, version or axes.
[[nodiscard]] Expected<std::string> read_native_sidecar(const std::string& trace_file);

/// Writes the CSV. Numbers have as many digits as it takes to read them back exactly. Times and
/// numbers that are unknown or not finite are left blank.
void write_native_trace(const gaze::RecordingView& trace, std::ostream& out);

/// Writes the CSV, gzip where the name ends with .gz, and its sidecar. Errors (BadInput): a file
/// that cannot be written.
[[nodiscard]] Expected<void> write_native_trace(const gaze::RecordingView& trace,
                                                const std::string& file);

}  // namespace gazeloop::drivers
