#include "runtime/session_report/session_report.h"

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/report/comparison_text.h"
#include "runtime/report/page/report_page.h"
#include "runtime/report/page/report_sections.h"
#include "runtime/report/prediction_text.h"
#include "runtime/report/recording_text.h"
#include "runtime/report/session_json.h"
#include "runtime/report/session_text.h"

namespace gazeloop::session_report {

std::string text_of(const SessionReport& made) {
    const report::SessionSummary& summary = made.summary;
    std::string recording;
    for (const std::string& line : report::recording_lines(made.info, summary.end)) {
        recording += fmt::format("{}\n", line);
    }
    // What lacks a part says so before what is made of the rest.
    const bool first = !made.info.missing_log.empty();
    std::string text =
        fmt::format("{}{}{}{}\n{}", first ? recording + "\n" : "",
                    report::session_text(summary, made.percentiles, report::lag_text(made.reasons)),
                    summary.trace.text(), summary.runtime.text(),
                    report::prediction_text(made.prediction, summary.report));
    if (made.levels) {
        text += made.levels->text();
    }
    if (!first) {
        text += recording;
    }
    if (made.measured) {
        text += probe::comparison_text(*made.measured);
    }
    if (made.gate) {
        text += fmt::format("\n{}", report::gate_text(*made.gate));
    }
    if (made.against) {
        text += report::comparison_text(made.against->comparison, made.percentiles,
                                        made.against->before);
    }
    return text;
}

nlohmann::ordered_json json_of(const SessionReport& made) {
    nlohmann::ordered_json json = report::session_json(made.summary, made.info, made.percentiles);
    json["why_the_fovea_lags"] = report::lag_json(made.reasons);
    json["prediction"] = report::prediction_json(made.prediction);
    made.summary.runtime.add_to(json);
    if (made.levels) {
        json["governor"] = made.levels->json();
    }
    if (made.measured) {
        json["probe"] = probe::comparison_json(*made.measured);
    }
    if (made.gate) {
        json["budget"] = report::gate_json(*made.gate);
    }
    if (made.against) {
        json["against"] = report::comparison_json(made.against->comparison, made.percentiles,
                                                  made.against->before);
    }
    return json;
}

std::string page_of(const SessionReport& made, const std::string& file) {
    std::vector<report::page::PageSection> sections{
        report::page::section_of(report::prediction_table(made.prediction, made.summary.report))};
    if (const std::string runtime = made.summary.runtime.text(); !runtime.empty()) {
        sections.push_back(
            report::page::section_of_lines("runtime", "The runtime's own account", runtime));
    }
    if (made.levels) {
        sections.push_back(
            report::page::section_of_lines("governor", "Levels of quality", made.levels->text()));
    }
    if (made.measured) {
        sections.push_back(report::page::section_of_lines("probe", "Eye to photon, as measured",
                                                          probe::comparison_text(*made.measured)));
    }
    if (made.gate) {
        sections.push_back(report::page::section_of(*made.gate));
    }
    if (made.against) {
        sections.push_back(report::page::section_of(made.against->comparison, made.percentiles,
                                                    made.against->before));
    }
    return report::page::report_page({.session = made.summary,
                                      .info = made.info,
                                      .events = made.events,
                                      .percentiles = made.percentiles,
                                      .file = std::filesystem::path(file).filename(),
                                      .budget = made.budget ? &*made.budget : nullptr,
                                      .why = report::page::why_of(made.reasons),
                                      .sections = sections});
}

}  // namespace gazeloop::session_report
