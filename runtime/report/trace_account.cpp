#include "runtime/report/trace_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "runtime/frame/event.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

using gaze::TraceFindingKind;
using Json = nlohmann::ordered_json;

constexpr std::string_view kRows = "rows ";
constexpr std::string_view kDirections = "directions: ";
constexpr std::string_view kClock = "clock: ";
constexpr std::string_view kDropped = "dropped as ";
constexpr std::string_view kOutOfOrder = "out of order";
constexpr std::string_view kLost = "lost by the tracker";
constexpr std::string_view kUnknown = "unknown";

std::string_view name_of(std::size_t kind) { return gaze::kTraceFindingNames[kind]; }

std::string counts_text(const gaze::TraceReport& report) {
    std::string text = fmt::format("{}{}, used {}", kRows, report.rows,
                                   report.rows - std::min(report.rows, report.rows_dropped()));
    const auto add = [&text](const std::string& what, std::uint64_t count) {
        text += count > 0 ? fmt::format(", {} {}", what, count) : "";
    };
    for (std::size_t kind = 0; kind < gaze::kTraceFindingKinds; ++kind) {
        add(fmt::format("{}{}", kDropped, name_of(kind)),
            report.count(static_cast<TraceFindingKind>(kind)).dropped);
    }
    add(std::string(kOutOfOrder), report.count(TraceFindingKind::OutOfOrder).rows);
    if (!report.lost_by_tracker) {
        return text + fmt::format(", {} {}", kLost, kUnknown);
    }
    add(std::string(kLost), *report.lost_by_tracker);
    return text;
}

/// The number of the line that a finding begins with, and what follows.
std::pair<std::optional<std::uint64_t>, std::string_view> line_of(std::string_view finding) {
    std::uint64_t line = 0;
    const char* const end = finding.data() + finding.size();
    const auto [stopped, error] = std::from_chars(finding.data(), end, line);
    const std::string_view rest(stopped, static_cast<std::size_t>(end - stopped));
    if (error != std::errc{} || !rest.starts_with(": ")) {
        return {std::nullopt, finding};
    }
    return {line, rest.substr(2)};
}

Json trace_json(std::string_view counts, const std::vector<std::string>& findings) {
    Json json{{"rows", 0}, {"used", 0}};
    Json dropped = Json::object();
    std::uint64_t out_of_order = 0;
    Json lost = 0;
    while (!counts.empty()) {
        const std::string_view one = counts.substr(0, counts.find(", "));
        counts.remove_prefix(std::min(counts.size(), one.size() + 2));
        const std::size_t blank = one.rfind(' ');
        if (blank == std::string_view::npos) {
            continue;
        }
        const std::string_view what = one.substr(0, blank);
        std::uint64_t count = 0;
        std::from_chars(one.data() + blank + 1, one.data() + one.size(), count);
        if (what == kOutOfOrder) {
            out_of_order = count;
        } else if (what == kLost) {
            lost = one.ends_with(kUnknown) ? Json(nullptr) : Json(count);
        } else if (what.starts_with(kDropped)) {
            dropped[std::string(what.substr(kDropped.size()))] = count;
        } else {
            json[std::string(what)] = count;
        }
    }
    json["dropped"] = dropped;
    json["out_of_order"] = out_of_order;
    json["lost_by_tracker"] = lost;
    json["findings"] = Json::array();
    for (const std::string& finding : findings) {
        const auto [line, rest] = line_of(finding);
        const std::size_t colon = std::min(rest.find(": "), rest.size());
        json["findings"].push_back({{"line", line ? Json(*line) : Json(nullptr)},
                                    {"kind", rest.substr(0, colon)},
                                    {"text", rest.substr(std::min(colon + 2, rest.size()))}});
    }
    return json;
}

}  // namespace

std::vector<std::string> trace_events(const gaze::TraceReport& report) {
    if (report.rows == 0) {
        return {};
    }
    std::vector<std::string> events{counts_text(report)};
    if (!report.clock.empty()) {
        events.push_back(fmt::format("{}{}", kClock, report.clock));
    }
    if (!report.axes.empty()) {
        events.push_back(fmt::format("{}{}", kDirections, report.axes));
    }
    std::array<gaze::TraceFindingCount, gaze::kTraceFindingKinds> kept{};
    for (const gaze::TraceFinding& finding : report.findings()) {
        const auto kind = static_cast<std::size_t>(finding.kind);
        ++kept[kind].times;
        kept[kind].rows += finding.rows;
        std::string text = finding.line > 0 ? fmt::format("{}: {}", finding.line, name_of(kind))
                                            : std::string(name_of(kind));
        if (finding.line > 0 && finding.rows > 1) {
            text += fmt::format(" ({} rows)", finding.rows);
        }
        events.push_back(fmt::format("{}: {}", text, finding.text));
    }
    for (std::size_t kind = 0; kind < gaze::kTraceFindingKinds; ++kind) {
        const gaze::TraceFindingCount& all = report.count(static_cast<TraceFindingKind>(kind));
        if (all.times > kept[kind].times) {
            events.push_back(fmt::format("{}: and {} more ({} rows)", name_of(kind),
                                         all.times - kept[kind].times, all.rows - kept[kind].rows));
        }
    }
    return events;
}

bool is_finding(std::string_view event) {
    return !event.starts_with(kRows) && !event.starts_with(kClock) &&
           !event.starts_with(kDirections);
}

std::string at_file(const std::string& file, std::string_view event) {
    return line_of(event).first ? fmt::format("{}:{}", file, event)
                                : fmt::format("{}: {}", file, event);
}

std::string at_line(std::string_view event) {
    return fmt::format("{}{}", line_of(event).first ? "line " : "", event);
}

void TraceAccount::take(std::string_view kind, std::string_view text) {
    if (kind == frame::kAxesEvent.name) {
        directions_ = text;  // a summary's "what happened" has it, too
    } else if ((kind == frame::kTraceEvent.name || kind == frame::kTrackerEvent.name) &&
               text.starts_with(kDirections)) {
        directions_ = text.substr(kDirections.size());
    } else if (kind == frame::kTraceEvent.name && text.starts_with(kClock)) {
        clock_ = text.substr(kClock.size());
    } else if (kind == frame::kTraceEvent.name && !is_finding(text)) {
        counts_ = text;
    } else if (kind == frame::kTraceEvent.name) {
        findings_.emplace_back(text);
    }
}

std::string TraceAccount::text() const {
    std::string text = counts_.empty() ? "" : wrapped_row("trace", counts_);
    if (!clock_.empty()) {
        text += wrapped_row("", fmt::format("{}{}", kClock, clock_));
    }
    for (const std::string& finding : findings_) {
        text += wrapped_row("", at_line(finding));
    }
    return text;
}

void TraceAccount::add_to(Json& summary) const {
    summary["trace"] = counts_.empty() ? Json(nullptr) : trace_json(counts_, findings_);
    if (!clock_.empty()) {
        summary["trace"]["clock"] = clock_;
    }
    summary["directions"] = directions_.empty() ? Json(nullptr) : Json(directions_);
}

}  // namespace gazeloop::report
