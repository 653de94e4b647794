#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "drivers/trace/screen_geometry.h"
#include "drivers/trace/trace_format.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

/// What a JSON file beside a trace says of the screen that was looked at:
///
///     screen_size_m     [width, height]
///     screen_px         [width, height]
///     view_distance_m   from the middle of the screen
///     missing           "x and y are 0,0" where such rows are losses; optional
struct ScreenSidecar {
    ScreenGeometry screen;
    bool zero_is_missing = false;
};

/// Reads NAME.json for NAME.csv or NAME.csv.gz, or NAME.csv.json. `size_px` is known where the
/// trace itself says the resolution: then screen_px is not needed. `name` is the trace's in
/// messages. Errors (BadInput): no such file, or the trace is a stream; a key that is missing; what
/// is no screen (ScreenGeometry::check).
[[nodiscard]] Expected<ScreenSidecar> read_screen_sidecar(
    const TraceFile& file, const std::string& name,
    const std::optional<glm::dvec2>& size_px = std::nullopt);

}  // namespace gazeloop::drivers
