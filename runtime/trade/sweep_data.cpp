#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/trade/equal_quality.h"
#include "runtime/trade/part_worth.h"
#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {
namespace {

using nlohmann::ordered_json;

/// As CSV has text: in quotes, which are doubled within.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        result += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
    }
    return result + '"';
}

ordered_json finite(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

ordered_json row_json(const SweepRow& row, std::uint32_t samples) {
    auto settings = ordered_json::object();
    for (const auto& [key, value] : row.point.settings) {
        settings[key] = value;
    }
    ordered_json entry{{"method", row.point.method}, {"settings", std::move(settings)}};
    if (!row.error.empty()) {
        entry["error"] = row.error;
        return entry;
    }
    entry["cells_per_frame"] = row.cells;
    entry["fewer_cells"] = finite(row.fewer_cells);
    entry["cells_over_fewest"] = finite(row.cells_over_fewest);
    entry["rays_per_frame"] = row.cells * samples;
    entry["time_ms"] = {{"median", row.time.median_ms},
                        {"least", row.time.least_ms},
                        {"greatest", row.time.greatest_ms}};
    entry["pass_ms"] = ordered_json::object();
    for (const auto& [pass, ms] : row.pass_ms) {
        entry["pass_ms"][pass] = ms;
    }
    entry["speedup"] = finite(row.speedup);
    entry["energy_mj"] = row.energy_mj ? finite(*row.energy_mj) : ordered_json();
    entry["less_energy"] = row.less_energy ? finite(*row.less_energy) : ordered_json();
    entry["timed_frames"] = row.timed_frames;
    entry["waited_frames"] = row.waited_frames;
    entry["waited_views"] = row.waited_views;
    auto figures = ordered_json::object();
    for (const quality::QualityFigure& figure : row.figures) {
        figures[figure.key] = {{"mean", finite(figure.mean)},
                               {"worst", finite(figure.worst)},
                               {"worst_frame", figure.worst_frame + 1},
                               {"better", figure.lower_is_better ? "lower" : "higher"}};
    }
    entry["figures"] = std::move(figures);
    entry["on_cells_front"] = row.on_cells_front;
    entry["on_time_front"] = row.on_time_front;
    return entry;
}

ordered_json levels_json(const std::vector<SweepRow>& rows) {
    const EqualQuality equal = equal_quality(rows);
    auto levels = ordered_json::array();
    for (std::size_t level = 0; level < equal.levels.size(); ++level) {
        auto methods = ordered_json::object();
        for (const EqualQuality::OfMethod& method : equal.methods) {
            const std::optional<Saving>& saving = method.at[level];
            methods[method.method] =
                saving ? ordered_json{{"fewer_cells", finite(saving->fewer_cells)},
                                      {"speedup", finite(saving->speedup)}}
                       : ordered_json();
        }
        levels.push_back(
            {{equal.figure, finite(equal.levels[level])}, {"methods", std::move(methods)}});
    }
    return levels;
}

ordered_json fit_json(const MethodFit& fit) {
    auto laws = ordered_json::array();
    for (const PowerLaw& law : fit.laws) {
        auto exponents = ordered_json::object();
        for (const auto& [key, exponent] : law.exponents) {
            exponents[key] = exponent;
        }
        laws.push_back({{"quantity", law.quantity},
                        {"factor", law.factor},
                        {"exponents", std::move(exponents)},
                        {"standard_error_percent", law.standard_error_percent},
                        {"worst_percent", law.worst_percent},
                        {"worst_at", law.worst_at}});
    }
    ordered_json entry{{"method", fit.method}, {"points", fit.points}, {"laws", std::move(laws)}};
    entry["time"] = fit.time
                        ? ordered_json{{"fixed_ms", fit.time->fixed_ms},
                                       {"ns_per_cell", fit.time->ns_per_cell},
                                       {"standard_error_percent", fit.time->standard_error_percent},
                                       {"worst_percent", fit.time->worst_percent},
                                       {"worst_at", fit.time->worst_at}}
                        : ordered_json();
    entry["notes"] = fit.notes;
    return entry;
}

/// Empty where it is not known.
std::string known(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace

std::string sweep_csv(const SweepReport& report) {
    std::string text =
        "scene,gaze,method,settings,error,cells_per_frame,rays_per_frame,fewer_cells,"
        "cells_over_fewest,time_ms,time_least_ms,time_greatest_ms,speedup,energy_mj,less_energy,"
        "on_cells_front,on_time_front";
    std::vector<std::string> keys;
    for (const SweepSheet& sheet : report.sheets) {
        if (const SweepRow* const some = row_with_figures(sheet.rows); some && keys.empty()) {
            for (const quality::QualityFigure& figure : some->figures) {
                keys.push_back(figure.key);
                text += ',' + figure.key;
            }
        }
    }
    text += '\n';
    for (const SweepSheet& sheet : report.sheets) {
        for (const SweepRow& row : sheet.rows) {
            text +=
                fmt::format("{},{},{},{},{}", quoted(sheet.of.scene), quoted(sheet.of.gaze),
                            row.point.method, quoted(row.point.settings_text()), quoted(row.error));
            if (!row.error.empty()) {
                constexpr std::size_t kOther = 12;
                text += std::string(kOther + keys.size(), ',') + '\n';
                continue;
            }
            text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{:d},{:d}", row.cells,
                                row.cells * report.subject.samples, row.fewer_cells,
                                row.cells_over_fewest, row.time.median_ms, row.time.least_ms,
                                row.time.greatest_ms, row.speedup, known(row.energy_mj),
                                known(row.less_energy), row.on_cells_front, row.on_time_front);
            for (const std::string& key : keys) {
                text += fmt::format(",{}", find_figure(row, key)->mean);
            }
            text += '\n';
        }
    }
    return text;
}

ordered_json sweep_json(const SweepReport& report) {
    const SweepSubject& subject = report.subject;
    ordered_json json{
        {"program", subject.program},        {"display", subject.display},
        {"device", subject.device},          {"width_px", subject.width_px},
        {"height_px", subject.height_px},    {"eye", subject.eye},
        {"frames", subject.frames},          {"frame_seconds", subject.frame_seconds},
        {"samples", subject.samples},        {"reference_samples", subject.reference_samples},
        {"rounds", subject.rounds},          {"peak_cd_m2", subject.peak_cd_m2},
        {"black_cd_m2", subject.black_cd_m2}};
    auto settings = ordered_json::object();
    for (const auto& [key, text] : subject.settings) {
        settings[key] = text;
    }
    json["settings"] = std::move(settings);
    auto cases = ordered_json::array();
    auto points = ordered_json::array();
    for (const SweepSheet& sheet : report.sheets) {
        ordered_json of_case{{"scene", sheet.of.scene},
                             {"gaze", sheet.of.gaze},
                             {"fewest_cells", finite(sheet.of.fewest_cells)},
                             {"contrast_shares", nullptr}};
        if (sheet.shares) {
            of_case["contrast_shares"] = {{"kept", sheet.shares->kept},
                                          {"between", sheet.shares->between},
                                          {"beyond", sheet.shares->beyond},
                                          {"contrast", sheet.shares->contrast}};
        }
        cases.push_back(std::move(of_case));
        for (const SweepRow& row : sheet.rows) {
            ordered_json entry{{"scene", sheet.of.scene}, {"gaze", sheet.of.gaze}};
            entry.update(row_json(row, subject.samples));
            points.push_back(std::move(entry));
        }
    }
    json["cases"] = std::move(cases);
    json["points"] = std::move(points);
    if (!report.mean.rows.empty()) {
        auto means = ordered_json::array();
        for (const SweepRow& row : report.mean.rows) {
            means.push_back(row_json(row, subject.samples));
        }
        json["means"] = std::move(means);
    }
    const std::vector<SweepRow>& rows = report.summed_rows();
    json["equal_quality"] = levels_json(rows);
    if (const auto worth = method_worth(subject, rows)) {
        json["worth"] = worth_json(*worth);
    }
    if (report.with_fits) {
        auto fits = ordered_json::array();
        for (const MethodFit& fit : setting_fits(rows)) {
            fits.push_back(fit_json(fit));
        }
        json["fits"] = std::move(fits);
    }
    if (report.question.asked()) {
        const auto chosen = value_or_throw(choose(rows, report.question));
        json["recommended"] = {
            {"for", report.question.text(rows)},
            {"point", chosen ? row_json(rows[*chosen], subject.samples) : ordered_json()}};
    }
    return json;
}

}  // namespace gazeloop::trade
