#include "runtime/trade/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/fixed/fixed_source.h"
#include "runtime/foveation/eye/fovea_widening.h"
#include "runtime/foveation/eye/geisler_perry_acuity.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/resolution_limit.h"
#include "runtime/foveation/eye/stela_acuity.h"
#include "runtime/gaze/direction.h"
#include "runtime/methods/registry.h"
#include "runtime/report/output_file.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/trade/layer_figures.h"
#include "runtime/trade/plan_report.h"
#include "runtime/trade/tracker_widening.h"

namespace gazeloop::trade {
namespace {

using Models = std::vector<std::unique_ptr<foveation::AcuityModel>>;

Models acuity_models(const methods::AcuitySettings& set) {
    Models models;
    models.push_back(value_or_throw(foveation::GuenterAcuity::create({.slope = set.mar})));
    models.push_back(std::make_unique<foveation::GeislerPerryAcuity>());
    models.push_back(value_or_throw(
        foveation::StelaAcuity::create({.luminance_cd_m2 = set.luminance_cd_m2},
                                       set.nasal ? foveation::StelaField::Directional
                                                 : foveation::StelaField::TemporalEverywhere)));
    models.push_back(std::make_unique<foveation::ResolutionLimit>());
    return models;
}

/// Whether `name` is what was asked for; throws if that is neither "all" nor among the names.
class Selection {
  public:
    Selection(const char* what, std::string asked, std::vector<std::string> names)
        : asked_(std::move(asked)) {
        names.emplace_back("all");
        if (std::ranges::find(names, asked_) == names.end()) {
            throw SetupError(
                ErrorKind::Usage,
                fmt::format("--{}: {}", what, settings::unknown_name(what, asked_, names)));
        }
    }

    [[nodiscard]] bool includes(std::string_view name) const {
        return asked_ == "all" || asked_ == name;
    }

  private:
    std::string asked_;
};

TrackerWidening widening(const std::string& text, const PlanSubject& subject,
                         const drivers::FixedGaze& at) {
    if (text == kByTracker) {
        const double off_axis_deg = glm::degrees(
            std::acos(std::clamp(glm::dot(at.direction(), gaze::kStraightAhead), -1.0, 1.0)));
        return value_or_throw(tracker_widening(subject.tracker, subject.simulation,
                                               subject.settings, subject.display, off_axis_deg));
    }
    double deg = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), deg);
    if (error != std::errc{} || end != text.data() + text.size() ||
        !(deg >= 0.0 && deg <= foveation::kMaxWideningDeg)) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("--widen: '{}' must be degrees in [0, {}], or '{}'", text,
                                     foveation::kMaxWideningDeg, kByTracker));
    }
    return {.deg = deg, .terms = ""};
}

}  // namespace

void plan(const PlanRequest& request, const PlanSubject& subject) {
    const std::array<report::NamedFile, 2> outputs{
        {{"--json", request.json}, {"--png", request.chart}}};
    value_or_throw(report::check_outputs(outputs, report::files_of(subject.settings)));
    const bool show_text = request.json != "-" && !request.quiet;
    if (!request.figures.empty()) {
        const std::string claims = value_or_throw(write_layer_figures(request.figures));
        if (show_text) {
            value_or_throw(report::write_text("-", claims));
        }
        return;
    }
    const display::DisplayProfile& display = subject.display;
    const drivers::FixedGaze gaze = value_or_throw(drivers::parse_fixed_gaze(request.gaze));
    const gaze::Eye eye = request.eye;
    const gaze::EyeView view =
        display::profile_view(display, eye, display.width_px, display.height_px);
    const foveation::GazeField field = value_or_throw(foveation::GazeField::create(
        view, glm::conjugate(view.pose.orientation) * gaze.direction()));

    const TrackerWidening widened_by = widening(request.widening, subject, gaze);
    PlanQuestion question{.display = display.name,
                          .eye = eye,
                          .azimuth_deg = gaze.azimuth_deg,
                          .elevation_deg = gaze.elevation_deg,
                          .widening_deg = widened_by.deg,
                          .widening_terms = widened_by.terms,
                          .field = &field,
                          .models = {}};
    const Models models = acuity_models(subject.methods.acuity);
    std::vector<std::string> model_names;
    for (const auto& model : models) {
        model_names.emplace_back(model->name());
    }
    const Selection models_asked("model", request.model, model_names);
    std::vector<std::unique_ptr<foveation::WidenedAcuity>> widened;
    for (const auto& model : models) {
        if (models_asked.includes(model->name())) {
            widened.push_back(std::make_unique<foveation::WidenedAcuity>(*model, widened_by.deg));
            question.models.push_back(widened.back().get());
        }
    }

    std::vector<std::string> method_names;
    for (const methods::Method& method : methods::all_methods()) {
        method_names.emplace_back(method.name);
    }
    const Selection methods_asked("method", request.method, method_names);
    const methods::PlanSubject planned{.values = subject.methods,
                                       .settings = subject.settings,
                                       .field = field,
                                       .line = {.slope = subject.methods.acuity.mar}};
    const auto plan_of = [&](const auto& wanted) {
        std::vector<PlanRow> rows;
        for (const methods::Method& method : methods::all_methods()) {
            if (wanted(method.name)) {
                rows.push_back({.method = std::string(method.name),
                                .plan = value_or_throw(method.plan(planned)),
                                .verdicts = {}});
            }
        }
        return make_plan_report(question, std::move(rows));
    };
    const PlanReport report =
        plan_of([&](std::string_view name) { return methods_asked.includes(name); });
    if (show_text) {
        value_or_throw(report::write_text("-", plan_report_text(report)));
    }
    if (!request.json.empty()) {
        value_or_throw(report::write_text(request.json, plan_report_json(report)));
    }
    if (!request.chart.empty()) {
        // One method is to be seen among the others.
        const report::LineChart chart =
            request.method == "all" ? density_chart(report)
                                    : density_chart(plan_of([](std::string_view) { return true; }));
        value_or_throw(report::write_chart(chart, request.chart));
    }
}

}  // namespace gazeloop::trade
