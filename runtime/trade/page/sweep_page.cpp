#include "runtime/trade/page/sweep_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/report/page/page_files.h"
#include "runtime/report/page/page_parts.h"
#include "runtime/trade/equal_quality.h"
#include "runtime/trade/page/sweep_files.h"
#include "runtime/trade/page/sweep_tables.h"
#include "runtime/trade/published_grid.h"

namespace gazeloop::trade {
namespace {

using nlohmann::ordered_json;
using report::page::data;
using report::page::list;
using report::page::table_data;
using report::page::texts;

/// All cases, and their means before them.
std::vector<const SweepSheet*> sheets_shown(const SweepReport& report) {
    std::vector<const SweepSheet*> shown;
    if (!report.mean.rows.empty()) {
        shown.push_back(&report.mean);
    }
    for (const SweepSheet& sheet : report.sheets) {
        shown.push_back(&sheet);
    }
    return shown;
}

std::string title_of(const SweepSheet& sheet, const SweepReport& report) {
    return &sheet == &report.mean ? fmt::format("Mean of {} cases", report.sheets.size())
                                  : fmt::format("{}, gaze {}", sheet.of.scene, sheet.of.gaze);
}

data facts(const SweepReport& report) {
    const SweepSubject& subject = report.subject;
    data all = list();
    const auto add = [&all](const char* label, const std::string& value) {
        data item("label", label);
        item.set("value", value);
        all << item;
    };
    add("display", subject.display);
    add("pictures", fmt::format("{}x{} px per eye", subject.width_px, subject.height_px));
    add("frames", fmt::format("{}", subject.frames));
    add("samples", fmt::format("{} per texel or pixel", subject.samples));
    add("quality", fmt::format("{} eye, against full resolution with {} samples", subject.eye,
                               subject.reference_samples));
    add("times",
        fmt::format("median of {} round{}", subject.rounds, subject.rounds == 1 ? "" : "s"));
    add("device", subject.device);
    return all;
}

/// What the plots are drawn of.
ordered_json plot_json(const SweepReport& report) {
    const std::vector<const SweepSheet*> shown = sheets_shown(report);
    const auto finite = [](double value) {
        return std::isfinite(value) ? ordered_json(value) : ordered_json();
    };
    auto figures = ordered_json::array();
    if (const SweepRow* const some = row_with_figures(shown.front()->rows)) {
        for (const quality::QualityFigure& figure : some->figures) {
            figures.push_back({{"key", figure.key},
                               {"meaning", figure.meaning},
                               {"lower_is_better", figure.lower_is_better}});
        }
    }
    auto sheets = ordered_json::array();
    for (const SweepSheet* const sheet : shown) {
        auto points = ordered_json::array();
        for (std::size_t row = 0; row < sheet->rows.size(); ++row) {
            const SweepRow& one = sheet->rows[row];
            if (!one.error.empty()) {
                continue;
            }
            auto values = ordered_json::object();
            for (const quality::QualityFigure& figure : one.figures) {
                values[figure.key] = finite(figure.mean);
            }
            points.push_back(
                {{"index", row},
                 {"method", one.point.method},
                 {"name", point_text(one.point)},
                 {"fewer", finite(one.fewer_cells)},
                 {"faster", finite(one.speedup)},
                 {"ms", one.time.median_ms},
                 {"figures", std::move(values)},
                 {"on_front", {{"cells", one.on_cells_front}, {"time", one.on_time_front}}}});
        }
        sheets.push_back({{"points", std::move(points)}});
    }
    return {{"figures", std::move(figures)}, {"sheets", std::move(sheets)}};
}

data front_data(const SweepSheet& sheet, std::size_t index, bool cells) {
    data item("id", fmt::format("{}-{}", cells ? "cells" : "time", index));
    item.set("sheet", fmt::format("{}", index));
    item.set("cost", cells ? "cells" : "time");
    item.set("title", cells ? "Samples against quality" : "Time against quality");
    item.set("caption",
             cells ? "Up and to the right is better. Each texel or pixel that is shaded takes as "
                     "many rays. Filled: no other point is cheaper and better by the first figure. "
                     "Lines: each method's own front."
                   : "The same points by the time of all passes, as ratios to full resolution "
                     "measured in the same turns.");
    item.set("table", table_data(cells ? cells_table(sheet.rows) : time_table(sheet.rows)));
    return item;
}

/// Pictures of the points on a front while `room` lasts.
data pictures_data(const SweepSheet& sheet, std::size_t index, std::size_t& room,
                   std::size_t& left_out) {
    data all = list();
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
        const SweepRow& one = sheet.rows[row];
        if (one.picture.empty() || !(one.on_cells_front || one.on_time_front)) {
            continue;
        }
        const std::size_t bytes = one.picture.size() + one.heat_map.size();
        if (bytes > room) {
            ++left_out;
            continue;
        }
        room -= bytes;
        data item("id", fmt::format("picture-{}-{}", index, row));
        item.set("point", fmt::format("{}", row));
        item.set("name", point_text(one.point));
        item.set("picture", one.picture);
        item.set("width", "240");
        if (!one.heat_map.empty()) {
            item.set("heat_map", one.heat_map);
        }
        item.set("numbers",
                 fmt::format("{:.2f}x fewer, {:.2f}x faster, {} {:.4g}", one.fewer_cells,
                             one.speedup, one.figures.front().key, one.figures.front().mean));
        all << item;
    }
    return all;
}

data sheet_data(const SweepReport& report, const SweepSheet& sheet, std::size_t index,
                std::size_t& room) {
    data item("id", fmt::format("case-{}", index));
    item.set("title", title_of(sheet, report));
    if (&sheet == &report.mean) {
        item.set("note",
                 "Geometric means of ratios, times and cells over the cases, plain means of the "
                 "figures.");
    }
    if (const std::string shares = shares_text(sheet); !shares.empty()) {
        item.set("note", shares);
    }
    std::vector<std::string> warnings;
    for (const SweepRow& row : sheet.rows) {
        if (!row.error.empty()) {
            warnings.push_back(fmt::format("{}: {}", point_text(row.point), row.error));
        }
    }
    if (std::string waits = waits_text(sheet); !waits.empty()) {
        warnings.push_back(std::move(waits));
    }
    item.set("warnings", texts(warnings));
    data fronts = list();
    fronts << front_data(sheet, index, true) << front_data(sheet, index, false);
    item.set("fronts", fronts);
    std::size_t left_out = 0;
    data pictures = pictures_data(sheet, index, room, left_out);
    item.set("pictured", !pictures.list_value().empty());
    item.set("pictures_note",
             "The last frame, at most 480 px wide, and where it differs from the reference (black: "
             "not at all). They are shown beside the pointer, too." +
                 (left_out > 0 ? fmt::format(" {} more are left out: the file has room for {} MiB "
                                             "of pictures.",
                                             left_out, kMostPictureBytes >> 20U)
                               : std::string()));
    item.set("pictures", pictures);
    return item;
}

/// None: nothing was asked for.
std::optional<data> recommended(const SweepReport& report) {
    if (!report.question.asked()) {
        return std::nullopt;
    }
    const std::vector<SweepRow>& rows = report.summed_rows();
    const std::optional<std::size_t> chosen = value_or_throw(choose(rows, report.question));
    std::vector<std::string> lines;
    if (chosen) {
        const SweepRow& row = rows[*chosen];
        lines.push_back(point_text(row.point));
        lines.push_back(fmt::format("{:.2f} ms, {:.2f}x faster, {:.2f}x fewer cells, {} {:.4g}",
                                    row.time.median_ms, row.speedup, row.fewer_cells,
                                    row.figures.front().key, row.figures.front().mean));
    } else {
        lines.emplace_back("Nothing: no point that was measured keeps it.");
    }
    lines.push_back("For " + report.question.text(rows));
    data item("verdict", chosen ? "real-time" : "not-real-time");
    item.set("lines", texts(lines));
    return item;
}

data links(const SweepReport& report, bool is_recommended) {
    data all = list();
    const auto add = [&all](const std::string& id, const std::string& title) {
        data item("id", id);
        item.set("title", title);
        all << item;
    };
    if (is_recommended) {
        add("recommended", "Recommended");
    }
    const std::vector<const SweepSheet*> shown = sheets_shown(report);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        add(fmt::format("case-{}", i), title_of(*shown[i], report));
    }
    if (method_worth(report.subject, report.summed_rows())) {
        add("worth", "What each part is worth");
    }
    add("equal", "At equal quality");
    add("passes", "Where the time goes");
    if (report.with_fits) {
        add("fits", "Fits");
    }
    add("figures", "What the figures say");
    return all;
}

}  // namespace

std::string sweep_page(const SweepReport& report) {
    using report::page::page_file;
    const std::vector<const SweepSheet*> shown = sheets_shown(report);
    const std::vector<SweepRow>& rows = report.summed_rows();
    data page;
    page.set("css", std::string(page_file("page.css")) + std::string(sweep_file("sweep.css")));
    page.set("chart_js", std::string(page_file("chart.min.js")));
    page.set("chart_licence", std::string(page_file("chart_licence.txt")));
    page.set("script", std::string(page_file("charts.js")) + std::string(sweep_file("fronts.js")));
    page.set("plot_data", report::page::script_json(plot_json(report)));
    page.set("version", report.subject.program);
    page.set("facts", facts(report));
    const std::optional<data> choice = recommended(report);
    if (choice) {
        page.set("recommended", *choice);
    }
    page.set("links", links(report, choice.has_value()));
    data figures = list();
    if (const SweepRow* const some = row_with_figures(shown.front()->rows)) {
        for (const quality::QualityFigure& figure : some->figures) {
            figures << data("key", figure.key);
        }
    }
    page.set("figures", figures);
    data sheets = list();
    data pass_tables = list();
    std::size_t room = kMostPictureBytes;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        sheets << sheet_data(report, *shown[i], i, room);
        if (shown[i] != &report.mean) {
            data item("title", title_of(*shown[i], report));
            item.set("table", table_data(pass_table(shown[i]->rows)));
            pass_tables << item;
        }
    }
    page.set("sheets", sheets);
    page.set("pass_tables", pass_tables);
    if (const auto worth = method_worth(report.subject, rows)) {
        data item("note",
                  fmt::format("Each setting of {} changed alone: time and cells over those "
                              "without the change. Same: no figure changes in its last bit. {}",
                              worth->method, worth_note(*worth)));
        item.set("table", table_data(worth_table(*worth)));
        page.set("worth", item);
    }
    const EqualQuality equal = equal_quality(rows);
    page.set(
        "equal_note",
        fmt::format("What each method saves where its pictures are as good, by {}: times fewer "
                    "cells, and times faster, than full resolution. Between two points of a "
                    "method both are taken as straight in their logarithms; -: none of its "
                    "points is as good.",
                    equal.figure));
    page.set("equal_table", table_data(equal_table(equal)));
    page.set("published", texts(against_published(rows)));
    if (report.with_fits) {
        data fitted;
        fitted.set("fits_table", table_data(fits_table(setting_fits(rows))));
        page.set("fitted", fitted);
    }
    page.set("figure_table", table_data(figure_table(rows)));
    page.set("settings_table", table_data(settings_table(report.subject)));
    page.set("command_line", report.command_line);
    page.set(
        "table_part",
        data(kainjow::mustache::partial([] { return std::string(page_file("table.mustache")); })));
    kainjow::mustache::mustache rendered(std::string(sweep_file("sweep.mustache")));
    std::string html = rendered.render(page);
    if (!rendered.is_valid()) {
        throw std::logic_error("sweep.mustache: " + rendered.error_message());
    }
    return html;
}

}  // namespace gazeloop::trade
