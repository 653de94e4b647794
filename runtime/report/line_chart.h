#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::report {

/// A straight or logarithmic axis. `low` < `high`, both finite; logarithmic: both > 0.
struct ChartAxis {
    std::string label;  ///< with its unit
    double low = 0.0;
    double high = 1.0;
    bool logarithmic = false;
};

struct ChartPoint {
    double x = 0.0;
    double y = 0.0;
};

struct ChartLine {
    std::string label;
    std::vector<ChartPoint> points;  ///< by x; the line breaks at a point that cannot be drawn
    std::array<double, 3> colour{};  ///< sRGB, 0 to 1
    std::size_t dashes = 0;          ///< 0 solid, 1 dashed, 2 dash-dotted, 3 dotted
    double width = 2.0;
};

struct LineChart {
    std::string title;
    std::string subtitle;
    ChartAxis x;
    ChartAxis y;
    std::vector<ChartLine> lines;  ///< in the order of the legend
};

/// Nine colours, then the same again. Colour-blind readers can tell them apart as well (Okabe and
/// Ito 2008; the last two are of Tol 2021).
[[nodiscard]] std::array<double, 3> chart_colour(std::size_t index);

/// Draws the chart into a .png or .svg file. Errors: Usage for any other ending, BadInput if the
/// file cannot be written.
Expected<void> write_chart(const LineChart& chart, const std::filesystem::path& file);

}  // namespace gazeloop::report
