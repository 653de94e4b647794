#include "runtime/run/run_summary.h"

#include <nlohmann/json.hpp>

#include "runtime/report/prediction_text.h"
#include "runtime/report/summary_json.h"
#include "runtime/report/summary_text.h"

namespace gazeloop::run {

std::string run_summary_text(const RunSummary& run, bool quiet) {
    std::string text;
    if (!quiet) {
        if (run.clock == RunClock::Recorded) {
            text += "replay of a recording: times are the recorded ones, passes are of this run\n";
        }
        if (run.fixed_in_head && run.clock == RunClock::Wall) {
            text += "fixed gaze: no tracker; ages count from the latch\n";
        }
        text += report::summary_text(run.report, run.clock == RunClock::Wall
                                                     ? report::lag_paragraph(run.reasons)
                                                     : report::lag_text(run.reasons));
        text += left_out_text(run.left_out, run.report);
        text += run.trace.text();
        text += run.monitor.text();
    }
    if (run.check != nullptr) {
        text += run.check->text();
    }
    if (run.hash != nullptr) {
        text += run.hash->text();
    }
    if (run.levels != nullptr && !quiet) {
        text += run.levels->text();
    }
    return text;
}

nlohmann::ordered_json run_summary_json(const RunSummary& run) {
    nlohmann::ordered_json json = report::summary_json(run.report);
    json["left_out"] = left_out_json(run.left_out, run.report);
    run.trace.add_to(json);
    run.monitor.add_to(json);
    if (run.levels != nullptr) {
        json["governor"] = run.levels->json();
    }
    json["why_the_fovea_lags"] = report::lag_json(run.reasons);
    json["prediction"] = report::prediction_json(run.prediction);
    if (run.hash != nullptr) {
        json["hash"] = run.hash->json();
    }
    if (run.check != nullptr) {
        json["replay"] = run.check->json();
    }
    return json;
}

}  // namespace gazeloop::run
