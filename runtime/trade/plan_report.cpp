#include "runtime/trade/plan_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/foveation/eye/fewest_samples.h"

namespace gazeloop::trade {
namespace {

std::string thousands(double samples) { return fmt::format("{:.1f}k", samples * 1e-3); }

/// "1.00", or what to say where the model asks for nothing.
std::string ratio(double value) {
    return std::isfinite(value) ? fmt::format("{:.2f}", value) : std::string("none");
}

std::string heading(const PlanQuestion& question) {
    const gaze::EyeView& view = question.field->view();
    const gaze::PixelPosition fovea = question.field->fovea();
    return fmt::format("{}, {} eye, {}x{} px, gaze {:g},{:g} deg (pixel {:.0f},{:.0f})",
                       question.display, gaze::kEyeNames[gaze::index(question.eye)], view.width_px,
                       view.height_px, question.azimuth_deg, question.elevation_deg, fovea.x_px,
                       fovea.y_px) +
           (question.widening_deg > 0.0
                ? fmt::format(", fovea widened by {:.4g} deg{}", question.widening_deg,
                              question.widening_terms.empty()
                                  ? std::string()
                                  : fmt::format(" ({})", question.widening_terms))
                : std::string());
}

/// Nothing where the divisor is: an eye that sees none of the picture asks for no sample.
std::string times(double ratio) {
    return std::isfinite(ratio) ? fmt::format("{:.2f}x", ratio) : std::string("-");
}

}  // namespace

PlanReport make_plan_report(PlanQuestion question, std::vector<PlanRow> rows) {
    PlanReport report{.question = std::move(question), .fewest = {}, .rows = std::move(rows)};
    const PlanQuestion& asked = report.question;
    const gaze::EyeView& view = asked.field->view();
    report.display_pixels = std::uint64_t{view.width_px} * view.height_px;
    for (const foveation::AcuityModel* const model : asked.models) {
        report.fewest.push_back(foveation::fewest_samples(*asked.field, *model, asked.eye));
    }
    for (PlanRow& row : report.rows) {
        for (std::size_t i = 0; i < asked.models.size(); ++i) {
            row.verdicts.push_back({foveation::check_sufficiency(*asked.field, *row.plan.density,
                                                                 *asked.models[i], asked.eye),
                                    static_cast<double>(row.plan.samples) / report.fewest[i]});
        }
    }
    return report;
}

std::string plan_report_text(const PlanReport& report) {
    const PlanQuestion& asked = report.question;
    std::string text = heading(asked) + "\n\n";
    text += fmt::format("{:24} {:>10} {:>8}\n", "fewest samples by", "samples", "display");
    for (std::size_t i = 0; i < asked.models.size(); ++i) {
        text += fmt::format("  {:22} {:>10} {:>8}\n", asked.models[i]->name(),
                            thousands(report.fewest[i]),
                            times(static_cast<double>(report.display_pixels) / report.fewest[i]));
    }
    for (const PlanRow& row : report.rows) {
        text += fmt::format("\n{} {}\n", row.method, row.plan.parameters);
        text += fmt::format(
            "  {} samples, {:.2f}x fewer than the display's pixels\n",
            thousands(static_cast<double>(row.plan.samples)),
            static_cast<double>(report.display_pixels) / static_cast<double>(row.plan.samples));
        if (!row.plan.useless.empty()) {
            text += fmt::format("  useless: {}\n", row.plan.useless);
        }
        for (std::size_t i = 0; i < asked.models.size(); ++i) {
            const PlanVerdict& verdict = row.verdicts[i];
            if (!std::isfinite(verdict.sufficiency.least_ratio)) {
                text += fmt::format("  {:14} asks for nothing in view\n", asked.models[i]->name());
                continue;
            }
            const foveation::FieldPoint& worst = verdict.sufficiency.worst;
            text += fmt::format(
                "  {:14} {:12} least {:>4} at {:.1f} deg (pixel {:.0f},{:.0f}); {} the "
                "fewest\n",
                asked.models[i]->name(), verdict.sufficiency.sufficient() ? "enough" : "not enough",
                ratio(verdict.sufficiency.least_ratio), worst.eccentricity_deg, worst.pixel.x_px,
                worst.pixel.y_px, times(verdict.samples_over_fewest));
        }
    }
    text +=
        "\nleast: offered over required samples per degree in the worst direction, where it is "
        "least; required is what the model asks for, and at most what the display can show.\n";
    return text;
}

std::string plan_report_json(const PlanReport& report) {
    using nlohmann::ordered_json;
    const PlanQuestion& asked = report.question;
    const gaze::EyeView& view = asked.field->view();
    ordered_json json{{"display", asked.display},
                      {"eye", gaze::kEyeNames[gaze::index(asked.eye)]},
                      {"width_px", view.width_px},
                      {"height_px", view.height_px},
                      {"gaze_deg", {asked.azimuth_deg, asked.elevation_deg}},
                      {"fovea_px", {asked.field->fovea().x_px, asked.field->fovea().y_px}},
                      {"widening_deg", asked.widening_deg},
                      {"widening_terms", asked.widening_terms},
                      {"display_pixels", report.display_pixels}};
    auto models = ordered_json::array();
    for (std::size_t i = 0; i < asked.models.size(); ++i) {
        models.push_back({{"model", asked.models[i]->name()},
                          {"fewest_samples", report.fewest[i]},
                          {"display_over_fewest",
                           static_cast<double>(report.display_pixels) / report.fewest[i]}});
    }
    json["models"] = std::move(models);
    auto methods = ordered_json::array();
    for (const PlanRow& row : report.rows) {
        ordered_json entry{{"method", row.method},
                           {"parameters", row.plan.parameters},
                           {"samples", row.plan.samples},
                           {"display_over_samples", static_cast<double>(report.display_pixels) /
                                                        static_cast<double>(row.plan.samples)}};
        ordered_json figures = ordered_json::object();
        for (const methods::PlanFigure& figure : row.plan.figures) {
            figures[figure.name] = figure.value;
        }
        entry["figures"] = std::move(figures);
        entry["useless"] = row.plan.useless;
        auto verdicts = ordered_json::array();
        for (std::size_t i = 0; i < asked.models.size(); ++i) {
            const PlanVerdict& verdict = row.verdicts[i];
            const foveation::FieldPoint& worst = verdict.sufficiency.worst;
            const double least = verdict.sufficiency.least_ratio;
            verdicts.push_back(
                {{"model", asked.models[i]->name()},
                 {"sufficient", verdict.sufficiency.sufficient()},
                 // Nothing is asked for: no ratio.
                 {"least_ratio", std::isfinite(least) ? ordered_json(least) : ordered_json()},
                 {"at_eccentricity_deg", worst.eccentricity_deg},
                 {"at_direction_deg", glm::degrees(worst.direction_rad)},
                 {"at_px", {worst.pixel.x_px, worst.pixel.y_px}},
                 {"samples_over_fewest", verdict.samples_over_fewest}});
        }
        entry["sufficiency"] = std::move(verdicts);
        methods.push_back(std::move(entry));
    }
    json["methods"] = std::move(methods);
    return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

report::LineChart density_chart(const PlanReport& report) {
    constexpr double kFromDeg = 0.1;
    constexpr int kPoints = 320;
    const PlanQuestion& asked = report.question;
    const foveation::GazeField& field = *asked.field;
    report::LineChart chart{
        .title = "Offered and required sampling density",
        .subtitle = heading(asked),
        .x = {"eccentricity from the gaze, degrees", kFromDeg,
              std::max(field.greatest_eccentricity_deg(), 10.0 * kFromDeg), true},
        .y = {"samples per degree, in the direction served worst", 0.5, 100.0, true},
        .lines = {}};
    double highest = 0.0;
    std::size_t colour = 0;
    for (const PlanRow& row : report.rows) {
        const bool useless = !row.plan.useless.empty();
        report::ChartLine line{
            .label = fmt::format("{}: {}", row.method,
                                 useless ? std::string("useless")
                                         : thousands(static_cast<double>(row.plan.samples))),
            .points = {},
            .colour = report::chart_colour(colour),
            // The first shows at both sides of what covers it: full resolution offers as much as
            // any.
            .width = colour == 0 ? 5.0 : 2.0};
        ++colour;
        const auto profile =
            useless ? std::vector<foveation::DensityAt>()
                    : foveation::density_profile(field, *row.plan.density, kFromDeg, kPoints);
        for (const foveation::DensityAt& at : profile) {
            line.points.push_back({at.eccentricity_deg, at.per_deg});
            highest = std::max(highest, at.per_deg);
        }
        chart.lines.push_back(std::move(line));
    }
    for (std::size_t i = 0; i < asked.models.size(); ++i) {
        report::ChartLine line{
            .label = fmt::format("{}: {}", asked.models[i]->name(), thousands(report.fewest[i])),
            .points = {},
            .colour = {0.1, 0.1, 0.1},
            .dashes = 1 + i % 3,
            .width = 1.5};
        for (int point = 0; point < kPoints; ++point) {
            const double eccentricity =
                kFromDeg * std::pow(chart.x.high / kFromDeg, point / (kPoints - 1.0));
            // To the temporal side: the direction in which the models agree with their papers.
            line.points.push_back(
                {eccentricity, foveation::required_per_deg(*asked.models[i], eccentricity, 0.0)});
        }
        highest = std::max(highest, line.points.front().y);
        chart.lines.push_back(std::move(line));
    }
    chart.y.high = std::max(chart.y.high, 1.2 * highest);
    return chart;
}

}  // namespace gazeloop::trade
