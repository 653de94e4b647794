#include "runtime/trade/page/sweep_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {
namespace {

using report::page::Table;
using report::page::TableRow;

std::vector<const SweepRow*> sorted(const std::vector<SweepRow>& rows, const auto& cost) {
    std::vector<const SweepRow*> points;
    for (const SweepRow& row : rows) {
        if (row.error.empty()) {
            points.push_back(&row);
        }
    }
    std::ranges::stable_sort(points, std::ranges::greater{},
                             [&](const SweepRow* row) { return cost(*row); });
    return points;
}

TableRow row_of(const SweepRow& row) {
    return {.label = point_text(row.point), .cells = {}, .show_s = {}};
}

std::string yes(bool on_front) { return on_front ? "yes" : ""; }

}  // namespace

Table cells_table(const std::vector<SweepRow>& rows) {
    Table table{.heads = {{"point"},
                          {"cells per frame"},
                          {"times fewer"},
                          {"over the fewest by Guenter's line"}},
                .rows = {},
                .tight = true};
    if (const SweepRow* const some = row_with_figures(rows)) {
        for (const quality::QualityFigure& figure : some->figures) {
            table.heads.push_back({figure.key});
        }
    }
    table.heads.push_back({"on the front"});
    for (const SweepRow* const row : sorted(rows, [](const auto& one) { return one.cells; })) {
        TableRow line = row_of(*row);
        line.cells = {fmt::format("{:.0f}", row->cells), fmt::format("{:.2f}", row->fewer_cells),
                      fmt::format("{:.2f}", row->cells_over_fewest)};
        for (const quality::QualityFigure& figure : row->figures) {
            line.cells.push_back(fmt::format("{:.4f}", figure.mean));
        }
        line.cells.push_back(yes(row->on_cells_front));
        table.rows.push_back(std::move(line));
    }
    return table;
}

Table time_table(const std::vector<SweepRow>& rows) {
    Table table{.heads = {{"point"}, {"ms"}, {"least, ms"}, {"most, ms"}, {"times faster"}},
                .rows = {}};
    if (const SweepRow* const some = row_with_figures(rows)) {
        table.heads.push_back({some->figures.front().key});
    }
    table.heads.push_back({"on the front"});
    const bool with_energy = any_energy(rows);
    if (with_energy) {
        table.heads.push_back({"mJ of the processor"});
        table.heads.push_back({"times less"});
    }
    for (const SweepRow* const row :
         sorted(rows, [](const auto& one) { return one.time.median_ms; })) {
        TableRow line = row_of(*row);
        line.cells = {fmt::format("{:.3f}", row->time.median_ms),
                      fmt::format("{:.3f}", row->time.least_ms),
                      fmt::format("{:.3f}", row->time.greatest_ms),
                      fmt::format("{:.2f}", row->speedup),
                      fmt::format("{:.4f}", row->figures.front().mean),
                      yes(row->on_time_front)};
        if (with_energy) {
            line.cells.push_back(row->energy_mj ? fmt::format("{:.3g}", *row->energy_mj) : "-");
            line.cells.push_back(row->less_energy ? fmt::format("{:.2f}", *row->less_energy) : "-");
        }
        table.rows.push_back(std::move(line));
    }
    return table;
}

Table pass_table(const std::vector<SweepRow>& rows) {
    std::vector<std::string> passes;
    const auto points = sorted(rows, [](const auto& one) { return one.time.median_ms; });
    for (const SweepRow* const row : points) {
        for (const auto& [pass, ms] : row->pass_ms) {
            if (std::ranges::find(passes, pass) == passes.end()) {
                passes.push_back(pass);
            }
        }
    }
    Table table{.heads = {{"point"}}, .rows = {}};
    for (const std::string& pass : passes) {
        table.heads.push_back({pass});
    }
    table.heads.push_back({"all"});
    for (const SweepRow* const row : points) {
        if (!row->on_cells_front && !row->on_time_front) {
            continue;
        }
        TableRow line = row_of(*row);
        for (const std::string& pass : passes) {
            const auto found =
                std::ranges::find(row->pass_ms, pass, &std::pair<std::string, double>::first);
            line.cells.push_back(
                found == row->pass_ms.end() ? "-" : fmt::format("{:.3f}", found->second));
        }
        line.cells.push_back(fmt::format("{:.3f}", row->time.median_ms));
        table.rows.push_back(std::move(line));
    }
    return table;
}

Table equal_table(const EqualQuality& equal) {
    Table table{.heads = {{equal.figure}}, .rows = {}};
    for (const EqualQuality::OfMethod& method : equal.methods) {
        table.heads.push_back({method.method + ", fewer"});
        table.heads.push_back({method.method + ", faster"});
    }
    for (std::size_t level = 0; equal.levels.size() > 1 && level < equal.levels.size(); ++level) {
        TableRow line{
            .label = fmt::format("{:.4f}", equal.levels[level]), .cells = {}, .show_s = {}};
        for (const EqualQuality::OfMethod& method : equal.methods) {
            const std::optional<Saving>& saving = method.at[level];
            line.cells.push_back(saving ? fmt::format("{:.2f}", saving->fewer_cells) : "-");
            line.cells.push_back(saving ? fmt::format("{:.2f}", saving->speedup) : "-");
        }
        table.rows.push_back(std::move(line));
    }
    return table;
}

Table worth_table(const MethodWorth& worth) {
    Table table{.heads = {{"change"}, {"time"}, {"cells"}, {worth.figure + ", worse by"}, {"so"}},
                .rows = {},
                .text = true};
    for (const PartWorth& part : worth.parts) {
        TableRow line{.label = part.change, .cells = {}, .show_s = {}};
        if (part.error.empty()) {
            line.cells = {fmt::format("{:.2f}x", part.time), fmt::format("{:.2f}x", part.cells),
                          part.same ? "same" : fmt::format("{:+.4f}", part.loss), part.verdict()};
        } else {
            line.cells = {"-", "-", "-", part.verdict()};
        }
        table.rows.push_back(std::move(line));
    }
    return table;
}

Table fits_table(const std::vector<MethodFit>& fits) {
    Table table{.heads = {{"method"}, {"points"}, {"what"}}, .rows = {}, .text = true};
    for (const MethodFit& fit : fits) {
        for (const std::string& line : fit_lines(fit)) {
            table.rows.push_back({.label = fit.method,
                                  .cells = {fmt::format("{}", fit.points), line},
                                  .show_s = {}});
        }
    }
    return table;
}

Table figure_table(const std::vector<SweepRow>& rows) {
    Table table{.heads = {{"figure"}, {"better"}, {"meaning"}}, .rows = {}, .text = true};
    if (const SweepRow* const some = row_with_figures(rows)) {
        for (const quality::QualityFigure& figure : some->figures) {
            table.rows.push_back(
                {.label = figure.key,
                 .cells = {figure.lower_is_better ? "lower" : "higher", figure.meaning},
                 .show_s = {}});
        }
    }
    return table;
}

Table settings_table(const SweepSubject& subject) {
    Table table{.heads = {{"setting"}, {"value"}}, .rows = {}, .text = true};
    for (const auto& [key, text] : subject.settings) {
        table.rows.push_back({.label = key, .cells = {text}, .show_s = {}});
    }
    return table;
}

}  // namespace gazeloop::trade
