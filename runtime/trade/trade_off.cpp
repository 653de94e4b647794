#include "runtime/trade/trade_off.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <optional>
#include <utility>

#include "runtime/methods/registry.h"
#include "runtime/present/scaled_extent.h"
#include "runtime/quality/figure_keys.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/trade/fitted_shape.h"
#include "runtime/trade/measured_sweep.h"
#include "runtime/trade/processor_energy.h"
#include "runtime/trade/published_grid.h"
#include "runtime/trade/settings_of_point.h"
#include "runtime/trade/worth_points.h"

namespace gazeloop::trade {
namespace {

std::vector<std::string> chosen_methods(const std::string& text) {
    const std::vector<std::string> known = methods::rendered_methods();
    std::vector<std::string> chosen = value_or_throw(parse_varied("methods=" + text)).values;
    for (const std::string& name : chosen) {
        if (std::ranges::find(known, name) == known.end()) {
            throw SetupError(
                ErrorKind::Usage,
                fmt::format("--methods: {}", settings::unknown_name("method", name, known)));
        }
    }
    return chosen;
}

/// --vary, and the options that are short for it; of these, those whose method is swept.
std::vector<Varied> chosen_variation(const TradeRequest& request,
                                     const std::vector<std::string>& chosen) {
    std::vector<Varied> varied;
    for (const auto& [key, values] :
         {std::pair{"kfr.sigma", &request.sigmas}, std::pair{"kfr.alpha", &request.alphas},
          std::pair{"acuity.mar", &request.slopes}}) {
        if (!values->empty()) {
            varied.push_back(value_or_throw(parse_varied(fmt::format("{}={}", key, *values))));
        }
    }
    // What is not asked for at all: the papers' range.
    const auto swept = [&](const char* method) {
        return std::ranges::find(chosen, method) != chosen.end();
    };
    if (varied.empty() && request.varied.empty()) {
        if (swept("kfr")) {
            varied.push_back({.key = "kfr.sigma", .values = {"1.2", "1.8", "2.4", "3.2"}});
            varied.push_back({.key = "kfr.alpha", .values = {"1", "4"}});
        }
        if (swept("acuity")) {
            varied.push_back({.key = "acuity.mar", .values = {"0.011", "0.022", "0.034"}});
        }
    }
    for (const std::string& text : request.varied) {
        varied.push_back(value_or_throw(parse_varied(text)));
    }
    return varied;
}

/// Refuses values that their settings cannot have before anything is rendered.
void check_values(const std::vector<Varied>& varied, settings::Settings& settings) {
    const auto rows = settings.rows();
    for (const Varied& one : varied) {
        const auto row = std::ranges::find(rows, one.key, &settings::SettingRow::key);
        if (row == rows.end()) {
            value_or_throw(settings.set(one.key, one.values.front(), "--vary"));  // says why
            continue;
        }
        const std::string text = settings::text_of(*row);
        const std::string origin = settings.origin(one.key);
        for (const std::string& value : one.values) {
            value_or_throw(settings.set(one.key, value, "trade"));
        }
        value_or_throw(settings.set(one.key, text, origin));
    }
}

/// Every scene along every gaze.
std::vector<CaseQuestion> cases_of(const TradeRequest& request, const std::string& scene,
                                   const SweepQuestion& question) {
    std::vector<std::string> scenes{scene};
    if (!request.scenes.empty()) {
        scenes = value_or_throw(parse_varied("scenes=" + request.scenes)).values;
    }
    std::vector<CaseQuestion> cases;
    for (const std::string& name : scenes) {
        for (const LookedAt& gaze : request.gazes) {
            CaseQuestion& of_case = cases.emplace_back();
            of_case.scene = name;
            of_case.gaze = gaze.text;
            for (std::uint64_t frame = 0; frame < request.frames; ++frame) {
                const glm::dvec3 in_head = gaze.direction_at(
                    std::llround(static_cast<double>(frame) * question.frame_seconds * 1e9));
                gaze::PerEye<glm::dvec3>& directions = of_case.directions.emplace_back();
                for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                    directions[e] = glm::conjugate(question.views[e].pose.orientation) * in_head;
                }
            }
        }
    }
    return cases;
}

SweepQuestion question_of(const TradeRequest& request, const TradeScene& scene) {
    const display::DisplayProfile& display = scene.display;
    const gaze::Eye eye = request.eye;
    const vk::Extent2D extent = present::scaled_extent(
        {display.width_px, display.height_px}, scene.render.scale,
        {foveation::GazeField::kMaxSidePx, foveation::GazeField::kMaxSidePx});
    SweepQuestion question{
        .views = {},
        .display = display.name,
        .samples = static_cast<std::uint32_t>(scene.render.spp),
        .reference_samples = static_cast<std::uint32_t>(request.reference_samples),
        .frame_seconds = 1.0 / display.refresh_hz,
        .rounds = static_cast<unsigned>(request.rounds),
        .shard = value_or_throw(parse_shard(request.shard)),
        .with_pictures = !request.outputs.html.empty()};
    for (const gaze::Eye one : gaze::kEyes) {
        question.views[gaze::index(one)] =
            display::profile_view(display, one, extent.width, extent.height);
    }
    question.comparison = {
        .view = question.views[gaze::index(eye)],
        .eye = eye,
        .metrics = request.metrics,
        .contrast = request.contrast,
        .line = {.slope = scene.methods.acuity.mar},
        .frame_seconds = request.frames > 1 ? std::optional(question.frame_seconds) : std::nullopt};
    question.cases = cases_of(request, scene.render.scene, question);
    return question;
}

/// Refuses names of scenes that there are not before anything is measured.
void check_scenes(const SweepQuestion& question, settings::Settings& settings) {
    for (const CaseQuestion& of_case : question.cases) {
        SettingsOfPoint checked(settings);
        value_or_throw(checked.set({.method = "", .settings = {{"render.scene", of_case.scene}}}));
    }
}

/// Why a method cannot render pictures of these sizes by a point's settings.
Expected<void> check_point(const SweepPoint& point, const SweepQuestion& question,
                           const methods::MethodSettings& values, settings::Settings& settings) {
    const methods::Method& method = *methods::find_method(point.method);
    SettingsOfPoint of_point(settings);
    if (auto set = of_point.set(point); !set) {
        return set;
    }
    if (const auto passes = method.passes(values, settings); !passes) {
        return std::unexpected(passes.error());
    }
    for (const gaze::EyeView& view : question.views) {
        if (method.check_picture != nullptr) {
            if (auto checked =
                    method.check_picture(values, settings, {view.width_px, view.height_px});
                !checked) {
                return checked;
            }
        }
    }
    return {};
}

/// Nobody asked for each change by itself: one that cannot be is said, and not measured.
void leave_out_impossible(std::vector<SweepPoint>& points, const SweepQuestion& question,
                          const methods::MethodSettings& values, settings::Settings& settings,
                          const SweepHooks& hooks) {
    std::erase_if(points, [&](const SweepPoint& point) {
        if (point.settings.empty()) {
            return false;
        }
        const auto possible = check_point(point, question, values, settings);
        if (!possible) {
            hooks.progress(
                fmt::format("{} is left out: {}", point.settings_text(), possible.error().message));
        }
        return !possible;
    });
}

/// The shape in force and the fitted one, which is written first: whoever stops what follows has
/// it.
std::vector<SweepPoint> fitted_points(const vulkan::Context& context, const TradeRequest& request,
                                      const SweepQuestion& question, const SweptValues& values,
                                      settings::Settings& settings, const SweepHooks& hooks) {
    const FitQuestion fit{.method = request.methods, .fewer = request.fewer};
    for (const char* const key : {"kfr.sigma", "interleaved.every"}) {
        if (!settings.is_built_in(key)) {
            hooks.progress(fmt::format("{} has no effect with --fitted, which finds its own",
                                       settings.with_origin(key)));
        }
    }
    const FittedShape fitted =
        value_or_throw(fitted_shape(context, question, values, settings, hooks, fit));
    value_or_throw(report::write_text(request.outputs.fitted,
                                      fitted_toml(fitted, fit, question, request.command_line)));
    hooks.progress(fmt::format("{}: {} shapes tried; {:.4g} lost in place of {:.4g}",
                               request.outputs.fitted, fitted.tried, fitted.loss_after,
                               fitted.loss_before));
    std::vector<SweepPoint> points{fitted.before};
    if (fitted.after != fitted.before) {
        points.push_back(fitted.after);
    }
    return points;
}

SweepRecord record_of(const TradeRequest& request, const TradeScene& scene,
                      settings::Settings& settings, SweepHooks hooks) {
    if (!request.merge.empty()) {
        return value_or_throw(merged_sweep(request.merge, hooks.progress));
    }
    const SweptValues values{
        .methods = scene.methods, .render = scene.render, .light_field = scene.light_field};
    const SweepQuestion question = question_of(request, scene);
    check_scenes(question, settings);
    const vulkan::ContextOptions device{.validation = scene.vulkan.validation,
                                        .device = scene.vulkan.device,
                                        .device_origin = settings.origin("vulkan.device")};
    std::optional<vulkan::Context> context;
    std::vector<SweepPoint> points;
    if (!request.worth.empty()) {
        points = value_or_throw(worth_points(request.worth, settings));
        leave_out_impossible(points, question, scene.methods, settings, hooks);
    } else if (!request.outputs.fitted.empty()) {
        context.emplace(device, nullptr);
        points = fitted_points(*context, request, question, values, settings, hooks);
    } else {
        const std::vector<std::string> methods = chosen_methods(request.methods);
        const std::vector<Varied> varied = chosen_variation(request, methods);
        points = value_or_throw(sweep_points(methods, varied));
        check_values(varied, settings);
    }
    if (request.published) {
        std::ranges::copy_if(published_grid(), std::back_inserter(points),
                             [&](const SweepPoint& point) {
                                 return std::ranges::find(points, point) == points.end();
                             });
    }
    if (!context) {
        context.emplace(device, nullptr);
    }
    ProcessorEnergy energy;
    if (energy.unavailable().empty()) {
        hooks.joules = [&energy] { return energy.joules(); };
    } else {
        hooks.progress("energy per frame is unavailable: " + energy.unavailable());
    }
    return value_or_throw(measured_sweep(*context, question, points, values, settings,
                                         request.journal, std::move(hooks)));
}

}  // namespace

bool trade_off(const TradeRequest& request, const TradeScene& scene, settings::Settings& settings,
               const SweepHooks& hooks) {
    std::vector<report::NamedFile> inputs = report::files_of(settings);
    // A governor's front is what a sweep makes, and may make anew.
    std::erase_if(inputs,
                  [](const report::NamedFile& file) { return file.name == "governor.front"; });
    inputs.emplace_back("--resume", request.journal);
    for (const std::string& file : request.merge) {
        inputs.emplace_back("--merge", file);
    }
    value_or_throw(check_outputs(request.outputs, inputs));
    ChoiceQuestion question{.budget_ms = request.budget_ms};
    for (const std::string& text : request.limits) {
        question.floors.push_back(value_or_throw(parse_floor(text)));
        if (request.merge.empty()) {  // else the journals say by what was judged
            value_or_throw(quality::check_figure(question.floors.back().key, request.metrics));
        }
    }
    SweepReport report = report_of(record_of(request, scene, settings, hooks));
    report.question = std::move(question);
    report.with_fits = request.fit;
    report.command_line = request.command_line;
    value_or_throw(write_outputs(report, request.outputs));
    for (const std::string& warning : warnings(report)) {
        spdlog::warn("{}", warning);
    }
    const std::vector<std::string> failed = failures(report);
    for (const std::string& failure : failed) {
        spdlog::error("{}", failure);
    }
    return failed.empty();
}

}  // namespace gazeloop::trade
