#include "runtime/study/analysis_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/study/analysis_report.h"
#include "runtime/study/svg_plot.h"

namespace gazeloop::study {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>gazeloop: a study</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1f24; background: #fff; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
p { max-width: 46rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(26rem, 1fr)); gap: 1rem; }
figure { margin: 0; } figcaption { font-weight: 600; }
svg { width: 100%; height: auto; } svg text { font: 11px system-ui, sans-serif; fill: #444c56; }
.grid { stroke: #e3e6ea; } .whisker { stroke: #1b1f24; fill: none; }
.level { stroke: #b3261e; stroke-dasharray: 5 3; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .55rem; text-align: right; border-bottom: 1px solid #e3e6ea; }
th:first-child, td:first-child { text-align: left; }
.wide { grid-column: 1 / -1; }
.key span { margin-right: 1em; white-space: nowrap; }
.key i { display: inline-block; width: .8em; height: .8em; margin-right: .35em; }
.scroll { overflow-x: auto; }
</style></head><body>
)";

std::string text(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

std::string p_text(double p) { return p < 0.001 ? "&lt; 0.001" : fmt::format("{:.3f}", p); }

std::string key_of(const StudyResult& result) {
    if (result.thresholds.size() < 2) {
        return "";
    }
    std::string html = "<p class=\"key\">";
    for (std::size_t condition = 0; condition < result.thresholds.size(); ++condition) {
        html += fmt::format(
            "<span><i style=\"background:{}\"></i>{}</span> ", plot_colour(condition),
            html_text(condition_name(*result.plan, result.thresholds[condition].condition)));
    }
    return html + "</p>\n";
}

/// A mark in the middle of each level's place.
std::vector<SvgPlot::Mark> level_marks(const Factor& factor) {
    std::vector<SvgPlot::Mark> marks;
    marks.reserve(factor.levels.size());
    for (std::size_t level = 0; level < factor.levels.size(); ++level) {
        marks.push_back(
            {static_cast<double>(level) + 0.5, fmt::format("{:g}", factor.levels[level])});
    }
    return marks;
}

/// The papers' bars: a group per level, a bar per condition.
std::string bars(const StudyResult& result) {
    const Plan& plan = *result.plan;
    const Factor& factor = plan.factors.front();
    const auto conditions = static_cast<double>(plan.conditions());
    const std::vector<SvgPlot::Mark> marks = level_marks(factor);
    SvgPlot plot(yes_name(plan) + ", with standard error over subjects", 0.0,
                 static_cast<double>(factor.levels.size()), 1.0, marks, factor.name,
                 yes_name(plan));
    plot.level(plan.criterion);
    for (std::size_t cell = 0; cell < result.cells.size(); ++cell) {
        const CellResult& one = result.cells[cell];
        if (one.yes.trials == 0) {
            continue;
        }
        const std::size_t condition = cell % plan.conditions();
        const std::size_t place = cell / plan.conditions();
        const auto level = static_cast<double>(place);
        const double width = 0.84 / conditions;
        const double from = level + 0.08 + width * static_cast<double>(condition);
        plot.bar(from, from + 0.9 * width, one.subjects_mean, plot_colour(condition),
                 fmt::format("{:g} {}: {:.3f} of {}", one.levels.front(),
                             condition_name(plan, result.thresholds[condition].condition),
                             one.subjects_mean, one.yes.trials));
        if (std::isfinite(one.standard_error)) {
            plot.whisker(from + 0.45 * width, one.subjects_mean - one.standard_error,
                         one.subjects_mean + one.standard_error, 0.9 * width);
        }
    }
    // So many bars need the whole page's width to be told apart.
    constexpr std::size_t kManyBars = 60;
    return result.cells.size() > kManyBars ? "<div class=\"wide\">" + plot.figure() + "</div>\n"
                                           : plot.figure();
}

SvgPlot over_levels(const StudyResult& result, const std::string& title, double greatest,
                    const std::string& y_label) {
    const Plan& plan = *result.plan;
    const std::vector<double>& levels = plan.factors.front().levels;
    const double low = plan.x_of(levels.front());
    const double high = plan.x_of(levels.back());
    const double margin = 0.06 * (high - low);
    // No more labels than can be read side by side.
    std::vector<SvgPlot::Mark> marks;
    double last = low - high;
    for (const double level : levels) {
        if (plan.x_of(level) - last >= 0.045 * (high - low)) {
            last = plan.x_of(level);
            marks.push_back({last, fmt::format("{:g}", level)});
        }
    }
    return {title,  low - margin, high + margin, greatest, marks, plan.factors.front().name,
            y_label};
}

std::string curves(const StudyResult& result) {
    const Plan& plan = *result.plan;
    const std::vector<double>& levels = plan.factors.front().levels;
    SvgPlot plot = over_levels(result, "Fitted functions, and all answers", 1.0, yes_name(plan));
    constexpr int kPoints = 80;
    const double low = plan.x_of(levels.front());
    const double high = plan.x_of(levels.back());
    for (std::size_t condition = 0; condition < result.thresholds.size(); ++condition) {
        const ThresholdResult& threshold = result.thresholds[condition];
        const std::string name = condition_name(plan, threshold.condition);
        if (!threshold.fit) {
            continue;
        }
        // Of people taken together, as the answers are.
        const statistics::PsychometricFunction function = threshold.fit->people.together();
        std::vector<std::pair<double, double>> points;
        for (int i = 0; i <= kPoints; ++i) {
            const double x = low + (high - low) * i / kPoints;
            points.emplace_back(x, function.at(x));
        }
        plot.line(points, plot_colour(condition));
        plot.upright(threshold.fit->x, plot_colour(condition),
                     fmt::format("{}: {:.4g} ({:.4g} to {:.4g})", name, threshold.fitted,
                                 threshold.low, threshold.high));
        for (std::size_t level = 0; level < levels.size(); ++level) {
            const CellResult& cell = result.cells[level * plan.conditions() + condition];
            if (cell.yes.trials > 0) {
                plot.dot(
                    plan.x_of(levels[level]), cell.yes.share,
                    std::clamp(0.6 * std::sqrt(static_cast<double>(cell.yes.trials)), 2.0, 7.0),
                    plot_colour(condition),
                    fmt::format("{} {:g}: {} of {}", name, levels[level], cell.yes.yes,
                                cell.yes.trials));
            }
        }
    }
    return plot.figure();
}

/// How many subjects have their threshold, by the paper's rule, at which level; of all conditions.
std::string histogram(const StudyResult& result) {
    const Factor& factor = result.plan->factors.front();
    std::vector<double> counts(factor.levels.size(), 0.0);
    for (const SubjectResult& subject : result.subjects) {
        if (subject.excluded) {
            continue;
        }
        for (const std::optional<double>& one : subject.thresholds) {
            if (one) {
                counts[factor.index_of(*one)] += 1.0;
            }
        }
    }
    const double most = std::max(std::ceil(std::ranges::max(counts) / 5.0) * 5.0, 5.0);
    const std::vector<SvgPlot::Mark> marks = level_marks(factor);
    SvgPlot plot("Subjects' thresholds: " + rule_name(result.plan->design), 0.0,
                 static_cast<double>(counts.size()), most, marks, factor.name, "thresholds");
    for (std::size_t level = 0; level < counts.size(); ++level) {
        const auto from = static_cast<double>(level) + 0.1;
        plot.bar(from, from + 0.8, counts[level], plot_colour(0),
                 fmt::format("{:g}: {:g}", factor.levels[level], counts[level]));
    }
    return plot.figure();
}

std::string thresholds_table(const StudyResult& result) {
    std::string html = fmt::format(
        "<div class=\"scroll\"><table><thead><tr><th>condition<th>mean<th>sd<th>subjects<th>fitted"
        "<th>95 % from<th>to<th>spread{0}<th>people{0}</tr></thead><tbody>\n",
        result.plan->logarithmic ? ", ln" : "");
    for (const ThresholdResult& one : result.thresholds) {
        const std::string name = condition_name(*result.plan, one.condition);
        html += fmt::format(
            "<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n",
            html_text(name.empty() ? "all" : name), text(one.mean), text(one.deviation),
            one.subjects, text(one.fitted), text(one.low), text(one.high),
            one.fit ? text(one.fit->people.function.spread) : "-",
            one.fit && one.fit->people.people > 0.0 ? text(one.fit->people.people) : "-");
    }
    return html + "</tbody></table></div>\n";
}

std::string tests_table(const StudyResult& result) {
    if (result.tests.empty()) {
        return "";
    }
    std::string html = fmt::format(
        "<h2>Conditions against each other</h2>\n<div class=\"scroll\"><table><thead><tr><th>{}"
        "<th>blocks<th>Cochran's Q<th>df<th>p<th>least p of pairs (Holm)</tr></thead><tbody>\n",
        html_text(result.plan->factors.front().name));
    for (const LevelTest& test : result.tests) {
        double least = 1.0;
        for (const LevelTest::PairTest& pair : test.pairs) {
            least = std::min(least, pair.holm_p);
        }
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n", text(test.level),
                            test.blocks, test.q ? fmt::format("{:.2f}", test.q->q) : "-",
                            test.q ? fmt::format("{}", test.q->degrees_of_freedom) : "-",
                            test.q ? p_text(test.q->p) : "-", p_text(least));
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

std::string analysis_page(const StudyResult& result) {
    const Plan& plan = *result.plan;
    std::size_t answers = 0;
    std::string left_out;
    for (const SubjectResult& subject : result.subjects) {
        answers += subject.answers;
        if (subject.excluded) {
            left_out += fmt::format(
                "{}{} ({})", left_out.empty() ? " Left out: subject " : ", ", subject.subject,
                subject.answers == 0 ? "no answer that counts"
                                     : fmt::format("{} of {} validation trials failed",
                                                   subject.failed, subject.validations));
        }
    }
    return fmt::format(
        "{}<h1>{}</h1>\n<p>Design {}: {} subjects, {} answers that count.{}</p>\n<p>{}</p>\n{}"
        "<div class=\"plots\">\n{}{}{}</div>\n<h2>Thresholds of {}</h2>\n"
        "<p>Mean and sd over subjects, by {}; fitted over all answers, where {:g} % of them are "
        "yes; people: how much their thresholds differ.</p>\n{}{}</body></html>\n",
        kHead, html_text(plan.name), kDesignNames[static_cast<std::size_t>(plan.design)],
        result.subjects.size(), answers, html_text(left_out), html_text(plan.source),
        key_of(result), bars(result), curves(result), histogram(result),
        html_text(plan.factors.front().name), rule_name(plan.design), 100.0 * plan.criterion,
        thresholds_table(result), tests_table(result));
}

}  // namespace gazeloop::study
