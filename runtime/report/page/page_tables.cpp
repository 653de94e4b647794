#include "runtime/report/page/page_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "runtime/frame/event.h"
#include "runtime/report/figures.h"
#include "runtime/report/happenings_text.h"
#include "runtime/report/page/frame_plots.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "runtime/time/span.h"

namespace gazeloop::report::page {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSecondsPerNs = 1e-9;
constexpr std::size_t kParts = 24;  ///< of a session, in the tables beside its plots
constexpr std::size_t kMostEvents = 300;
constexpr std::size_t kMostRuns = 10;
constexpr std::size_t kWide = 12;  ///< characters of a figure: a page has room

std::string trimmed(const std::string& label) {
    return label.substr(std::min(label.find_first_not_of(' '), label.size()));
}

bool indented(const std::string& label) { return label.starts_with(' '); }

std::string cell(const std::optional<double>& value) { return figure(value, kWide); }

std::string cell(const std::optional<std::int64_t>& number, Unit unit) {
    return unit == Unit::Count && number
               ? fmt::format("{}", *number)
               : cell(number ? std::optional(shown(static_cast<double>(*number), unit))
                             : std::nullopt);
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
    if (whole == 0) {
        return "-";
    }
    const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    constexpr double kLeast = 0.05;  // what two decimals round away
    return part > 0 && share < kLeast ? "< 0.1" : fmt::format("{:.1f}", share);
}

std::string_view unit_name(Unit unit) {
    switch (unit) {
        case Unit::Nanoseconds:
            return "ms";
        case Unit::Microdegrees:
            return "degrees";
        case Unit::Count:
            break;
    }
    return "";
}

std::optional<double> seconds_since(const std::optional<std::int64_t>& first,
                                    const std::optional<std::int64_t>& ns) {
    if (!first || !ns) {
        return std::nullopt;
    }
    return static_cast<double>(time::saturated(static_cast<__int128>(*ns) - *first)) *
           kSecondsPerNs;
}

std::vector<RowSpan> parts_of(const FrameLog& frames) {
    const std::size_t rows = frames.rows();
    const std::size_t count = std::min(kParts, rows);
    std::vector<RowSpan> parts;
    parts.reserve(count);
    for (std::size_t part = 0; part < count; ++part) {
        parts.push_back({rows * part / count, rows * (part + 1) / count});
    }
    return parts;
}

TableRow part_row(const FrameLog& frames, const RowSpan& part) {
    return {.label = time_text(axis_s(frames, part.first)),
            .cells = {fmt::format("{}", frames.number(part.first)),
                      fmt::format("{}", part.end - part.first)},
            .show_s = {}};
}

std::vector<TableHead> part_heads() { return {{"from"}, {"first frame"}, {"frames"}}; }

void count_into(TableRow& row, const RowSpan& part, const auto& counts) {
    std::uint64_t found = 0;
    for (std::size_t at = part.first; at < part.end; ++at) {
        found += counts(at) ? 1U : 0U;
    }
    row.cells.push_back(percent(found, part.end - part.first));
}

}  // namespace

std::string time_text(const std::optional<double>& seconds) {
    if (!seconds) {
        return "unknown";
    }
    constexpr double kMinute = 60.0;
    constexpr double kLongest = 1e12;  // beyond it, minutes say nothing
    const double length = std::abs(*seconds);
    if (length < kMinute) {
        return fmt::format("{:.3f} s", *seconds);
    }
    if (length > kLongest) {
        return fmt::format("{:.3e} s", *seconds);
    }
    const auto ms = static_cast<std::uint64_t>(std::llround(length * 1e3));
    constexpr std::uint64_t kMsPerMinute = 60'000;
    constexpr std::uint64_t kMinutesPerHour = 60;
    const std::uint64_t minutes = ms / kMsPerMinute;
    const std::string_view sign = *seconds < 0 ? "-" : "";
    const double rest = static_cast<double>(ms % kMsPerMinute) / 1e3;
    return minutes < kMinutesPerHour
               ? fmt::format("{}{}:{:06.3f}", sign, minutes, rest)
               : fmt::format("{}{}:{:02}:{:06.3f}", sign, minutes / kMinutesPerHour,
                             minutes % kMinutesPerHour, rest);
}

std::optional<double> axis_s(const FrameLog& frames, std::size_t row) {
    return seconds_since(first_wake_up_ns(frames), frames.wake_up_ns(row));
}

std::vector<TableHead> quantity_heads(const Percentiles& percentiles) {
    std::vector<TableHead> heads{{"quantity"}, {"kind"}, {"frames"}, {"min"}, {"mean"}};
    for (const std::string& name : percentiles.names()) {
        heads.push_back({name});
    }
    heads.push_back({"max"});
    return heads;
}

TableRow quantity_line(const SessionRow& row) {
    TableRow line{.label = trimmed(row.name.label),
                  .cells = {kind_text(row.frames_by_kind), fmt::format("{}", row.known),
                            cell(row.least), cell(row.mean)},
                  .key = row.name.key,
                  .indented = indented(row.name.label),
                  .show_s = {}};
    std::ranges::transform(row.percentiles, std::back_inserter(line.cells),
                           [](const auto& value) { return cell(value); });
    line.cells.push_back(cell(row.greatest));
    return line;
}

Table stage_table(const FrameLog& frames, const Percentiles& percentiles) {
    Table table{.heads = quantity_heads(percentiles), .rows = {}};
    const std::vector<SessionRow> rows = rows_of(frames, percentiles.percents());
    for (const Unit unit : {Unit::Nanoseconds, Unit::Microdegrees}) {
        table.rows.push_back({.label = unit == Unit::Nanoseconds ? "milliseconds" : "degrees",
                              .heading = true,
                              .show_s = {}});
        for (const SessionRow& row : rows) {
            if (row.unit != unit) {
                continue;
            }
            table.rows.push_back(quantity_line(row));
        }
    }
    return table;
}

Table worst_table(const FrameLog& frames) {
    Table table{.heads = {{"frame"}}, .rows = {}, .tight = true};
    const std::vector<std::size_t> worst = frames.worst(kWorstFrames);
    if (worst.empty()) {
        return table;
    }
    TableRow times{.label = "at", .show_s = {}};
    TableRow states{.label = "gaze", .show_s = {}};
    for (const std::size_t row : worst) {
        const std::optional<double> at = axis_s(frames, row);
        table.heads.push_back({fmt::format("{}", frames.number(row)), at});
        times.cells.push_back(time_text(at));
        const auto state = frames.state(row);
        states.cells.emplace_back(state ? gaze::kFoveaStateNames[static_cast<std::size_t>(*state)]
                                        : "not rendered");
    }
    table.rows.push_back(std::move(times));
    table.rows.push_back(std::move(states));
    for (const DurationColumn& column : frames.columns()) {
        TableRow line{.label = trimmed(column.label()),
                      .key = column.key(),
                      .indented = indented(column.label()),
                      .show_s = {}};
        if (const std::string_view unit = unit_name(column.unit()); !unit.empty()) {
            line.label += fmt::format(", {}", unit);
        }
        bool known = false;
        for (const std::size_t row : worst) {
            const std::optional<std::int64_t> number = column.at(row);
            known = known || number.has_value();
            line.cells.push_back(cell(number, column.unit()));
        }
        if (known) {
            table.rows.push_back(std::move(line));
        }
    }
    return table;
}

Table violation_table(const FrameLog& frames, std::span<const Violations> all) {
    Table table{.heads = {{"part"},
                          {"limit"},
                          {"frames judged"},
                          {"frames above"},
                          {"% above"},
                          {"runs"},
                          {"longest run, frames"},
                          {"from"}},
                .rows = {}};
    for (const Violations& one : all) {
        const bool counts = one.column->unit() == Unit::Count;
        TableRow row{.label = counts ? "shown later than announced" : one.label,
                     .cells = {counts ? "0 periods" : cell(one.limit, one.column->unit()) + " ms",
                               fmt::format("{}", one.known), fmt::format("{}", one.frames),
                               percent(one.frames, one.known), fmt::format("{}", one.all_runs)},
                     .key = one.column->key(),
                     .show_s = {}};
        if (one.runs.empty()) {
            row.cells.insert(row.cells.end(), {one.known > 0 ? "0" : "-", "-"});
        } else {
            const ViolationRun& longest = one.runs.front();
            row.cells.push_back(fmt::format("{}", longest.frames));
            row.cells.push_back(time_text(axis_s(frames, longest.first)));
            row.show_s = axis_s(frames, longest.first);
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table run_table(const FrameLog& frames, std::span<const Violations> all) {
    Table table{.heads = {{"run"},
                          {"from"},
                          {"first frame"},
                          {"last frame"},
                          {"frames"},
                          {"worst"},
                          {"in frame"}},
                .rows = {}};
    for (const Violations& one : all) {
        for (const ViolationRun& run : one.runs | std::views::take(kMostRuns)) {
            const bool counts = one.column->unit() == Unit::Count;
            table.rows.push_back(
                {.label = one.label,
                 .cells = {time_text(axis_s(frames, run.first)),
                           fmt::format("{}", frames.number(run.first)),
                           fmt::format("{}", frames.number(run.last)),
                           fmt::format("{}", run.frames),
                           cell(run.worst, one.column->unit()) + (counts ? "" : " ms"),
                           fmt::format("{}", frames.number(run.worst_row))},
                 .show_s = axis_s(frames, run.worst_row)});
        }
    }
    return table;
}

Table distribution_table(std::span<const Distribution> distributions,
                         const std::vector<TableHead>& heads) {
    Table table{.heads = {{"from, ms"}, {"to, ms"}}, .rows = {}};
    for (const TableHead& head : heads) {
        table.heads.push_back({head.text + ", frames"});
        table.heads.push_back({head.text + ", % up to here"});
    }
    std::size_t bins = 0;
    for (const Distribution& one : distributions) {
        bins = std::max(bins, one.frames.size());
    }
    std::vector<std::uint64_t> below(distributions.size());
    const auto edge = [&](std::size_t bin) {
        const auto place =
            static_cast<double>(distributions.front().first) +
            static_cast<double>(distributions.front().width) * static_cast<double>(bin);
        return cell(shown(place, Unit::Nanoseconds));
    };
    for (std::size_t bin = 0; bin <= bins && bins > 0; ++bin) {
        TableRow row{.label = edge(bin), .cells = {bin < bins ? edge(bin + 1) : ""}, .show_s = {}};
        bool any = false;
        for (std::size_t i = 0; i < distributions.size(); ++i) {
            const Distribution& one = distributions[i];
            const std::uint64_t frames = one.frames.empty() ? 0
                                         : bin < bins       ? one.frames[bin]
                                                            : one.above;
            any = any || frames > 0;
            below[i] += frames;
            row.cells.push_back(one.known > 0 ? fmt::format("{}", frames) : "-");
            row.cells.push_back(percent(below[i], one.known));
        }
        if (any) {
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table range_table(const FrameLog& frames, std::span<const std::string> keys) {
    Table table{.heads = part_heads(), .rows = {}};
    for (const std::string& key : keys) {
        const DurationColumn& column = frames.at(key);
        for (const char* const what : {"least", "mean", "greatest"}) {
            table.heads.push_back({fmt::format("{}, {}, {}", trimmed(column.label()), what,
                                               unit_name(column.unit()))});
        }
    }
    for (const RowSpan& part : parts_of(frames)) {
        TableRow row = part_row(frames, part);
        for (const std::string& key : keys) {
            const DurationColumn& column = frames.at(key);
            const Bin bin = column.bins(part.first, part.end, 1).front();
            const auto add = [&](double number) {
                row.cells.push_back(bin.known > 0 ? cell(shown(number, column.unit()))
                                                  : std::string("-"));
            };
            add(static_cast<double>(bin.least));
            add(bin.mean);
            add(static_cast<double>(bin.greatest));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table mean_table(const FrameLog& frames, std::span<const std::string> keys) {
    Table table{.heads = part_heads(), .rows = {}};
    for (const std::string& key : keys) {
        table.heads.push_back({trimmed(frames.at(key).label()) + ", ms"});
    }
    for (const RowSpan& part : parts_of(frames)) {
        TableRow row = part_row(frames, part);
        for (const std::string& key : keys) {
            const DurationColumn& column = frames.at(key);
            const Bin bin = column.bins(part.first, part.end, 1).front();
            row.cells.push_back(bin.known > 0 ? cell(shown(bin.mean, column.unit()))
                                              : std::string("-"));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table state_table(const FrameLog& frames) {
    Table table{.heads = part_heads(), .rows = {}};
    for (const std::string_view name : gaze::kFoveaStateNames) {
        table.heads.push_back({fmt::format("{}, %", name)});
    }
    table.heads.push_back({"not rendered, %"});
    for (const RowSpan& part : parts_of(frames)) {
        TableRow row = part_row(frames, part);
        for (std::size_t state = 0; state < gaze::kFoveaStateNames.size(); ++state) {
            count_into(row, part, [&](std::size_t at) {
                return frames.state(at) == static_cast<gaze::FoveaState>(state);
            });
        }
        count_into(row, part, [&](std::size_t at) { return !frames.state(at); });
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table above_table(const FrameLog& frames, std::span<const Violations> all) {
    Table table{.heads = part_heads(), .rows = {}};
    for (const Violations& one : all) {
        table.heads.push_back({one.label + ", % above"});
    }
    for (const RowSpan& part : parts_of(frames)) {
        TableRow row = part_row(frames, part);
        for (const Violations& one : all) {
            count_into(row, part, [&](std::size_t at) {
                const auto number = one.column->at(at);
                return number && *number > one.limit;
            });
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table happening_table(const latency::SummaryReport& report) {
    Table table{.heads = {{"kind"}, {"weight"}, {"times"}, {"first"}, {"last"}, {"what"}},
                .rows = {},
                .text = true};
    const auto at = [](const Json& value) {
        return time_text(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
    };
    for (const Json& one : happenings_json(report)) {
        table.rows.push_back({.label = one["kind"],
                              .cells = {one["warning"].get<bool>() ? "warning" : "notice",
                                        fmt::format("{}", one["times"].get<std::uint64_t>()),
                                        at(one["first_s"]), at(one["last_s"]), one["text"]},
                              .show_s = {}});
    }
    return table;
}

Table event_table(const EventLine& events, const FrameLog& frames) {
    struct Told {
        std::optional<double> seconds;
        const EventLine::Kind* kind;
        const std::string* text;
    };
    const std::optional<std::int64_t> first = first_wake_up_ns(frames);
    std::vector<Told> told;
    for (const EventLine::Kind& kind : events.kinds()) {
        for (const EventLine::Text& text : kind.texts) {
            told.push_back({seconds_since(first, text.ns), &kind, &text.text});
        }
    }
    std::ranges::stable_sort(told, {}, [](const Told& one) { return one.seconds.value_or(0.0); });
    Table table{.heads = {{"at"}, {"kind"}, {"what"}}, .rows = {}, .text = true};
    for (const Told& one : told | std::views::take(kMostEvents)) {
        table.rows.push_back(
            {.label = time_text(one.seconds), .cells = {one.kind->name, *one.text}, .show_s = {}});
    }
    for (const EventLine::Kind& kind : events.kinds()) {
        const auto listed = static_cast<std::uint64_t>(
            std::ranges::count(told | std::views::take(kMostEvents), &kind, &Told::kind));
        if (kind.times > listed) {
            table.rows.push_back(
                {.label = "later",
                 .cells = {kind.name, fmt::format("and {} more", kind.times - listed)},
                 .show_s = {}});
        }
    }
    if (events.others() > 0) {
        table.rows.push_back(
            {.label = "",
             .cells = {"", fmt::format("and {} events of further kinds", events.others())},
             .show_s = {}});
    }
    return table;
}

Table clock_table(const EventLine& events, const FrameLog& frames) {
    const std::optional<std::int64_t> first = first_wake_up_ns(frames);
    Table table{.heads = {{"at"}, {"kind"}, {"what"}}, .rows = {}, .text = true};
    for (const EventLine::Kind& kind : events.kinds()) {
        const bool of_clocks =
            kind.name == frame::kClockEvent.name || kind.name == frame::kGpuClockEvent.name;
        for (const EventLine::Text& text : kind.texts) {
            if (of_clocks || text.text.find("clock") != std::string::npos) {
                table.rows.push_back({.label = time_text(seconds_since(first, text.ns)),
                                      .cells = {kind.name, text.text},
                                      .show_s = {}});
            }
        }
        if (of_clocks && kind.times > kind.texts.size()) {
            table.rows.push_back(
                {.label = "later",
                 .cells = {kind.name, fmt::format("and {} more", kind.times - kind.texts.size())},
                 .show_s = {}});
        }
    }
    return table;
}

Table repair_table(const TraceAccount& trace) {
    Table table{.heads = {{"line"}, {"kind"}, {"what"}}, .rows = {}, .text = true};
    Json json = Json::object();
    trace.add_to(json);
    if (!json["directions"].is_null()) {
        table.rows.push_back(
            {.label = "", .cells = {"directions", json["directions"]}, .show_s = {}});
    }
    const Json& read = json["trace"];
    if (read.is_null()) {
        return table;
    }
    const auto add = [&](const std::string& label, const Json& value) {
        if (value.is_number_unsigned() || value.is_number_integer()) {
            table.rows.push_back({.label = "",
                                  .cells = {label, fmt::format("{}", value.get<std::int64_t>())},
                                  .show_s = {}});
        }
    };
    add("rows", read.value("rows", Json()));
    add("rows used", read.value("used", Json()));
    for (const auto& [why, count] : read.value("dropped", Json::object()).items()) {
        add("dropped as " + why, count);
    }
    add("out of order", read.value("out_of_order", Json()));
    if (read.contains("lost_by_tracker") && read["lost_by_tracker"].is_null()) {
        table.rows.push_back(
            {.label = "", .cells = {"lost by the tracker", "unknown"}, .show_s = {}});
    } else {
        add("lost by the tracker", read.value("lost_by_tracker", Json()));
    }
    if (read.contains("clock")) {
        table.rows.push_back({.label = "", .cells = {"clock", read["clock"]}, .show_s = {}});
    }
    for (const Json& finding : read.value("findings", Json::array())) {
        const Json& line = finding["line"];
        table.rows.push_back(
            {.label = line.is_null() ? "" : fmt::format("{}", line.get<std::uint64_t>()),
             .cells = {finding["kind"], finding["text"]},
             .show_s = {}});
    }
    return table;
}

Table count_table(const PageContents& contents) {
    const latency::SummaryReport& report = contents.session.report;
    const latency::FrameCounts& frames = report.frames;
    Table table{.heads = {{"count"}, {"number"}, {"%"}}, .rows = {}};
    const auto add = [&](std::string label, std::uint64_t number, std::uint64_t of = 0,
                         bool part = false) {
        table.rows.push_back(
            {.label = std::move(label),
             .cells = {fmt::format("{}", number), of > 0 ? percent(number, of) : ""},
             .indented = part,
             .show_s = {}});
    };
    add("frames", frames.total);
    add("rendered", frames.rendered, frames.total, true);
    for (std::size_t state = 0; state < frames.by_state.size(); ++state) {
        add("gaze " + std::string(gaze::kFoveaStateNames[state]), frames.by_state[state],
            frames.rendered, true);
    }
    const std::uint64_t known = frames.rendered - std::min(frames.rendered, frames.in_time_unknown);
    if (known > 0) {
        add("shown later than announced", frames.missed, known, true);
        add("display periods missed by them", frames.periods_missed, 0, true);
    }
    add("in time or not: unknown", frames.in_time_unknown, frames.rendered, true);
    add("shown at an unknown time", frames.display_unknown, frames.rendered, true);
    add("gaze samples received", report.gaze.received);
    add("invalid", report.gaze.invalid, report.gaze.received, true);
    add("lost", report.gaze.lost, 0, true);
    add("out of order", report.gaze.out_of_order, report.gaze.received, true);
    for (std::size_t grid = 0; grid < report.config.grids.size(); ++grid) {
        const frame::GridCounts& counts = report.samples.grids[grid];
        add(fmt::format("samples shaded, {}", report.config.grids[grid]), counts.shaded,
            counts.planned);
    }
    add("records that the disk was too slow for", contents.info.records_dropped);
    for (std::size_t gap = 1; gap < frame::kGazeErrorGapCount; ++gap) {
        std::string why(frame::kGazeErrorGapNames[gap]);
        std::ranges::replace(why, '_', ' ');
        add("gaze error unknown: " + why, contents.session.frames->gaze_error_gaps()[gap],
            frames.rendered);
    }
    return table;
}

Table named_values(std::span<const NamedValue> values) {
    Table table{.heads = {{"name"}, {"value"}}, .rows = {}, .text = true};
    for (const NamedValue& value : values) {
        table.rows.push_back({.label = value.name, .cells = {value.value}, .show_s = {}});
    }
    return table;
}

}  // namespace gazeloop::report::page
