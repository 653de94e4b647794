#include "runtime/recordings/recorded_gaze.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "drivers/trace/read_trace.h"
#include "runtime/recordings/trace_of_session.h"

namespace gazeloop::recordings {
namespace {

gaze::GazeRecording session_gaze(const std::string& file) {
    const session::OpenSession session = value_or_throw(session::OpenSession::open(file));
    gaze::GazeRecording trace = trace_of_session(session);
    if (!session.info().missing_log.empty()) {
        spdlog::warn("{}: {}", file, session.info().missing_log);
    }
    return trace;
}

}  // namespace

gaze::GazeRecording recorded_gaze(const std::string& file, const drivers::ReadOptions& options) {
    return session::looks_like_session(file)
               ? session_gaze(file)
               : value_or_throw(drivers::read_recording(file, options));
}

gaze::GazeRecording recorded_gaze_even_refused(const std::string& file,
                                               const drivers::ReadOptions& options,
                                               std::string& refusal) {
    if (session::looks_like_session(file)) {
        return session_gaze(file);
    }
    auto trace = drivers::read_recording(file, options);
    if (trace || options.accept_repairs) {
        return value_or_throw(std::move(trace));
    }
    drivers::ReadOptions accepting = options;
    accepting.accept_repairs = true;
    auto repaired = drivers::read_recording(file, accepting);
    if (!repaired) {
        throw SetupError(trace.error());
    }
    refusal = trace.error().message;
    return std::move(*repaired);
}

}  // namespace gazeloop::recordings
