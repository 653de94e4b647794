#include "runtime/cli/recorded_gaze_options.h"

#include <fmt/ranges.h>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/read_trace.h"

namespace gazeloop::cli {

std::string trace_formats_text() {
    return fmt::format("auto, {}", fmt::join(drivers::trace_format_names(), ", "));
}

void RecordedGazeOptions::add_to(Command app) {
    app.option("--format", read.format, trace_formats_text());
    app.option("--axes", axes, "turn its directions")
        .one_of({drivers::kAxesCorrectionNames.begin(), drivers::kAxesCorrectionNames.end()});
    app.flag("--accept-repairs", read.accept_repairs,
             "it may be one of which much was dropped or changed");
}

drivers::ReadOptions RecordedGazeOptions::read_options() const {
    drivers::ReadOptions options = read;
    options.axes = drivers::axes_correction_named(axes);
    return options;
}

}  // namespace gazeloop::cli
