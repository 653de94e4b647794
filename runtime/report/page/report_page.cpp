#include "runtime/report/page/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "runtime/report/figures.h"
#include "runtime/report/page/distribution.h"
#include "runtime/report/page/eye_event_table.h"
#include "runtime/report/page/frame_plots.h"
#include "runtime/report/page/page_parts.h"
#include "runtime/report/page/page_tables.h"
#include "runtime/report/page/plot_data.h"
#include "runtime/report/page/violations.h"
#include "runtime/report/recording_text.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "runtime/report/summary_text.h"

namespace gazeloop::report::page {
namespace {

constexpr std::size_t kMostRuns = 50;  ///< of each limit, around which single frames are kept

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (end > 0) {
            lines.emplace_back(text.substr(0, end));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

data share_data(const latency::SummaryReport& report) {
    data shares = list();
    if (!report.share_by_kind_percent) {
        return shares;
    }
    for (const time::StampKind kind :
         {time::StampKind::Measured, time::StampKind::Profile, time::StampKind::Modelled,
          time::StampKind::Predicted, time::StampKind::Unknown}) {
        const double percent = (*report.share_by_kind_percent)[static_cast<std::size_t>(kind)];
        constexpr double kWhole = 100.0;
        data item("name", std::string(time::name(kind)));
        item.set("percent", fmt::format("{:.1f}", percent));
        item.set("width", fmt::format("{:.2f}", std::clamp(percent, 0.0, kWhole)));
        shares << item;
    }
    return shares;
}

data facts(const PageContents& contents) {
    const session::SessionMeta& meta = contents.info.header.meta;
    const FrameLog& frames = *contents.session.frames;
    data all = list();
    const auto add = [&all](const char* label, const std::string& value) {
        if (!value.empty()) {
            data item("label", label);
            item.set("value", value);
            all << item;
        }
    };
    add("started", meta.started_utc);
    std::optional<double> length;
    for (std::size_t row = frames.rows(); row > 0 && !length; --row) {
        length = axis_s(frames, row - 1);
    }
    add("length", frames.rows() > 0 ? time_text(length) : "no frames");
    add("frames", fmt::format("{}", frames.rows()));
    add("display", meta.display.name);
    add("target", meta.target);
    add("clock", meta.clock == latency::LoopClock::Virtual ? "virtual time" : "wall clock");
    add("recorded by", meta.program);
    return all;
}

/// The figures that a reader looks for first.
data key_figures(const FrameLog& frames) {
    constexpr std::array kPercents{50.0, 95.0};
    data all = list();
    const auto add = [&](const RowName& name, const std::string& label, const std::string& unit) {
        const DurationColumn& column = frames.at(name.key);
        const auto percentiles = column.percentiles(kPercents);
        const auto text = [&](const std::optional<std::int64_t>& number) {
            return number ? figure(shown(static_cast<double>(*number), column.unit()))
                          : std::string(column.known() > 0 ? "withheld" : "unknown");
        };
        data item("label", label);
        item.set("value", text(percentiles[0]));
        item.set("unit", percentiles[0] ? unit : "");
        item.set("more", percentiles[1]
                             ? fmt::format("95 % below {} {}", text(percentiles[1]), unit)
                             : "95th percentile " + text(percentiles[1]));
        all << item;
    };
    add(kGazeAgeAtDisplay, "Gaze age when shown, median", "ms");
    add(kGazeAgeAtLatch, "Gaze age when used, median", "ms");
    add(kGazeError, "Gaze error when shown, median", "deg");
    add(kFrameInterval, "Frame interval, median", "ms");
    return all;
}

std::vector<std::string> stage_keys(const FrameLog& frames) {
    std::vector<std::string> keys;
    const auto add = [&](const std::string& key) {
        if (frames.at(key).known() > 0) {
            keys.push_back(key);
        }
    };
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        add(stage_name(stage).key);
    }
    add(kUnaccounted.key);
    return keys;
}

std::vector<Figure> time_figures(const PageContents& contents, std::span<const Violations> limits) {
    const FrameLog& frames = *contents.session.frames;
    const auto ranges = [&](std::initializer_list<RowName> names) {
        std::vector<std::string> keys;
        for (const RowName& name : names) {
            keys.push_back(name.key);
        }
        return range_table(frames, keys);
    };
    return {
        {.id = "age",
         .title = "Age of the gaze",
         .note = "How old the gaze was when its frame was shown, and when it was used: least and "
                 "greatest of each point.",
         .table = ranges({kGazeAgeAtDisplay, kGazeAgeAtLatch, kHeldGazeAge})},
        {.id = "stages",
         .title = "Where the time went",
         .note = "Means of each point's frames with fresh gaze; they add up to the mean age when "
                 "shown. A stage below 0 takes its height off.",
         .table = mean_table(frames, stage_keys(frames))},
        {.id = "above",
         .title = "Budget violations",
         .note = contents.budget != nullptr
                     ? fmt::format("Share of frames above each limit of the budget {}, and of "
                                   "frames shown later than announced.",
                                   contents.budget->name)
                     : std::string("No budget is in force. Share of frames shown later than "
                                   "announced."),
         .table = above_table(frames, limits)},
        {.id = "error",
         .title = "Gaze error when shown",
         .note =
             "Between the fovea and where the eye looked when the frame was shown, of the worse "
             "eye; with the gaze held in the world, and had it been held in the head.",
         .table = ranges({kGazeError, kGazeErrorWithoutPoses})},
        {.id = "states",
         .title = "What the fovea rested on",
         .note = "Share of frames by the state of the worse eye.",
         .table = state_table(frames)},
        {.id = "pace",
         .title = "Pace of the loop",
         .note = "From one wake-up to the next, and the loop's own time in it.",
         .table = ranges({kFrameInterval, kLoopTime})},
        {.id = "clock",
         .title = "How well the tracker's clock is known",
         .note = "Uncertainty of both ages, either way: of the fit of the tracker's clock, and of "
                 "the delay that its profile states.",
         .table = ranges({kGazeAgeUncertainty})},
        {.id = "events",
         .title = "Events",
         .note = "What the run and its devices said, by kind.",
         .table = event_table(contents.events, frames)}};
}

std::string distribution_note(std::span<const Distribution> both) {
    const std::uint64_t above = both[0].above + both[1].above;
    std::string note = "Share of frames in each bin (filled), and of frames up to there (dashed).";
    if (above > 0) {
        note += fmt::format(" {} are beyond the right edge; the table counts them.", above);
    }
    return note;
}

data section_data(const PageSection& section) {
    data item("id", section.id);
    item.set("title", section.title);
    item.set("paragraphs", texts(section.paragraphs));
    Table table{.heads = {{""}}, .rows = {}};
    for (std::size_t i = 0; i < section.heads.size(); ++i) {
        if (i == 0) {
            table.heads.front().text = section.heads[i];
        } else {
            table.heads.push_back({section.heads[i]});
        }
    }
    for (const std::vector<std::string>& row : section.rows) {
        if (!row.empty()) {
            table.rows.push_back(
                {.label = row.front(), .cells = {row.begin() + 1, row.end()}, .show_s = {}});
        }
    }
    item.set("table", table_data(table));
    if (!section.lines.empty()) {
        item.set("lines", section.lines);
    }
    return item;
}

/// Rows that are worth every single frame around them, the most important ones first.
std::vector<std::size_t> of_note(const FrameLog& frames, std::span<const Violations> limits) {
    std::vector<std::size_t> rows = frames.worst(kWorstFrames);
    for (std::size_t run = 0; run < kMostRuns; ++run) {
        for (const Violations& limit : limits) {
            if (run < limit.runs.size()) {
                rows.push_back(limit.runs[run].worst_row);
            }
        }
    }
    return rows;
}

std::string reduced_note(const FramePlots& plots) {
    if (plots.rows == 0) {
        return "The session has no frames.";
    }
    if (plots.all.bins == plots.rows) {
        return "The plots hold every frame.";
    }
    std::size_t single = 0;
    for (const RowSpan& span : plots.spans) {
        single += span.end - span.first;
    }
    return fmt::format(
        "The plots hold {} points of {:.1f} frames each, with the least and greatest "
        "of them, and every single frame around the worst ones and the longest "
        "violations ({} frames). The option --csv writes them all.",
        plots.all.bins, static_cast<double>(plots.rows) / static_cast<double>(plots.all.bins),
        single);
}

}  // namespace

std::string report_page(const PageContents& contents) {
    const FrameLog& frames = *contents.session.frames;
    const latency::SummaryReport& report = contents.session.report;
    const std::vector<Violations> limits = violations(frames, contents.budget, kMostRuns);
    const FramePlots plots = frame_plots(frames, limits, of_note(frames, limits));
    const std::array<const DurationColumn*, 2> ages{&frames.at(kGazeAgeAtLatch.key),
                                                    &frames.at(kGazeAgeAtDisplay.key)};
    const std::vector<Distribution> both = distributions(ages);

    data page;
    add_style_and_scripts(page, {"numbers.js", "levels.js", "view.js", "charts.js", "plots.js",
                                 "shown_time.js", "page.js"});
    page.set("plot_data", plot_data(contents, plots, limits, both));
    page.set("file", contents.file);
    std::vector<std::string> head = lines_of(summary_head(report));
    std::ranges::stable_partition(  // the verdict first
        head, [](const std::string& line) { return !line.starts_with("eye-to-photon"); });
    page.set("head", texts(head));
    page.set("verdict",
             std::string(latency::kVerdictNames[static_cast<std::size_t>(report.verdict)]));
    page.set("facts", facts(contents));
    page.set("key_figures", key_figures(frames));
    page.set("shares", share_data(report));
    page.set("shares_known", report.share_by_kind_percent.has_value());
    page.set("why", texts(contents.why));
    page.set("why_known", !contents.why.empty());
    page.set("stage_table", table_data(stage_table(frames, contents.percentiles)));
    const EyeEventRows by_event = rows_by_eye_event(frames, contents.percentiles.percents());
    page.set("eye_event_table", table_data(eye_event_table(by_event, contents.percentiles)));
    page.set("eye_event_source", source_text(by_event));
    page.set("negative", texts(below_zero(frames)));
    page.set("notes", texts(lines_of(summary_notes(report))));
    data sections = list();
    for (const PageSection& section : contents.sections) {
        sections << section_data(section);
    }
    page.set("sections", sections);
    data ages_figures = list();
    ages_figures << figure_data({.id = "distribution",
                                 .title = "Distribution of the age",
                                 .note = distribution_note(both),
                                 .table = distribution_table(both, {{"when used"}, {"when shown"}}),
                                 .moves = false});
    page.set("distribution", ages_figures);
    data over_time = list();
    for (const Figure& figure : time_figures(contents, limits)) {
        over_time << figure_data(figure);
    }
    page.set("over_time", over_time);
    page.set("reduced", reduced_note(plots));
    page.set("violation_table", table_data(violation_table(frames, limits)));
    page.set("run_table", table_data(run_table(frames, limits)));
    page.set("worst_table", table_data(worst_table(frames)));
    page.set("happening_table", table_data(happening_table(report)));
    page.set("clock_table", table_data(clock_table(contents.events, frames)));
    page.set("repair_table", table_data(repair_table(contents.session.trace)));
    page.set("count_table", table_data(count_table(contents)));
    page.set("losses", texts(recording_lines(contents.info, contents.session.end)));
    page.set("device_table", table_data(named_values(contents.info.header.device)));
    page.set("config_table", table_data(named_values(contents.info.header.config)));
    page.set("command_line", contents.info.header.meta.command_line);
    return rendered("report.mustache", page);
}

}  // namespace gazeloop::report::page
