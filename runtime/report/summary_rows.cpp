#include "runtime/report/summary_rows.h"

#include "runtime/report/row_names.h"

namespace gazeloop::report {

std::vector<NamedRow> rows_of(const latency::SummaryReport& report) {
    std::vector<NamedRow> rows;
    const auto add = [&rows](const RowName& name, const latency::DurationRow& row) {
        rows.push_back({name, &row});
    };
    add(kGazeAgeAtLatch, report.gaze_age_at_latch);
    if (report.gaze_age_read_at_begin.count > 0) {
        add(kGazeAgeReadAtBegin, report.gaze_age_read_at_begin);
    }
    add(kGazeAgeAtDisplay, report.gaze_age_at_display);
    if (report.gaze_age_uncertainty.count > 0) {
        add(kGazeAgeUncertainty, report.gaze_age_uncertainty);
    }
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (report.stages[stage].count > 0 || !latency::shown_only_if_known(stage)) {
            add(stage_name(stage), report.stages[stage]);
        }
    }
    add(kUnaccounted, report.unaccounted);
    if (report.held_gaze_age_at_display.count > 0) {
        add(kHeldGazeAge, report.held_gaze_age_at_display);
    }
    add(kFrameInterval, report.frame_interval);
    add(kLoopTime, report.loop_time);
    for (std::size_t pass = 0; pass < report.config.passes.size(); ++pass) {
        if (report.passes[pass].count > 0) {
            add(pass_name(report.config.passes[pass]), report.passes[pass]);
        }
    }
    return rows;
}

}  // namespace gazeloop::report
