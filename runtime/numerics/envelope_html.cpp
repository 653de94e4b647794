#include "runtime/numerics/envelope_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runtime/numerics/envelope_groups.h"
#include "runtime/numerics/envelope_text.h"

namespace gazeloop::numerics {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>gazeloop: the numerical envelope</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1f24; background: #fff; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
p { max-width: 46rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(30rem, 1fr)); gap: 1rem; }
figure { margin: 0; } figcaption { font-weight: 600; }
svg { width: 100%; height: auto; } svg text { font: 11px system-ui, sans-serif; fill: #444c56; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .55rem; text-align: right; border-bottom: 1px solid #e3e6ea; }
th { position: sticky; top: 0; background: #fff; }
th.name, td.name, td.note { text-align: left; } td.name { white-space: nowrap; }
tr.noted td { border-bottom: 0; } td.note { color: #6a737d; padding-left: 1.8rem; }
.missed { color: #b3261e; font-weight: 600; } .met { color: #1a7f37; }
.key span { display: inline-block; width: .8em; height: .8em; border-radius: 50%; margin: 0 .35em 0 1em; }
@media (max-width: 68rem) { .scroll { overflow-x: auto; } }
</style></head><body>
)";

constexpr std::string_view kFloatColor = "#1f6feb";
constexpr std::string_view kDeviceColor = "#d4740c";
constexpr double kLeastPx = 1e-5;
constexpr double kGreatestPx = 10.0;

std::string escaped(std::string_view text) {
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

std::string title_of(const EnvelopeGroup& group) {
    return fmt::format("{}x{}, fovea {} the screen", group.image.width_px, group.image.height_px,
                       group.on_screen ? "on" : "off");
}

/// One panel: a line for each map, dots on a logarithmic axis of pixels.
std::string panel(const std::vector<EnvelopeGroup>& groups, const std::string& title) {
    constexpr double kLeft = 150.0;
    constexpr double kRight = 520.0;
    constexpr double kLine = 17.0;
    constexpr double kTop = 8.0;
    const auto x = [](double px) {
        const double share = std::log10(std::clamp(px, kLeastPx, kGreatestPx) / kLeastPx) /
                             std::log10(kGreatestPx / kLeastPx);
        return kLeft + share * (kRight - kLeft);
    };
    std::string marks;
    double y = kTop;
    for (const EnvelopeGroup& group : groups) {
        if (title_of(group) != title) {
            continue;
        }
        y += kLine;
        marks += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", kLeft - 8,
                             y + 4, escaped(group.map));
        if (group.useless == group.rows) {
            marks += fmt::format("<text x=\"{}\" y=\"{}\">useless: {}</text>\n", kLeft + 4, y + 4,
                                 escaped(group.why_useless));
            continue;
        }
        const auto bar = [&](double from, double to, std::string_view color, double height) {
            marks += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>\n",
                x(from), y - height / 2, x(to) - x(from), height, color);
        };
        bar(kLeastPx, group.bound_px, "#e8ecf1", 11);
        bar(kLeastPx, group.conditioning_px, "#c3ccd6", 11);
        marks += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#b3261e\" "
            "stroke-width=\"1.5\"/>\n",
            x(group.target_px), y - 7, y + 7);
        const auto dot = [&](double px, std::string_view color, double radius) {
            marks += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{}\" r=\"{}\" fill=\"{}\"><title>{}: {:.5f} px</title>"
                "</circle>\n",
                x(px), y, radius, color, escaped(group.map), px);
        };
        dot(group.device_px, kDeviceColor, 5);
        dot(group.cpu_px, kFloatColor, 3);
    }
    const double bottom = y + kLine;
    std::string grid;
    for (int decade = -5; decade <= 1; ++decade) {
        const double at = x(std::pow(10.0, decade));
        grid += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#eef0f3\"/>"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
            at, kTop, bottom, bottom + 13, std::pow(10.0, decade));
    }
    return fmt::format(
        "<figure><figcaption>{}</figcaption><svg viewBox=\"0 0 {} {}\" role=\"img\" "
        "aria-label=\"errors in pixels\">\n{}{}<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">px"
        "</text></svg></figure>\n",
        title, kRight + 20, bottom + 30, grid, marks, 0.5 * (kLeft + kRight), bottom + 27);
}

std::string plots(const std::vector<EnvelopeGroup>& groups) {
    std::vector<std::string> titles;
    for (const EnvelopeGroup& group : groups) {
        if (std::ranges::find(titles, title_of(group)) == titles.end()) {
            titles.push_back(title_of(group));
        }
    }
    std::string html = "<div class=\"plots\">\n";
    for (const std::string& title : titles) {
        html += panel(groups, title);
    }
    return html + "</div>\n";
}

std::string table(const std::vector<EnvelopeGroup>& groups) {
    constexpr int kColumns = 13;
    std::string html =
        "<div class=\"scroll\"><table><thead><tr><th "
        "class=\"name\">map<th>picture<th>fovea<th>float"
        "<th>device<th>bound<th>float32<th>target<th>texels<th>seam<th>fall<th>not finite<th>"
        "</tr></thead>\n<tbody>\n";
    for (const EnvelopeGroup& group : groups) {
        html += fmt::format(
            "<tr{}><td class=\"name\">{}<td>{}x{}<td>{}<td>{:.5f}<td>{:.5f}<td>{:.5f}<td>{:.5f}"
            "<td>{:.5f}<td>{:.5f}<td>{:.5f}<td>{:.5f}<td>{}<td class=\"{}\">{}</tr>\n",
            group.useless > 0 ? " class=\"noted\"" : "", escaped(group.map), group.image.width_px,
            group.image.height_px, group.on_screen ? "on" : "off", group.cpu_px, group.device_px,
            group.bound_px, group.conditioning_px, group.target_px, group.texels, group.seam_px,
            group.fall_px, group.not_finite, group.met ? "met" : "missed",
            group.met ? "met" : "missed");
        if (group.useless > 0) {
            html += fmt::format(
                "<tr><td class=\"note\" colspan=\"{}\">{} of {} useless ({}: {})</tr>\n", kColumns,
                group.useless, group.rows, escaped(group.useless_where),
                escaped(group.why_useless));
        }
    }
    return html + "</tbody></table></div>\n";
}

std::string builds(const Envelope& envelope) {
    std::string html = "<table><thead><tr><th class=\"name\">map<th>ms</tr></thead><tbody>\n";
    for (const TableBuild& build : envelope.tables) {
        html += fmt::format("<tr><td class=\"name\">{}<td>{:.3f}</tr>\n", escaped(build.map),
                            build.milliseconds);
    }
    return html + "</tbody></table>\n";
}

}  // namespace

std::string envelope_html(const Envelope& envelope) {
    const std::vector<EnvelopeGroup> groups = grouped(envelope);
    return fmt::format(
        "{}<h1>The numerical envelope</h1>\n<p>Measured on {} ({}) in {:.0f} s. <b "
        "class=\"{}\">{}</b></p>\n"
        "<p>Every map in float against double precision, in pixels of the picture: where the float "
        "shares of a pixel lead back to, and where the centre of a texel is placed; between the "
        "centres of the first and the last column, beyond which the sampler clamps.</p>\n"
        "<p class=\"key\"><span style=\"background:{}\"></span>the shader's arithmetic on the CPU"
        "<span style=\"background:{}\"></span>the shader on the device"
        "<span style=\"background:#c3ccd6\"></span>what a float32 u and v cost alone"
        "<span style=\"background:#e8ecf1\"></span>the derived bound"
        "<span style=\"background:#b3261e\"></span>target</p>\n{}"
        "<h2>Figures</h2>\n"
        "<p>Pixels, of the sigma and gaze that come closest to their target, as in the plots; "
        "seam, fall "
        "and texels are the largest of any. Texels: the forward error in columns. Seam: beside the "
        "direction in which the "
        "angle wraps. Fall: the largest step back of u along a line outward.</p>\n{}"
        "<h2>Building the tables of one eye of 2160x2160</h2>\n{}</body></html>\n",
        kHead, escaped(envelope.device), escaped(envelope.driver), envelope.seconds,
        envelope.met() ? "met" : "missed", escaped(verdict(envelope)), kFloatColor, kDeviceColor,
        plots(groups), table(groups), builds(envelope));
}

}  // namespace gazeloop::numerics
