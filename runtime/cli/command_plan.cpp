#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/fixed/fixed_source.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/foveation/eye/fovea_widening.h"
#include "runtime/foveation/eye/geisler_perry_acuity.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/stela_acuity.h"
#include "runtime/gaze/direction.h"
#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/report/output_file.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/trade/layer_figures.h"
#include "runtime/trade/plan_report.h"
#include "runtime/trade/tracker_widening.h"

namespace gazeloop::cli {
namespace {

struct PlanCommand {
    RunOptions options;
    std::string method = "all";
    std::string model = "all";
    std::string gaze = "0,0";
    std::string eye = "left";
    std::string widening = "0";
    std::string chart;
    std::string figures;
};

using Models = std::vector<std::unique_ptr<foveation::AcuityModel>>;

Models acuity_models(const methods::AcuitySettings& set) {
    Models models;
    models.push_back(value_or_throw(foveation::GuenterAcuity::create({.slope = set.mar})));
    models.push_back(std::make_unique<foveation::GeislerPerryAcuity>());
    models.push_back(value_or_throw(
        foveation::StelaAcuity::create({.luminance_cd_m2 = set.luminance_cd_m2},
                                       set.nasal ? foveation::StelaField::Directional
                                                 : foveation::StelaField::TemporalEverywhere)));
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

constexpr const char* kByTracker = "tracker";

trade::TrackerWidening widening(const std::string& text, const run::ProgramSettings& settings,
                                const display::DisplayProfile& display,
                                const drivers::FixedGaze& at) {
    if (text == kByTracker) {
        const double off_axis_deg = glm::degrees(
            std::acos(std::clamp(glm::dot(at.direction(), gaze::kStraightAhead), -1.0, 1.0)));
        return value_or_throw(trade::tracker_widening(settings.values().profile.tracker,
                                                      settings.values().sim, settings, display,
                                                      off_axis_deg));
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

ExitCode plan(const PlanCommand& command) {
    run::ProgramSettings settings;
    value_or_throw(command.options.apply_to(settings, true));
    if (command.widening == kByTracker) {
        value_or_throw(profiles::simulate_tracker_in_force(settings.values().profile, settings));
    }
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    if (!command.options.json.empty()) {
        value_or_throw(report::check_output(command.options.json));
    }
    const bool show_text = command.options.json != "-" && !command.options.log.quiet;
    if (!command.figures.empty()) {
        const std::string claims = value_or_throw(trade::write_layer_figures(command.figures));
        if (show_text) {
            fmt::print("{}", claims);
        }
        return ExitCode::Ok;
    }
    const run::ProgramValues& values = settings.values();
    const display::DisplayProfile display =
        value_or_throw(profiles::display_in_force(settings.values().profile, settings));
    const drivers::FixedGaze gaze = value_or_throw(drivers::parse_fixed_gaze(command.gaze));
    const gaze::Eye eye = command.eye == "left" ? gaze::Eye::Left : gaze::Eye::Right;
    const gaze::EyeView view =
        display::profile_view(display, eye, display.width_px, display.height_px);
    const foveation::GazeField field = value_or_throw(foveation::GazeField::create(
        view, glm::conjugate(view.pose.orientation) * gaze.direction()));

    const trade::TrackerWidening widened_by = widening(command.widening, settings, display, gaze);
    trade::PlanQuestion question{.display = display.name,
                                 .eye = eye,
                                 .azimuth_deg = gaze.azimuth_deg,
                                 .elevation_deg = gaze.elevation_deg,
                                 .widening_deg = widened_by.deg,
                                 .widening_terms = widened_by.terms,
                                 .field = &field,
                                 .models = {}};
    const Models models = acuity_models(values.methods.acuity);
    std::vector<std::string> model_names;
    for (const auto& model : models) {
        model_names.emplace_back(model->name());
    }
    const Selection models_asked("model", command.model, model_names);
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
    const Selection methods_asked("method", command.method, method_names);
    const methods::PlanSubject subject{.values = values.methods,
                                       .settings = settings,
                                       .field = field,
                                       .line = {.slope = values.methods.acuity.mar}};
    const auto plan_of = [&](const auto& wanted) {
        std::vector<trade::PlanRow> rows;
        for (const methods::Method& method : methods::all_methods()) {
            if (wanted(method.name)) {
                rows.push_back({.method = std::string(method.name),
                                .plan = value_or_throw(method.plan(subject)),
                                .verdicts = {}});
            }
        }
        return trade::make_plan_report(question, std::move(rows));
    };
    const trade::PlanReport report =
        plan_of([&](std::string_view name) { return methods_asked.includes(name); });
    if (show_text) {
        fmt::print("{}", trade::plan_report_text(report));
    }
    if (!command.options.json.empty()) {
        value_or_throw(report::write_text(command.options.json, trade::plan_report_json(report)));
    }
    if (!command.chart.empty()) {
        // One method is to be seen among the others.
        const report::LineChart chart =
            command.method == "all"
                ? trade::density_chart(report)
                : trade::density_chart(plan_of([](std::string_view) { return true; }));
        value_or_throw(report::write_chart(chart, command.chart));
    }
    return ExitCode::Ok;
}

}  // namespace

void add_plan_command(Command program) {
    Command app = program.command("plan", "what methods sample, and what eyes need, on a display");
    const auto command = std::make_shared<PlanCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file", ""},
        {"--tracker", "profile.tracker", "tracker profile, by name or .toml file", ""},
        {"--sigma", "kfr.sigma", "picture width over LP-buffer width, .5 to 32", ""},
        {"--alpha", "kfr.alpha", "kernel K(x) = x^alpha, .25 to 16", ""},
        {"--mar", "acuity.mar", "slope of the acuity line, e.g. .022", ""},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("--method", command->method,
               "full, kfr, acuity, layers, rings, sparse, quad, fixed or all");
    app.option("--model", command->model, "guenter, geisler-perry, stelacsf or all");
    app.option("--gaze", command->gaze, "direction of gaze, degrees to the right and up")
        .type("AZ,EL");
    app.option("--eye", command->eye, "left or right").one_of({"left", "right"});
    app.option("--widen", command->widening,
               "by how much the gaze may be off, degrees, or as much as the tracker's figures "
               "(sim.*) say: what eyes then need")
        .type("DEG|tracker");
    app.option("--json", options.json, "write the plan as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.option("--png", command->chart,
               "draw densities over eccentricity, all methods; .png or .svg")
        .type("FILE");
    app.option("--figures", command->figures,
               "instead: what layers save by field of view, as CSV and charts")
        .type("DIR");
    app.does([=] {
        command->options.log.apply();
        return plan(*command);
    });
}

}  // namespace gazeloop::cli
