#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/latency/monitor_snapshot.h"

namespace gazeloop::report {

struct PanelOptions {
    int columns = 80;
    int rows = 24;
    bool colour = false;
    std::string_view budget{};  ///< its name; empty: none
};

/// One line of a panel: `columns` of text, which may hold colours besides.
struct PanelLine {
    std::string text;
    int columns = 0;
};

/// Where a run stands, for a terminal. No line is longer than the terminal is wide, and there are
/// fewer of them than it has rows: where there is no room, columns of figures are left out first,
/// then bars, then the last lines. A bar reaches over `#` to p50, `=` to p95 and `-` to p99, with
/// `|` at the limit; all bars have one scale. Unknown and withheld figures are "-".
std::vector<PanelLine> monitor_panel(const latency::MonitorSnapshot& snapshot,
                                     const PanelOptions& options);

/// The same as one plain line, without its end, for where nothing can be drawn in place.
std::string monitor_line(const latency::MonitorSnapshot& snapshot, std::string_view budget);

}  // namespace gazeloop::report
