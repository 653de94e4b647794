#pragma once

#include <string_view>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/read_options.h"
#include "drivers/trace/text/text_lines.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

inline constexpr std::string_view kTobiiGlasses3 = "tobii-glasses-3";

/// Whether a file that begins with this line has a JSON object per line.
[[nodiscard]] bool is_json_lines(std::string_view first_line);

/// gazedata of Tobii Pro Glasses 3: a JSON object per line with type, timestamp (seconds) and data,
/// in which each eye has gazeorigin (mm) and gazedirection, or is missing. Lines of another type
/// are left out. In the file +X is left, +Y up, +Z forward (the left eye lies at +X).
///
/// Errors (BadInput): those of TextLines; a line that is no JSON object, unless it is a last one
/// that was cut; those of TraceBuilder.
[[nodiscard]] Expected<BuiltTrace> read_tobii_glasses_3(TextLines lines,
                                                        const ReadOptions& options);

}  // namespace gazeloop::drivers
