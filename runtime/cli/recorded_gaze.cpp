#include "runtime/cli/recorded_gaze.h"

#include <fmt/ranges.h>

#include <utility>

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/read_trace.h"
#include "runtime/run/trace_of_session.h"

namespace gazeloop::cli {
namespace {

drivers::ReadOptions read_options(const RecordedGazeOptions& options) {
    drivers::ReadOptions read = options.read;
    read.axes = drivers::axes_correction_named(options.axes);
    return read;
}

gaze::GazeTrace session_gaze(const std::string& file) {
    return run::trace_of_session(value_or_throw(session::OpenSession::open(file)));
}

}  // namespace

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

gaze::GazeTrace recorded_gaze(const std::string& file, const RecordedGazeOptions& options) {
    return session::looks_like_session(file)
               ? session_gaze(file)
               : value_or_throw(drivers::read_trace(file, read_options(options)));
}

gaze::GazeTrace recorded_gaze_even_refused(const std::string& file,
                                           const RecordedGazeOptions& options,
                                           std::string& refusal) {
    if (session::looks_like_session(file)) {
        return session_gaze(file);
    }
    drivers::ReadOptions read = read_options(options);
    auto trace = drivers::read_trace(file, read);
    if (trace || read.accept_repairs) {
        return value_or_throw(std::move(trace));
    }
    read.accept_repairs = true;
    auto repaired = drivers::read_trace(file, read);
    if (!repaired) {
        throw SetupError(trace.error());
    }
    refusal = trace.error().message;
    return std::move(*repaired);
}

}  // namespace gazeloop::cli
