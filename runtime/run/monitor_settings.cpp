#include "runtime/run/monitor_settings.h"

namespace gazeloop::run {

std::vector<settings::SettingRow> rows_of(MonitorSettings& monitor) {
    using settings::Concerns;
    using settings::Number;
    return {
        {"monitor.interval_s", "from one line of --monitor-json to the next, by the frames' time",
         Number{&monitor.interval_s, 0.01, 3600.0}, Concerns::Machine},
        {"monitor.window_s", "what a budget is held against: the last seconds, 20 frames at least",
         Number{&monitor.window_s, 0.0, 30.0}, Concerns::Machine},
    };
}

}  // namespace gazeloop::run
