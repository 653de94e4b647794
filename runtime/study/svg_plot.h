#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::study {

/// Text as HTML shows it.
[[nodiscard]] std::string html_text(std::string_view text);

/// One plot with shares on its vertical axis, from 0 to `greatest`, as inline SVG.
class SvgPlot {
  public:
    /// `marks`: of the horizontal axis, by their place.
    struct Mark {
        double x = 0.0;
        std::string label;
    };
    SvgPlot(std::string title, double low, double high, double greatest, std::vector<Mark> marks,
            std::string x_label, std::string y_label);

    void bar(double from, double to, double y, std::string_view colour, std::string_view said);
    /// Whiskers, whose ends are no wider than `width`, on the axis; ends outside the plot are cut.
    void whisker(double x, double from, double to, double width);
    void dot(double x, double y, double radius, std::string_view colour, std::string_view said);
    void line(const std::vector<std::pair<double, double>>& points, std::string_view colour);
    /// A dashed horizontal line.
    void level(double y);
    void upright(double x, std::string_view colour, std::string_view said);

    [[nodiscard]] std::string figure() const;

  private:
    [[nodiscard]] double x_px(double x) const;
    [[nodiscard]] double y_px(double y) const;

    std::string title_;
    double low_;
    double high_;
    double greatest_;
    std::string marks_;
};

/// Colours that colour-blind readers can also tell apart (Okabe and Ito 2008).
[[nodiscard]] std::string_view plot_colour(std::size_t index);

}  // namespace gazeloop::study
