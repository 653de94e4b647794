#include "runtime/trade/trade_off.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/methods/registry.h"
#include "runtime/present/scaled_extent.h"
#include "runtime/recordings/compared_gaze.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/trade/sweep_report.h"

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
    for (const Varied& one : varied) {
        for (const settings::SettingRow& row : settings.rows()) {
            if (row.key != one.key) {
                continue;
            }
            const std::string text = settings::text_of(row);
            const std::string origin = settings.origin(one.key);
            for (const std::string& value : one.values) {
                value_or_throw(settings.set(one.key, value, "trade"));
            }
            value_or_throw(settings.set(one.key, text, origin));
        }
    }
}

SweepQuestion question_of(const TradeRequest& request, const TradeScene& scene) {
    const display::DisplayProfile& display = scene.display;
    const gaze::Eye eye = request.eye;
    const vk::Extent2D extent = present::scaled_extent(
        {display.width_px, display.height_px}, scene.render.scale,
        {foveation::GazeField::kMaxSidePx, foveation::GazeField::kMaxSidePx});
    SweepQuestion question{
        .views = {},
        .scene = scene.render.scene,
        .samples = static_cast<std::uint32_t>(scene.render.spp),
        .reference_samples = static_cast<std::uint32_t>(request.reference_samples),
        .frame_seconds = 1.0 / display.refresh_hz,
        .rounds = static_cast<unsigned>(request.rounds)};
    for (const gaze::Eye one : gaze::kEyes) {
        question.views[gaze::index(one)] =
            display::profile_view(display, one, extent.width, extent.height);
    }
    const recordings::ComparedGaze gaze =
        value_or_throw(recordings::ComparedGaze::parse(request.gaze, eye));
    for (std::uint64_t frame = 0; frame < request.frames; ++frame) {
        const glm::dvec3 in_head = gaze.direction_at(
            std::llround(static_cast<double>(frame) * question.frame_seconds * 1e9));
        gaze::PerEye<glm::dvec3> directions;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            directions[e] = glm::conjugate(question.views[e].pose.orientation) * in_head;
        }
        question.gaze.push_back(directions);
    }
    question.comparison = {
        .view = question.views[gaze::index(eye)],
        .eye = eye,
        .metrics = request.metrics,
        .contrast = request.contrast,
        .line = {.slope = scene.methods.acuity.mar},
        .frame_seconds = request.frames > 1 ? std::optional(question.frame_seconds) : std::nullopt};
    return question;
}

}  // namespace

bool trade_off(const TradeRequest& request, const TradeScene& scene, settings::Settings& settings,
               const SweepHooks& hooks) {
    const std::string& json = request.json;
    for (const std::string& file : {json, request.csv}) {
        if (!file.empty()) {
            value_or_throw(report::check_output(file));
        }
    }
    const std::array<report::NamedFile, 2> outputs{{{"--csv", request.csv}, {"--json", json}}};
    value_or_throw(report::check_apart(outputs, {}));
    const std::vector<std::string> methods = chosen_methods(request.methods);
    const std::vector<Varied> varied = chosen_variation(request, methods);
    const std::vector<SweepPoint> points = value_or_throw(sweep_points(methods, varied));
    check_values(varied, settings);
    const SweepQuestion question = question_of(request, scene);
    const vulkan::Context context({.validation = scene.vulkan.validation,
                                   .device = scene.vulkan.device,
                                   .device_origin = settings.origin("vulkan.device")},
                                  nullptr);
    const std::vector<SweepRow> rows =
        value_or_throw(sweep(context, question, points, scene.methods, settings, hooks));
    const SweepSubject subject{
        .display = scene.display.name, .gaze = request.gaze, .device = context.device_name()};
    if (json != "-" && request.csv != "-" && !request.quiet) {
        fmt::print("{}", sweep_text(subject, question, rows));
    }
    if (!request.csv.empty()) {
        value_or_throw(report::write_text(request.csv, sweep_csv(rows)));
    }
    if (!json.empty()) {
        value_or_throw(
            report::write_text(json, report::json_text(sweep_json(subject, question, rows))));
    }
    bool failed = false;
    for (const SweepRow& row : rows) {
        if (!row.error.empty()) {
            spdlog::error("{} {}: {}", row.point.method, row.point.settings_text(), row.error);
            failed = true;
        }
    }
    return !failed;
}

}  // namespace gazeloop::trade
