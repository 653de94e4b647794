#include "runtime/report/recording_text.h"

#include <fmt/format.h>

namespace gazeloop::report {
namespace {

/// Where a recording ends that was not closed, and what is known of what it lacks.
std::string end_of(const session::SessionInfo& info, const session::PlaybackEnd& end) {
    std::string text = "The recording was not closed: it ";
    text += end.last_frame ? fmt::format("ends at frame {}.", *end.last_frame) : "has no frames.";
    if (!info.missing_log.empty()) {
        text += fmt::format(" But {}.", info.missing_log);
    } else if (info.writing_failed) {
        text += " Writing it failed there.";
    } else if (info.had_write_ahead_log) {
        text += " It lacks at most its last 100 ms.";
    }
    return text;
}

}  // namespace

std::vector<std::string> recording_lines(const session::SessionInfo& info,
                                         const session::PlaybackEnd& end) {
    std::vector<std::string> lines;
    if (!info.closed_cleanly) {
        lines.push_back(end_of(info, end));
    }
    if (end.last_error) {
        lines.push_back(fmt::format("The run failed: {}", *end.last_error));
    }
    if (info.records_dropped > 0) {
        lines.push_back(
            fmt::format("The recording lacks {} records that the disk was too slow for.",
                        info.records_dropped));
    }
    return lines;
}

}  // namespace gazeloop::report
