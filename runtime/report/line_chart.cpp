#include "runtime/report/line_chart.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "runtime/files/output_file.h"

namespace gazeloop::report {
namespace {

constexpr double kWidth = 1200.0;
constexpr double kHeight = 720.0;
constexpr double kLeft = 90.0;
constexpr double kRight = 880.0;  // the legend stands to the right of it
constexpr double kTop = 90.0;
constexpr double kBottom = 640.0;
constexpr double kText = 15.0;

struct Destroy {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Context = std::unique_ptr<cairo_t, Destroy>;
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;

struct Tick {
    double value = 0.0;
    bool labelled = true;
};

std::vector<Tick> logarithmic_ticks(const ChartAxis& axis) {
    std::vector<Tick> ticks;
    const bool few_decades = axis.high / axis.low < 3000.0;
    for (double decade = std::floor(std::log10(axis.low)); decade <= std::log10(axis.high);
         decade += 1.0) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, decade);
            if (value >= axis.low * (1 - 1e-9) && value <= axis.high * (1 + 1e-9)) {
                ticks.push_back({value, digit == 1 || (few_decades && (digit == 2 || digit == 5))});
            }
        }
    }
    return ticks;
}

std::vector<Tick> straight_ticks(const ChartAxis& axis) {
    const double rough = (axis.high - axis.low) / 8.0;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * decade;
    for (const double digit : {5.0, 2.0, 1.0}) {
        step = digit * decade >= rough ? digit * decade : step;
    }
    std::vector<Tick> ticks;
    for (double i = std::ceil(axis.low / step); i * step <= axis.high + 1e-9 * step; i += 1.0) {
        ticks.push_back({i * step});
    }
    return ticks;
}

/// Where a value lies along an axis, 0 to 1 between its ends.
double share(const ChartAxis& axis, double value) {
    return axis.logarithmic ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                            : (value - axis.low) / (axis.high - axis.low);
}

class Drawing {
  public:
    Drawing(cairo_t* context, const LineChart& chart) : c_(context), chart_(chart) {
        cairo_select_font_face(c_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                               CAIRO_FONT_WEIGHT_NORMAL);
    }

    void draw() {
        cairo_set_source_rgb(c_, 1.0, 1.0, 1.0);
        cairo_paint(c_);
        cairo_set_source_rgb(c_, 0.1, 0.1, 0.1);
        text(chart_.title, kLeft, 40.0, 20.0, 0.0);
        text(chart_.subtitle, kLeft, 66.0, kText, 0.0);
        draw_axis(chart_.x, false);
        draw_axis(chart_.y, true);
        cairo_save(c_);
        cairo_rectangle(c_, kLeft, kTop, kRight - kLeft, kBottom - kTop);
        cairo_clip(c_);
        for (const ChartLine& line : chart_.lines) {
            draw_line(line);
        }
        cairo_restore(c_);
        draw_legend();
    }

  private:
    [[nodiscard]] double x(double value) const {
        return std::lerp(kLeft, kRight, share(chart_.x, value));
    }
    [[nodiscard]] double y(double value) const {
        return std::lerp(kBottom, kTop, share(chart_.y, value));
    }

    /// `align`: 0 starts at x, .5 is centred on it, 1 ends there.
    void text(const std::string& words, double x, double y, double size, double align) {
        cairo_set_font_size(c_, size);
        cairo_text_extents_t extents;
        cairo_text_extents(c_, words.c_str(), &extents);
        cairo_move_to(c_, x - align * extents.x_advance, y);
        cairo_show_text(c_, words.c_str());
    }

    void draw_axis(const ChartAxis& axis, bool vertical) {
        for (const Tick& tick : axis.logarithmic ? logarithmic_ticks(axis) : straight_ticks(axis)) {
            const double shade = tick.labelled ? 0.80 : 0.91;
            cairo_set_source_rgb(c_, shade, shade, shade);
            cairo_set_line_width(c_, 1.0);
            if (vertical) {
                cairo_move_to(c_, kLeft, y(tick.value));
                cairo_line_to(c_, kRight, y(tick.value));
            } else {
                cairo_move_to(c_, x(tick.value), kTop);
                cairo_line_to(c_, x(tick.value), kBottom);
            }
            cairo_stroke(c_);
            if (!tick.labelled) {
                continue;
            }
            cairo_set_source_rgb(c_, 0.1, 0.1, 0.1);
            const std::string label = fmt::format("{:.6g}", tick.value);
            if (vertical) {
                text(label, kLeft - 8.0, y(tick.value) + 5.0, kText, 1.0);
            } else {
                text(label, x(tick.value), kBottom + 22.0, kText, 0.5);
            }
        }
        cairo_set_source_rgb(c_, 0.1, 0.1, 0.1);
        cairo_rectangle(c_, kLeft, kTop, kRight - kLeft, kBottom - kTop);
        cairo_stroke(c_);
        if (!vertical) {
            text(axis.label, 0.5 * (kLeft + kRight), kBottom + 50.0, kText, 0.5);
            return;
        }
        cairo_save(c_);
        cairo_translate(c_, 26.0, 0.5 * (kTop + kBottom));
        cairo_rotate(c_, -std::acos(0.0));
        text(axis.label, 0.0, 0.0, kText, 0.5);
        cairo_restore(c_);
    }

    void pen(const ChartLine& line) {
        cairo_set_source_rgb(c_, line.colour[0], line.colour[1], line.colour[2]);
        cairo_set_line_width(c_, line.width);
        static const std::array<std::vector<double>, 4> kDashes{
            {{}, {9.0, 6.0}, {10.0, 4.0, 2.0, 4.0}, {2.0, 4.0}}};
        const std::vector<double>& dash = kDashes.at(line.dashes);
        cairo_set_dash(c_, dash.data(), static_cast<int>(dash.size()), 0.0);
    }

    void draw_line(const ChartLine& line) {
        pen(line);
        const auto drawable = [](const ChartAxis& axis, double value) {
            return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
        };
        bool drawing = false;
        for (const ChartPoint& point : line.points) {
            if (!drawable(chart_.x, point.x) || !drawable(chart_.y, point.y)) {
                drawing = false;
                continue;
            }
            if (drawing) {
                cairo_line_to(c_, x(point.x), y(point.y));
            } else {
                cairo_move_to(c_, x(point.x), y(point.y));
            }
            drawing = true;
        }
        cairo_stroke(c_);
        cairo_set_dash(c_, nullptr, 0, 0.0);
    }

    void draw_legend() {
        double at = kTop + 12.0;
        for (const ChartLine& line : chart_.lines) {
            pen(line);
            cairo_move_to(c_, kRight + 18.0, at - 5.0);
            cairo_line_to(c_, kRight + 58.0, at - 5.0);
            cairo_stroke(c_);
            cairo_set_dash(c_, nullptr, 0, 0.0);
            cairo_set_source_rgb(c_, 0.1, 0.1, 0.1);
            text(line.label, kRight + 66.0, at, kText - 1.0, 0.0);
            at += 26.0;
        }
    }

    cairo_t* c_;
    const LineChart& chart_;
};

std::unexpected<Error> refuse(const std::filesystem::path& file, cairo_status_t status) {
    return std::unexpected(
        Error{ErrorKind::BadInput,
              fmt::format("{}: the chart could not be written ({}); is the folder there and "
                          "writable?",
                          file.string(), cairo_status_to_string(status))});
}

}  // namespace

std::array<double, 3> chart_colour(std::size_t index) {
    static constexpr std::array<std::array<double, 3>, 9> kColours{{{0.00, 0.45, 0.70},
                                                                    {0.84, 0.37, 0.00},
                                                                    {0.00, 0.62, 0.45},
                                                                    {0.80, 0.47, 0.65},
                                                                    {0.90, 0.62, 0.00},
                                                                    {0.34, 0.71, 0.91},
                                                                    {0.45, 0.45, 0.45},
                                                                    {0.53, 0.13, 0.33},
                                                                    {0.50, 0.50, 0.10}}};
    return kColours.at(index % kColours.size());
}

Expected<void> write_chart(const LineChart& chart, const std::filesystem::path& file) {
    const bool svg = file.extension() == ".svg";
    if (!svg && file.extension() != ".png") {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("{}: a chart is a .png or .svg file", file.string())});
    }
    // Cairo would replace what is no file, and leaves half a file where it fails.
    std::string bytes;
    const cairo_write_func_t append = [](void* all, const unsigned char* some, unsigned size) {
        static_cast<std::string*>(all)->append(reinterpret_cast<const char*>(some), size);
        return CAIRO_STATUS_SUCCESS;
    };
    const Surface surface(svg ? cairo_svg_surface_create_for_stream(append, &bytes, kWidth, kHeight)
                              : cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                           static_cast<int>(kWidth),
                                                           static_cast<int>(kHeight)));
    {
        const Context context(cairo_create(surface.get()));
        Drawing(context.get(), chart).draw();
        if (const auto status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) {
            return refuse(file, status);
        }
    }
    if (!svg) {
        const cairo_status_t status =
            cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
        return status == CAIRO_STATUS_SUCCESS ? files::write_text(file, bytes)
                                              : refuse(file, status);
    }
    cairo_surface_finish(surface.get());
    const cairo_status_t status = cairo_surface_status(surface.get());
    return status == CAIRO_STATUS_SUCCESS ? files::write_text(file, bytes) : refuse(file, status);
}

}  // namespace gazeloop::report
