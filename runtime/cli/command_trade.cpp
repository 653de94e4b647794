#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/cli/quality_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/methods/registry.h"
#include "runtime/present/scaled_extent.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/recordings/compared_gaze.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/interrupt.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/trade/sweep_report.h"

namespace gazeloop::cli {
namespace {

struct TradeCommand {
    RunOptions options;
    QualityOptions quality;
    std::string methods = "kfr,acuity";
    std::string sigmas;
    std::string alphas;
    std::string slopes;
    std::vector<std::string> varied;
    std::uint64_t frames = 4;
    std::uint64_t rounds = 3;
    std::uint64_t reference_samples = 16;
    std::string csv;
};

std::vector<std::string> chosen_methods(const std::string& text) {
    const std::vector<std::string> known = methods::rendered_methods();
    std::vector<std::string> chosen = value_or_throw(trade::parse_varied("methods=" + text)).values;
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
std::vector<trade::Varied> chosen_variation(const TradeCommand& command,
                                            const std::vector<std::string>& chosen) {
    std::vector<trade::Varied> varied;
    for (const auto& [key, values] :
         {std::pair{"kfr.sigma", &command.sigmas}, std::pair{"kfr.alpha", &command.alphas},
          std::pair{"acuity.mar", &command.slopes}}) {
        if (!values->empty()) {
            varied.push_back(
                value_or_throw(trade::parse_varied(fmt::format("{}={}", key, *values))));
        }
    }
    // What is not asked for at all: the papers' range.
    const auto swept = [&](const char* method) {
        return std::ranges::find(chosen, method) != chosen.end();
    };
    if (varied.empty() && command.varied.empty()) {
        if (swept("kfr")) {
            varied.push_back({.key = "kfr.sigma", .values = {"1.2", "1.8", "2.4", "3.2"}});
            varied.push_back({.key = "kfr.alpha", .values = {"1", "4"}});
        }
        if (swept("acuity")) {
            varied.push_back({.key = "acuity.mar", .values = {"0.011", "0.022", "0.034"}});
        }
    }
    for (const std::string& text : command.varied) {
        varied.push_back(value_or_throw(trade::parse_varied(text)));
    }
    return varied;
}

trade::SweepQuestion question_of(const TradeCommand& command, const run::ProgramSettings& settings,
                                 const display::DisplayProfile& display) {
    const run::ProgramValues& values = settings.values();
    const gaze::Eye eye = command.quality.which_eye();
    const vk::Extent2D extent = present::scaled_extent(
        {display.width_px, display.height_px}, values.render.scale,
        {foveation::GazeField::kMaxSidePx, foveation::GazeField::kMaxSidePx});
    trade::SweepQuestion question{
        .views = {},
        .scene = values.render.scene,
        .samples = static_cast<std::uint32_t>(values.render.spp),
        .reference_samples = static_cast<std::uint32_t>(command.reference_samples),
        .frame_seconds = 1.0 / display.refresh_hz,
        .rounds = static_cast<unsigned>(command.rounds)};
    for (const gaze::Eye one : gaze::kEyes) {
        question.views[gaze::index(one)] =
            display::profile_view(display, one, extent.width, extent.height);
    }
    const recordings::ComparedGaze gaze =
        value_or_throw(recordings::ComparedGaze::parse(command.quality.gaze, eye));
    for (std::uint64_t frame = 0; frame < command.frames; ++frame) {
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
        .metrics = command.quality.metric_choice(),
        .contrast = command.quality.contrast(),
        .line = {.slope = values.methods.acuity.mar},
        .frame_seconds = command.frames > 1 ? std::optional(question.frame_seconds) : std::nullopt};
    return question;
}

ExitCode trade_of(const TradeCommand& command) {
    run::ProgramSettings settings;
    value_or_throw(command.options.apply_to(settings, true));
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    const std::string& json = command.options.json;
    for (const std::string& file : {json, command.csv}) {
        if (!file.empty()) {
            value_or_throw(report::check_output(file));
        }
    }
    const std::array<report::NamedFile, 2> outputs{{{"--csv", command.csv}, {"--json", json}}};
    value_or_throw(report::check_apart(outputs, {}));
    const std::vector<std::string> methods = chosen_methods(command.methods);
    const std::vector<trade::SweepPoint> points =
        value_or_throw(trade::sweep_points(methods, chosen_variation(command, methods)));
    const display::DisplayProfile display =
        value_or_throw(profiles::display_in_force(settings.values().profile, settings));
    const trade::SweepQuestion question = question_of(command, settings, display);
    const vulkan::Context context({.validation = settings.values().vulkan.validation,
                                   .device = settings.values().vulkan.device,
                                   .device_origin = settings.origin("vulkan.device")},
                                  nullptr);
    const std::vector<trade::SweepRow> rows = value_or_throw(
        trade::sweep(context, question, points, settings.values().methods, settings,
                     {.progress = [](const std::string& said) { spdlog::info("{}", said); },
                      .interrupted = run::interrupted}));
    const trade::SweepSubject subject{
        .display = display.name, .gaze = command.quality.gaze, .device = context.device_name()};
    if (json != "-" && command.csv != "-" && !command.options.log.quiet) {
        fmt::print("{}", trade::sweep_text(subject, question, rows));
    }
    if (!command.csv.empty()) {
        value_or_throw(report::write_text(command.csv, trade::sweep_csv(rows)));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(
            json, report::json_text(trade::sweep_json(subject, question, rows))));
    }
    bool failed = false;
    for (const trade::SweepRow& row : rows) {
        if (!row.error.empty()) {
            spdlog::error("{} {}: {}", row.point.method, row.point.settings_text(), row.error);
            failed = true;
        }
    }
    return failed ? ExitCode::GateFailed : ExitCode::Ok;
}

}  // namespace

void add_trade_command(Command program) {
    Command app = program.command(
        "trade", "time and samples against quality: methods and their settings, side by side");
    const auto command = std::make_shared<TradeCommand>();
    RunOptions& options = command->options;
    options.aliases = {
        {"--display", "profile.display", "display profile, by name or .toml file", ""},
        {"--scene", "render.scene", "scene to render: raymarch, gallery, or a .gltf or .glb file",
         ""},
        {"--spp", "render.spp", "samples per texel or pixel, 1 to 16", ""},
    };
    options.switches.clear();
    options.log.add_to(app);
    options.add_settings_to(app);
    app.option("--methods", command->methods, "which, with commas between (kfr,acuity)")
        .type("LIST");
    app.option("--sigma", command->sigmas, "values of kfr.sigma, with commas between").type("LIST");
    app.option("--alpha", command->alphas, "values of kfr.alpha").type("LIST");
    app.option("--mar", command->slopes, "values of acuity.mar").type("LIST");
    app.option("--vary", command->varied,
               "values of any setting of a method; may be repeated: all combinations are rendered")
        .type("KEY=V1,V2,...");
    app.option("--frames", command->frames, "frames at the display's rate (4); 1: a still")
        .number_between(1, 100'000);
    app.option("--rounds", command->rounds,
               "how often each frame is timed, all points in turns (3)")
        .number_between(1, 1000);
    app.option("--reference-spp", command->reference_samples,
               "samples per pixel of the reference, 1 to 16 (16)")
        .number_between(1, 16);
    command->quality.add_to(app);
    app.option("--csv", command->csv, "write a line per point").type("FILE").not_empty();
    app.option("--json", options.json, "write the result as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.does([=] {
        command->options.log.apply();
        return trade_of(*command);
    });
}

}  // namespace gazeloop::cli
