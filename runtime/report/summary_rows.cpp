#include "runtime/report/summary_rows.h"

#include <algorithm>

namespace gazeloop::report {

std::vector<NamedRow> rows_of(const latency::SummaryReport& report) {
    std::vector<NamedRow> rows{
        {"gaze_age_at_latch", "gaze age at latch", &report.gaze_age_at_latch},
        {"gaze_age_at_display", "gaze age at display", &report.gaze_age_at_display}};
    if (report.gaze_age_uncertainty.count > 0) {
        rows.push_back({"gaze_age_uncertainty", "  uncertain by", &report.gaze_age_uncertainty});
    }
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (report.stages[stage].count == 0 && latency::shown_only_if_known(stage)) {
            continue;
        }
        std::string key = "stage_" + std::string(latency::kStageNames[stage]);
        std::replace(key.begin(), key.end(), ' ', '_');
        rows.push_back(
            {key, "  " + std::string(latency::kStageNames[stage]), &report.stages[stage]});
    }
    rows.push_back({"unaccounted", "  unaccounted", &report.unaccounted});
    if (report.held_gaze_age_at_display.count > 0) {
        rows.push_back(
            {"held_gaze_age_at_display", "held gaze at display", &report.held_gaze_age_at_display});
    }
    rows.push_back({"frame_interval", "frame interval", &report.frame_interval});
    rows.push_back({"loop_time", "loop (cpu)", &report.loop_time});
    for (std::size_t pass = 0; pass < report.config.passes.size(); ++pass) {
        if (report.passes[pass].count > 0) {
            const std::string& name = report.config.passes[pass];
            rows.push_back({"pass_" + name, "pass " + name, &report.passes[pass]});
        }
    }
    return rows;
}

}  // namespace gazeloop::report
