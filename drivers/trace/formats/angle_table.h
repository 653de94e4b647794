#pragma once

#include <ostream>

#include "drivers/trace/trace_format.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// Gaze as people look at it in a table: CSV with time_s, and of each EYE EYE_azimuth_deg (positive
/// right), EYE_elevation_deg (positive up), blank where the eye was lost, EYE_openness and
/// EYE_confidence; then head_x_m to head_z_m and head_qx to head_qw. Places of the eyes and
/// arrivals are not in it (native_trace.h).
[[nodiscard]] const TraceFormat& angle_table();

/// Writes it, times since the first sample; samples whose time is unknown are left out.
void write_angle_table(const gaze::RecordingView& trace, std::ostream& out);

}  // namespace gazeloop::drivers
