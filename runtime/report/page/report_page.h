#pragma once

#include <string>
#include <vector>

#include "runtime/latency/budget.h"
#include "runtime/report/page/event_line.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/session_summary.h"
#include "runtime/session/session_info.h"

namespace gazeloop::report::page {

/// What another part of the report has to say on the page: a heading, paragraphs, a table with a
/// row of heads (empty: none), and lines. The first cell of a row is its label.
struct PageSection {
    std::string id;  ///< of the heading, for links: letters and hyphens
    std::string title;
    std::vector<std::string> paragraphs{};
    std::vector<std::string> heads{};
    std::vector<std::vector<std::string>> rows{};
    std::string lines{};  ///< as in a terminal: their blanks count
};

/// Everything that a page shows. Texts are any bytes: what they hold is shown, and never becomes a
/// part of the page's own language.
struct PageContents {
    const SessionSummary& session;
    const session::SessionInfo& info;
    const EventLine& events;
    const Percentiles& percentiles;
    std::string file;                                ///< of the session, as it was named
    const latency::LatencyBudget* budget = nullptr;  ///< null: none is in force
    std::vector<std::string> why{};                  ///< why the fovea lags; empty: nobody says
    std::vector<PageSection> sections{};             ///< after the stages, in this order
};

/// The report of a session as one HTML file that needs nothing else, below 5 MB whatever the
/// session's length. Its numbers are those of session_json().
[[nodiscard]] std::string report_page(const PageContents& contents);

}  // namespace gazeloop::report::page
