#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <string>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/run/interrupt.h"
#include "runtime/version.h"
#include "sim/baked_light_field.h"

namespace gazeloop::cli {
namespace {

struct SimulateLightFieldCommand {
    RunOptions options;  // of which only the settings are used
    std::string folder;
    std::uint64_t views = 25;
    std::uint64_t size_px = 1024;
    double spacing_mm = 5.0;
    double field_deg = 100.0;
    double time_s = 0.0;
};

/// A scene's name; of a file also its size and when it was written.
std::string scene_state(const std::string& scene) {
    std::error_code error;
    const auto size = std::filesystem::file_size(scene, error);
    const auto written = std::filesystem::last_write_time(scene, error);
    return error || !std::filesystem::path(scene).has_extension()
               ? scene
               : fmt::format("{}, {} bytes, written at {} ns",
                             std::filesystem::absolute(scene).string(), size,
                             written.time_since_epoch().count());
}

ExitCode simulate_light_field(const SimulateLightFieldCommand& command) {
    run::ProgramSettings settings;
    if (!command.options.settle(settings)) {
        return ExitCode::Ok;
    }
    const run::ProgramValues& values = settings.values();
    const vulkan::Context context(
        {.device = values.vulkan.device, .device_origin = settings.origin("vulkan.device")},
        nullptr);
    const sim::LightFieldBake bake{.views = static_cast<std::uint32_t>(command.views),
                                   .size_px = static_cast<std::uint32_t>(command.size_px),
                                   .spacing_m = command.spacing_mm * 1e-3,
                                   .field_deg = command.field_deg,
                                   .samples = static_cast<std::uint32_t>(values.render.spp),
                                   .scene_time_s = command.time_s,
                                   .of = {{"scene", scene_state(values.render.scene)},
                                          {"device", context.device_name()},
                                          {"driver", context.driver()},
                                          {"program", std::string(kVersion)}}};
    const run::CatchesInterrupts catches;
    const auto go_on = [] { return !run::interrupted(); };
    const auto scene = sim::make_scene(context, values.render.scene, {}, go_on);
    const auto file = value_or_throw(sim::bake_light_field(
        context, *scene, bake, command.folder, [&](std::uint32_t done, std::uint32_t total) {
            if (done % (2 * command.views) < 2) {
                spdlog::info("{} of {} views", done, total);
            }
            return go_on();
        }));
    if (!command.options.log.quiet) {
        fmt::print("{}: {} views of {}x{} px; gazeloop run --scene {} shows it\n", file.string(),
                   command.views * command.views, command.size_px, command.size_px, file.string());
    }
    return ExitCode::Ok;
}

}  // namespace

void add_simulate_light_field_command(Command simulate) {
    Command app = simulate.command("light-field",
                                   "make a light field of a scene: its views from a grid of "
                                   "cameras, and the file that --scene takes");
    const auto command = std::make_shared<SimulateLightFieldCommand>();
    app.option("folder", command->folder,
               "a folder, new or empty, or of the same command that was interrupted")
        .required()
        .type("OUT");
    app.option("--views", command->views, "cameras a side, 1 to 64").whole_number(64);
    app.option("--size", command->size_px, "pixels a side of every view").whole_number(16384);
    app.option("--spacing", command->spacing_mm, "between neighbouring cameras, mm")
        .number_between(1e-3, 1e4);
    app.option("--field", command->field_deg, "field of view of every view, deg")
        .number_between(1.0, 178.0);
    app.option("--time", command->time_s, "the scene's time, s").number_between(0.0, 1e6);
    command->options.aliases = {
        {"--scene", "render.scene", "the scene, by name or .gltf or .glb file"},
        {"--spp", "render.spp", "samples per pixel, 1 to 16"},
    };
    command->options.switches.clear();
    command->options.log.add_to(app);
    command->options.add_settings_to(app);
    app.does([=] {
        command->options.log.apply();
        return simulate_light_field(*command);
    });
}

}  // namespace gazeloop::cli
