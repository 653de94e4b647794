#include "runtime/study/svg_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace gazeloop::study {
namespace {

constexpr double kLeft = 48.0;
constexpr double kRight = 500.0;
constexpr double kTop = 8.0;
constexpr double kBottom = 236.0;

}  // namespace

std::string html_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

SvgPlot::SvgPlot(std::string title, double low, double high, double greatest,
                 std::vector<Mark> marks, std::string x_label, std::string y_label)
    : title_(std::move(title)), low_(low), high_(high), greatest_(greatest) {
    constexpr int kSteps = 5;
    for (int step = 0; step <= kSteps; ++step) {
        const double y = greatest_ * step / kSteps;
        marks_ += fmt::format(
            "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"grid\"/>"
            "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g}</text>\n",
            kLeft, kRight, y_px(y), y_px(y), kLeft - 6, y_px(y) + 4, y);
    }
    for (const Mark& mark : marks) {
        marks_ += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                              x_px(mark.x), kBottom + 15, html_text(mark.label));
    }
    marks_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
        "<text transform=\"translate(11 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        0.5 * (kLeft + kRight), kBottom + 32, html_text(x_label), 0.5 * (kTop + kBottom),
        html_text(y_label));
}

double SvgPlot::x_px(double x) const {
    return std::clamp(kLeft + (x - low_) / (high_ - low_) * (kRight - kLeft), kLeft, kRight);
}

double SvgPlot::y_px(double y) const {
    return std::clamp(kBottom - y / greatest_ * (kBottom - kTop), kTop, kBottom);
}

void SvgPlot::bar(double from, double to, double y, std::string_view colour,
                  std::string_view said) {
    marks_ += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\">"
        "<title>{}</title></rect>\n",
        x_px(from), y_px(y), x_px(to) - x_px(from), kBottom - y_px(y), colour, html_text(said));
}

void SvgPlot::whisker(double x, double from, double to, double width) {
    const double end_px = std::min(6.0, x_px(x + width) - x_px(x));
    marks_ += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}h{4:.1f}M{3:.1f} {2:.1f}h{4:.1f}\" "
        "class=\"whisker\"/>\n",
        x_px(x), y_px(from), y_px(to), x_px(x) - 0.5 * end_px, end_px);
}

void SvgPlot::dot(double x, double y, double radius, std::string_view colour,
                  std::string_view said) {
    marks_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"><title>{}</title></circle>\n",
        x_px(x), y_px(y), radius, colour, html_text(said));
}

void SvgPlot::line(const std::vector<std::pair<double, double>>& points, std::string_view colour) {
    std::string path;
    for (const auto& [x, y] : points) {
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_px(x), y_px(y));
    }
    marks_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path,
                          colour);
}

void SvgPlot::level(double y) {
    marks_ +=
        fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"level\"/>\n",
                    kLeft, kRight, y_px(y), y_px(y));
}

void SvgPlot::upright(double x, std::string_view colour, std::string_view said) {
    marks_ += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"{3}\" "
        "stroke-dasharray=\"5 3\"><title>{4}</title></line>\n",
        x_px(x), kTop, kBottom, colour, html_text(said));
}

std::string SvgPlot::figure() const {
    return fmt::format(
        "<figure><figcaption>{0}</figcaption><svg viewBox=\"0 0 {1} {2}\" role=\"img\" "
        "aria-label=\"{0}\">\n{3}</svg></figure>\n",
        html_text(title_), kRight + 12, kBottom + 38, marks_);
}

std::string_view plot_colour(std::size_t index) {
    constexpr std::array<std::string_view, 8> kColours{"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                       "#56b4e9", "#d55e00", "#8a8a00", "#444444"};
    return kColours[index % kColours.size()];
}

}  // namespace gazeloop::study
