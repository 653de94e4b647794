#include "runtime/trade/layer_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "runtime/foveation/plans/layer_prediction.h"
#include "runtime/report/line_chart.h"
#include "runtime/report/output_file.h"

namespace gazeloop::trade {
namespace {

using foveation::LayerOptions;
using foveation::MarLine;

struct Quality {
    const char* name;
    MarLine line;
};
const std::array<Quality, 2> kQualities{
    {{"A (m = .0275)", {.slope = 0.0275}}, {"B (m = .0220)", {.slope = 0.0220}}}};

struct Choice {
    const char* name;
    LayerOptions options;
};
const std::array<Choice, 4> kChoices{
    {{"n = 2", {.layers = 2, .weights = {}}},
     {"n = 3", {.layers = 3, .weights = {}}},
     {"n = 4", {.layers = 4, .weights = {}}},
     {"n = 3*, s2 = 2", {.layers = 3, .weights = {}, .second_factor = 2.0}}}};
constexpr std::size_t kFourLayers = 2;

constexpr int kFromDeg = 10;
constexpr int kToDeg = 140;

/// Never refused: every parameter is a constant of this file.
foveation::LayerPrediction predict(double fov_deg, const Quality& quality, const Choice& choice) {
    return value_or_throw(foveation::predict_layers(fov_deg, quality.line, choice.options));
}

std::string csv() {
    std::string text = "fov_deg,slope,layers,second_factor,display_pixels,layer_pixels,speedup\n";
    for (const Quality& quality : kQualities) {
        for (const Choice& choice : kChoices) {
            for (int fov = kFromDeg; fov <= kToDeg; ++fov) {
                const auto prediction = predict(fov, quality, choice);
                text += fmt::format("{},{},{},{},{:.0f},{:.0f},{:.3f}\n", fov, quality.line.slope,
                                    choice.options.layers, choice.options.second_factor,
                                    prediction.display_pixels, prediction.layer_pixels,
                                    prediction.speedup());
            }
        }
    }
    return text;
}

const report::ChartAxis kFieldOfView{"field of view, degrees", kFromDeg, kToDeg};
constexpr const char* kDisplay =
    "planar display as sharp as the fovea at its centre, aspect 3:4 (Guenter et al. 2012)";

report::ChartLine line(std::string label, std::size_t colour, const auto& value_at) {
    report::ChartLine line{
        .label = std::move(label), .points = {}, .colour = report::chart_colour(colour)};
    for (int fov = kFromDeg; fov <= kToDeg; ++fov) {
        line.points.push_back({static_cast<double>(fov), value_at(fov)});
    }
    return line;
}

report::LineChart speedup_chart(const Quality& quality) {
    report::LineChart chart{
        .title = fmt::format("Predicted saving of eccentricity layers, {}", quality.name),
        .subtitle = kDisplay,
        .x = kFieldOfView,
        .y = {"display pixels over layer pixels", 1.0, 1000.0, true},
        .lines = {}};
    for (std::size_t i = 0; i < kChoices.size(); ++i) {
        chart.lines.push_back(line(kChoices[i].name, i, [&](int fov) {
            return predict(fov, quality, kChoices[i]).speedup();
        }));
    }
    chart.lines.back().dashes = 1;
    return chart;
}

report::LineChart full_cost_chart() {
    report::LineChart chart{.title = "Predicted cost without layers",
                            .subtitle = kDisplay,
                            .x = kFieldOfView,
                            .y = {"millions of pixels", 0.0, 0.0},
                            .lines = {}};
    chart.lines.push_back(line("every pixel", 0, [](int fov) {
        return predict(fov, kQualities[0], kChoices[0]).display_pixels * 1e-6;
    }));
    chart.y.high = chart.lines[0].points.back().y;
    return chart;
}

report::LineChart layer_cost_chart() {
    report::LineChart chart{.title = "Predicted cost with four layers",
                            .subtitle = kDisplay,
                            .x = kFieldOfView,
                            .y = {"millions of pixels", 0.0, 0.0},
                            .lines = {}};
    for (std::size_t i = 0; i < kQualities.size(); ++i) {
        chart.lines.push_back(line(kQualities[i].name, i, [&](int fov) {
            return predict(fov, kQualities[i], kChoices[kFourLayers]).layer_pixels * 1e-6;
        }));
        chart.y.high = std::max(chart.y.high, 1.05 * chart.lines.back().points.back().y);
    }
    return chart;
}

std::string claims() {
    std::string text = "About 100x at 70 degrees (four layers):";
    for (const Quality& quality : kQualities) {
        text += fmt::format(" {:.1f}x with {}{}", predict(70.0, quality, kChoices[2]).speedup(),
                            quality.name, &quality == &kQualities.back() ? ".\n" : ",");
    }
    text += "Cost about linear in field of view, 20 to 90 degrees (four layers):";
    for (const Quality& quality : kQualities) {
        const auto growth = value_or_throw(
            foveation::layer_cost_growth(20.0, 90.0, quality.line, kChoices[kFourLayers].options));
        text += fmt::format(
            " {}: {:.1f}k pixels per degree, within {:.1f} % of a straight line; exponent {:.2f} "
            "at "
            "90 degrees{}",
            quality.name, growth.slope_per_deg * 1e-3, 100.0 * growth.worst_deviation,
            growth.end_exponent,
            &quality == &kQualities.back() ? " (without layers: 3.14).\n" : ";");
    }
    return text;
}

}  // namespace

Expected<std::string> write_layer_figures(const std::filesystem::path& folder) {
    std::error_code made;
    std::filesystem::create_directories(folder, made);
    if (made) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: the folder cannot be made ({})", folder.string(), made.message())});
    }
    if (auto written = report::write_text(folder / "layers.csv", csv()); !written) {
        return std::unexpected(written.error());
    }
    const std::array<std::pair<const char*, report::LineChart>, 4> charts{
        {{"speedup_a", speedup_chart(kQualities[0])},
         {"speedup_b", speedup_chart(kQualities[1])},
         {"cost_full", full_cost_chart()},
         {"cost_layers", layer_cost_chart()}}};
    for (const auto& [name, chart] : charts) {
        for (const char* const ending : {".png", ".svg"}) {
            if (auto written = report::write_chart(chart, folder / (std::string(name) + ending));
                !written) {
                return std::unexpected(written.error());
            }
        }
    }
    return claims();
}

}  // namespace gazeloop::trade
