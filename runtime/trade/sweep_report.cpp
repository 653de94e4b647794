#include "runtime/trade/sweep_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "runtime/trade/equal_quality.h"
#include "runtime/trade/part_worth.h"
#include "runtime/trade/published_grid.h"

namespace gazeloop::trade {
namespace {

/// The figures of the table. Not the parts of contrast; and where it has no room for all others,
/// not what knows no gaze beside what is weighed by it. The first figure, which decides the front,
/// is always there. The rows have the same figures, or none.
std::vector<quality::QualityFigure> shown_figures(const std::vector<SweepRow>& rows) {
    constexpr std::size_t kRoom = 5;
    const SweepRow* const some = row_with_figures(rows);
    if (some == nullptr) {
        return {};
    }
    std::vector<quality::QualityFigure> figures = some->figures;
    const std::string first = figures.front().key;
    const auto leave_out = [&](std::initializer_list<std::string_view> keys) {
        std::erase_if(figures, [&](const quality::QualityFigure& figure) {
            return figure.key != first && std::ranges::find(keys, figure.key) != keys.end();
        });
    };
    leave_out({"contrast_achromatic", "contrast_red_green", "contrast_yellow_violet"});
    if (figures.size() > kRoom) {
        leave_out({"ssim", "psnr_db"});
    }
    return figures;
}

std::string table_text(const SweepSheet& sheet) {
    std::vector<SweepRow> rows = sheet.rows;
    std::ranges::stable_sort(rows, std::ranges::greater{}, &SweepRow::cells);
    const std::vector<quality::QualityFigure> shown = shown_figures(rows);
    std::string text = fmt::format("{:40} {:>7} {:>7} {:>9} {:>19} {:>7}", "point", "fewer",
                                   "bound", "ms", "(least-most)", "faster");
    const bool with_energy = any_energy(rows);
    if (with_energy) {
        text += fmt::format(" {:>9} {:>7}", "mJ", "less");
    }
    for (const quality::QualityFigure& figure : shown) {
        text += fmt::format(" {:>16}", figure.key);
    }
    text += "  front\n";
    for (const SweepRow& row : rows) {
        const std::string name = point_text(row.point);
        if (!row.error.empty()) {
            text += fmt::format("{:40} failed: {}\n", name, row.error);
            continue;
        }
        text += fmt::format("{:40} {:>6.2f}x {:>7.2f} {:>9.2f} {:>19} {:>6.2f}x", name,
                            row.fewer_cells, row.cells_over_fewest, row.time.median_ms,
                            fmt::format("({:.2f}-{:.2f})", row.time.least_ms, row.time.greatest_ms),
                            row.speedup);
        if (with_energy) {
            text += fmt::format(" {:>9} {:>7}",
                                row.energy_mj ? fmt::format("{:.3g}", *row.energy_mj) : "-",
                                row.less_energy ? fmt::format("{:.2f}x", *row.less_energy) : "-");
        }
        for (const quality::QualityFigure& each : shown) {
            if (const quality::QualityFigure* const figure = find_figure(row, each.key)) {
                text += fmt::format(" {:>16.4f}", figure->mean);
            }
        }
        text += fmt::format("  {}{}\n", row.on_cells_front ? "cells " : "",
                            row.on_time_front ? "time" : "");
    }
    return text;
}

/// What each method saves at equal quality.
std::string levels_text(const std::vector<SweepRow>& rows) {
    const EqualQuality equal = equal_quality(rows);
    if (equal.levels.size() < 2) {
        return {};
    }
    std::string text = fmt::format(
        "\nAt equal quality: fewer cells / faster, between a method's points as "
        "straight in their logarithms\n{:>16}",
        equal.figure);
    for (const EqualQuality::OfMethod& method : equal.methods) {
        text += fmt::format(" {:>17}", method.method);
    }
    text += '\n';
    for (std::size_t level = 0; level < equal.levels.size(); ++level) {
        text += fmt::format("{:>16.4f}", equal.levels[level]);
        for (const EqualQuality::OfMethod& method : equal.methods) {
            const std::optional<Saving>& saving = method.at[level];
            text += fmt::format(
                " {:>17}",
                saving ? fmt::format("{:.2f}x / {:.2f}x", saving->fewer_cells, saving->speedup)
                       : "-");
        }
        text += '\n';
    }
    return text;
}

std::string meanings_text(const std::vector<SweepRow>& rows) {
    const std::vector<quality::QualityFigure> shown = shown_figures(rows);
    std::string text = fmt::format(
        "\nfewer: cells shaded, against full resolution. bound: over the fewest that Guenter's "
        "line asks for. ms: all passes of a frame, both eyes. front: no other point is cheaper and "
        "better by the first figure{}.\n",
        shown.empty() ? "" : ", " + shown.front().key);
    text += any_energy(rows)
                ? "mJ: what the processor's packages took for a frame, whatever else ran on them; "
                  "less: than full resolution.\n"
                : "energy: unavailable.\n";
    for (const quality::QualityFigure& figure : shown) {
        text += fmt::format("{}: {} is better; {}\n", figure.key,
                            figure.lower_is_better ? "lower" : "higher", figure.meaning);
    }
    return text;
}

}  // namespace

SweepReport report_of(const SweepRecord& record) {
    SweepReport report{.subject = record.subject, .sheets = sheets_of(record), .mean = {}};
    report.mean = mean_sheet(report.sheets);
    return report;
}

std::vector<std::string> failures(const SweepReport& report) {
    std::vector<std::string> found;
    for (const SweepSheet& sheet : report.sheets) {
        for (const SweepRow& row : sheet.rows) {
            if (!row.error.empty()) {
                found.push_back(report.sheets.size() == 1
                                    ? fmt::format("{}: {}", point_text(row.point), row.error)
                                    : fmt::format("{}, {}: {}", case_text(sheet.of),
                                                  point_text(row.point), row.error));
            }
        }
    }
    const std::vector<SweepRow>& rows = report.summed_rows();
    if (report.question.asked() && !value_or_throw(choose(rows, report.question))) {
        found.push_back("no point that was measured keeps " + report.question.text(rows));
    }
    return found;
}

std::string waits_text(const SweepSheet& sheet) {
    std::uint64_t timed = 0;
    std::uint64_t frames = 0;
    std::uint64_t views = 0;
    for (const SweepRow& row : sheet.rows) {
        timed += row.timed_frames;
        frames += row.waited_frames;
        views += row.waited_views;
    }
    if (frames == 0) {
        return {};
    }
    return fmt::format(
        "{} of {} timed frames waited for {} views of the light field, which does not fit into "
        "lightfield.memory_mib: their times tell the passes, and not the waits. Points take turns, "
        "so that one waits for what the others then find.",
        frames, timed, views);
}

std::vector<std::string> warnings(const SweepReport& report) {
    std::vector<std::string> found;
    for (const SweepSheet& sheet : report.sheets) {
        if (std::string waits = waits_text(sheet); !waits.empty()) {
            found.push_back(report.sheets.size() == 1
                                ? std::move(waits)
                                : fmt::format("{}: {}", case_text(sheet.of), waits));
        }
    }
    return found;
}

std::string case_text(const SweepCase& of_case) {
    return fmt::format("scene {}, gaze {}", of_case.scene, of_case.gaze);
}

std::string shares_text(const SweepSheet& sheet) {
    if (!sheet.shares) {
        return {};
    }
    if (sheet.shares->contrast <= 0.0) {
        return "The scene has no contrast there.";
    }
    return fmt::format(
        "Of its contrast there (mean square of luminance), {:.1f} % is coarser than Guenter's "
        "line, "
        "{:.1f} % lies between that and the limit of resolution of 2025: seen, though not "
        "resolved, "
        "where it is left out; {:.1f} % is finer than both.",
        100.0 * sheet.shares->kept, 100.0 * sheet.shares->between, 100.0 * sheet.shares->beyond);
}

std::string point_text(const SweepPoint& point) {
    return point.settings.empty() ? point.method
                                  : fmt::format("{} {}", point.method, point.settings_text());
}

std::vector<std::string> fit_lines(const MethodFit& fit) {
    std::vector<std::string> lines;
    const auto within = [](double standard_error, double worst, const std::string& at) {
        return fmt::format("; standard error {:.2g} %, worst point {:.2g} % at {}", standard_error,
                           worst, at);
    };
    for (const PowerLaw& law : fit.laws) {
        std::string line = fmt::format("{} = {:.4g}", law.quantity, law.factor);
        for (const auto& [key, exponent] : law.exponents) {
            line += fmt::format(" {}^{:.3f}", key, exponent);
        }
        lines.push_back(line + within(law.standard_error_percent, law.worst_percent, law.worst_at));
    }
    if (fit.time) {
        lines.push_back(
            fmt::format("time_ms = {:.3f} + {:.2f} ns per cell", fit.time->fixed_ms,
                        fit.time->ns_per_cell) +
            within(fit.time->standard_error_percent, fit.time->worst_percent, fit.time->worst_at));
    }
    lines.insert(lines.end(), fit.notes.begin(), fit.notes.end());
    return lines;
}

std::string sweep_text(const SweepReport& report) {
    const SweepSubject& subject = report.subject;
    std::string text = fmt::format(
        "{}, {}x{} px per eye, {} frame{}, {} sample{}, {} round{}; quality of the {} eye against "
        "full resolution with {} samples\n{}\n",
        subject.display, subject.width_px, subject.height_px, subject.frames,
        subject.frames == 1 ? "" : "s", subject.samples, subject.samples == 1 ? "" : "s",
        subject.rounds, subject.rounds == 1 ? "" : "s", subject.eye, subject.reference_samples,
        subject.device);
    for (const SweepSheet& sheet : report.sheets) {
        text += fmt::format("\n{}\n{}", case_text(sheet.of), table_text(sheet));
        if (const std::string shares = shares_text(sheet); !shares.empty()) {
            text += shares + '\n';
        }
        if (const std::string waits = waits_text(sheet); !waits.empty()) {
            text += waits + '\n';
        }
    }
    if (!report.mean.rows.empty()) {
        text += fmt::format(
            "\nmean of {} cases: geometric of ratios, times and cells, plain of the "
            "figures\n{}",
            report.sheets.size(), table_text(report.mean));
    }
    const std::vector<SweepRow>& rows = report.summed_rows();
    text += levels_text(rows);
    if (const auto worth = method_worth(subject, rows)) {
        text += worth_text(*worth);
    }
    if (report.with_fits) {
        text += "\nFits\n";
        for (const MethodFit& fit : setting_fits(rows)) {
            for (const std::string& line : fit_lines(fit)) {
                text += fmt::format("{} ({} points): {}\n", fit.method, fit.points, line);
            }
        }
    }
    for (const std::string& line : against_published(rows)) {
        text += '\n' + line;
    }
    text += '\n';
    if (report.question.asked()) {
        const auto chosen = value_or_throw(choose(rows, report.question));
        text += fmt::format("\nRecommended for {}: {}\n", report.question.text(rows),
                            chosen ? point_text(rows[*chosen].point)
                                   : std::string("nothing; no point that was measured keeps it"));
    }
    return text + meanings_text(rows);
}

}  // namespace gazeloop::trade
