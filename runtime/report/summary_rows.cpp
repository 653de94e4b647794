#include "runtime/report/summary_rows.h"

#include <array>

#include "runtime/report/frame_log.h"
#include "runtime/report/row_names.h"

namespace gazeloop::report {
namespace {

/// Calls visit(name, row, whether every run has it), in the order in which rows are shown.
template <typename Report, typename Visit>
void visit_rows(Report& report, Visit visit) {
    visit(kGazeAgeAtLatch, report.gaze_age_at_latch, true);
    visit(kGazeAgeReadAtBegin, report.gaze_age_read_at_begin, false);
    visit(kGazeAgeAtDisplay, report.gaze_age_at_display, true);
    visit(kGazeAgeUncertainty, report.gaze_age_uncertainty, false);
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        visit(stage_name(stage), report.stages[stage], !latency::shown_only_if_known(stage));
    }
    visit(kUnaccounted, report.unaccounted, true);
    visit(kHeldGazeAge, report.held_gaze_age_at_display, false);
    visit(kFrameInterval, report.frame_interval, true);
    visit(kLoopTime, report.loop_time, true);
    for (std::size_t pass = 0; pass < report.config.passes.size(); ++pass) {
        visit(pass_name(report.config.passes[pass]), report.passes[pass], false);
    }
}

}  // namespace

std::vector<NamedRow> rows_of(const latency::SummaryReport& report) {
    std::vector<NamedRow> rows;
    visit_rows(report, [&rows](const RowName& name, const latency::DurationRow& row, bool always) {
        if (always || row.count > 0) {
            rows.push_back({name, &row});
        }
    });
    return rows;
}

void take_exact_percentiles(const FrameLog& frames, latency::SummaryReport& report) {
    constexpr std::array kPercents{50.0, 95.0, 99.0};
    constexpr double kNsPerMs = 1e6;
    visit_rows(report, [&](const RowName& name, latency::DurationRow& row, bool) {
        if (row.count == 0) {
            return;
        }
        const auto exact = frames.at(name.key).percentiles(kPercents);
        const auto ms = [&](std::size_t percentile) {
            return exact[percentile]
                       ? std::optional(static_cast<double>(*exact[percentile]) / kNsPerMs)
                       : std::nullopt;
        };
        row.p50_ms = ms(0);
        row.p95_ms = ms(1);
        row.p99_ms = ms(2);
    });
}

}  // namespace gazeloop::report
