#include "runtime/recordings/trace_log.h"

#include <spdlog/spdlog.h>

#include "runtime/report/trace_account.h"

namespace gazeloop::recordings {

void log_trace(const gaze::GazeTrace& trace) {
    const auto level = trace.report.worth_a_warning() ? spdlog::level::warn : spdlog::level::info;
    for (const std::string& event : report::trace_events(trace.report)) {
        if (report::is_finding(event)) {
            spdlog::log(level, "{}", report::at_file(trace.file, event));
        }
    }
}

}  // namespace gazeloop::recordings
