#include "runtime/trade/sweep_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace gazeloop::trade {
namespace {

using nlohmann::ordered_json;

/// The figures that the table has room for.
constexpr std::array kShown{"contrast", "contrast_flicker", "flip", "ssim_weighted",
                            "psnr_weighted_db"};

const quality::QualityFigure* find(const SweepRow& row, std::string_view key) {
    const auto found = std::ranges::find(row.figures, key, &quality::QualityFigure::key);
    return found == row.figures.end() ? nullptr : &*found;
}

/// The first point that has figures tells which there are.
const SweepRow* with_figures(const std::vector<SweepRow>& rows) {
    const auto found =
        std::ranges::find_if(rows, [](const SweepRow& row) { return !row.figures.empty(); });
    return found == rows.end() ? nullptr : &*found;
}

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

}  // namespace

std::string sweep_text(const SweepSubject& subject, const SweepQuestion& question,
                       std::vector<SweepRow> rows) {
    const gaze::EyeView& view = question.comparison.view;
    std::string text = fmt::format(
        "scene {}, {}, {}x{} px per eye, gaze {}, {} frame{}, {} samples; quality of the {} eye "
        "against full resolution with {} samples\n{}\n\n",
        question.scene, subject.display, view.width_px, view.height_px, subject.gaze,
        question.gaze.size(), question.gaze.size() == 1 ? "" : "s", question.samples,
        gaze::kEyeNames[gaze::index(question.comparison.eye)], question.reference_samples,
        subject.device);
    std::ranges::stable_sort(rows, std::ranges::greater{}, &SweepRow::cells);
    const SweepRow* const some = with_figures(rows);
    text += fmt::format("{:40} {:>7} {:>7} {:>9} {:>19} {:>7}", "point", "fewer", "bound", "ms",
                        "(least-most)", "faster");
    for (const char* const key : kShown) {
        if (some != nullptr && find(*some, key) != nullptr) {
            text += fmt::format(" {:>16}", key);
        }
    }
    text += "  front\n";
    for (const SweepRow& row : rows) {
        const std::string name = fmt::format("{} {}", row.point.method, row.point.settings_text());
        if (!row.error.empty()) {
            text += fmt::format("{:40} failed: {}\n", name, row.error);
            continue;
        }
        text += fmt::format(
            "{:40} {:>6.2f}x {:>9.2f} {:>19} {:>6.2f}x", name, row.fewer_cells, row.time.median_ms,
            fmt::format("({:.2f}-{:.2f})", row.time.least_ms, row.time.greatest_ms), row.speedup);
        for (const char* const key : kShown) {
            if (const quality::QualityFigure* const figure = find(row, key)) {
                text += fmt::format(" {:>16.4f}", figure->mean);
            }
        }
        text += fmt::format("  {}{}\n", row.on_cells_front ? "cells " : "",
                            row.on_time_front ? "time" : "");
    }
    text +=
        "\nfewer: cells shaded, against full resolution. bound: over the fewest that Guenter's "
        "line "
        "asks for. ms: all passes of a frame, both eyes. "
        "front: no other point is cheaper and better by the first figure.\n";
    for (const quality::QualityFigure& figure :
         some == nullptr ? std::vector<quality::QualityFigure>() : some->figures) {
        if (std::ranges::find(kShown, figure.key) != kShown.end()) {
            text += fmt::format("{}: {} is better; {}\n", figure.key,
                                figure.lower_is_better ? "lower" : "higher", figure.meaning);
        }
    }
    return text;
}

std::string sweep_csv(const std::vector<SweepRow>& rows) {
    std::string text =
        "method,settings,error,cells_per_frame,fewer_cells,cells_over_fewest,time_ms,time_least_ms,"
        "time_greatest_ms,"
        "speedup,on_cells_front,on_time_front";
    const SweepRow* const some = with_figures(rows);
    std::vector<std::string> keys;
    if (some != nullptr) {
        for (const quality::QualityFigure& figure : some->figures) {
            keys.push_back(figure.key);
            text += ',' + figure.key;
        }
    }
    text += '\n';
    for (const SweepRow& row : rows) {
        text += fmt::format("{},{},{}", row.point.method, quoted(row.point.settings_text()),
                            quoted(row.error));
        if (!row.error.empty()) {
            text += std::string(9 + keys.size(), ',') + '\n';
            continue;
        }
        text +=
            fmt::format(",{},{},{},{},{},{},{},{:d},{:d}", row.cells, row.fewer_cells,
                        row.cells_over_fewest, row.time.median_ms, row.time.least_ms,
                        row.time.greatest_ms, row.speedup, row.on_cells_front, row.on_time_front);
        for (const std::string& key : keys) {
            text += fmt::format(",{}", find(row, key)->mean);
        }
        text += '\n';
    }
    return text;
}

ordered_json sweep_json(const SweepSubject& subject, const SweepQuestion& question,
                        const std::vector<SweepRow>& rows) {
    const quality::DisplayLight& light = question.comparison.contrast.light;
    ordered_json json{{"scene", question.scene},
                      {"display", subject.display},
                      {"device", subject.device},
                      {"width_px", question.comparison.view.width_px},
                      {"height_px", question.comparison.view.height_px},
                      {"eye", gaze::kEyeNames[gaze::index(question.comparison.eye)]},
                      {"gaze", subject.gaze},
                      {"frames", question.gaze.size()},
                      {"frame_seconds", question.frame_seconds},
                      {"samples", question.samples},
                      {"reference_samples", question.reference_samples},
                      {"rounds", question.rounds},
                      {"peak_cd_m2", light.peak_cd_m2},
                      {"black_cd_m2", light.black_cd_m2}};
    auto points = ordered_json::array();
    for (const SweepRow& row : rows) {
        auto settings = ordered_json::object();
        for (const auto& [key, value] : row.point.settings) {
            settings[key] = value;
        }
        ordered_json entry{{"method", row.point.method}, {"settings", std::move(settings)}};
        if (!row.error.empty()) {
            entry["error"] = row.error;
            points.push_back(std::move(entry));
            continue;
        }
        entry["cells_per_frame"] = row.cells;
        entry["fewer_cells"] = finite(row.fewer_cells);
        entry["cells_over_fewest"] = finite(row.cells_over_fewest);
        entry["rays_per_frame"] = row.cells * question.samples;
        entry["time_ms"] = {{"median", row.time.median_ms},
                            {"least", row.time.least_ms},
                            {"greatest", row.time.greatest_ms}};
        entry["pass_ms"] = ordered_json::object();
        for (const auto& [pass, ms] : row.pass_ms) {
            entry["pass_ms"][pass] = ms;
        }
        entry["speedup"] = finite(row.speedup);
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
        points.push_back(std::move(entry));
    }
    json["points"] = std::move(points);
    return json;
}

}  // namespace gazeloop::trade
