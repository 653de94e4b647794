#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/report/runtime_metrics/runtime_account.h"

namespace gazeloop::session_report {

/// What is to be told of a session, and where. Files: "-" is stdout, empty: not asked for.
struct ReportRequest {
    std::string file;                        ///< the session
    std::optional<std::string> percentiles;  ///< see report::Percentiles::parse; none: the usual
    std::string csv;                         ///< every frame
    std::string html;                        ///< one page with plots
    std::string json;
    std::string perfetto;                   ///< a trace for ui.perfetto.dev
    std::string perfetto_samples = "used";  ///< gaze samples in it: "used" by frames, or "all"
    report::RuntimeFiles runtime{};         ///< of the session's run
    std::string against;                    ///< an earlier session; empty: none
    std::string probe;                      ///< a measurement (probe/measurement.h); empty: none
    std::string budget;                     ///< a name or a .toml file; empty: none
    std::optional<double> budget_ms;        ///< instead: of the gaze age at display alone
    bool quiet = false;                     ///< nothing on stdout that is not asked for

    /// The outputs with their options.
    [[nodiscard]] std::array<std::pair<std::string_view, const std::string*>, 4> outputs() const {
        return {{{"--csv", &csv}, {"--html", &html}, {"--json", &json}, {"--perfetto", &perfetto}}};
    }
    /// Whether stdout is left for people.
    [[nodiscard]] bool tells() const {
        return !quiet && csv != "-" && html != "-" && json != "-" && perfetto != "-";
    }
};

/// Plays the session and tells all that was asked for. @throws SetupError: Usage for what was asked
/// for wrongly, BadInput for what cannot be read or written, GateFailed where the session does not
/// keep the budget
void report_session(const ReportRequest& request);

}  // namespace gazeloop::session_report
