#pragma once

#include <string_view>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/read_options.h"
#include "drivers/trace/text/text_lines.h"
#include "drivers/trace/trace_format.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

inline constexpr std::string_view kEyelinkAsc = "eyelink-asc";

/// Whether a file that begins with this line is what SR Research's edf2asc writes.
[[nodiscard]] bool is_eyelink_asc(std::string_view first_line);

/// An ASC file of EyeLink trackers: lines of samples (time in ms; x, y in pixels and the pupil of
/// each recorded eye; "." where it was not seen) among messages and events, which are left out. The
/// resolution is that of the message GAZE_COORDS or DISPLAY_COORDS, pixel centres at whole numbers;
/// the screen's size and distance stand in a JSON file beside it (screen_sidecar.h). The head's
/// frame is the screen's, and each eye's point is seen from the middle between the eyes.
///
/// Errors (BadInput): samples that are not GAZE (HREF, PUPIL), samples before a line SAMPLES says
/// of which eyes, no geometry, a sample with fewer cells, those of TextLines and TraceBuilder.
[[nodiscard]] Expected<BuiltTrace> read_eyelink_asc(TextLines lines, const TraceFile& file,
                                                    const ReadOptions& options);

}  // namespace gazeloop::drivers
