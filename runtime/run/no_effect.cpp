#include "runtime/run/no_effect.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "runtime/render/antialiasing.h"
#include "runtime/render/post_filter.h"
#include "runtime/scene/scenes.h"

namespace gazeloop::run {
namespace {

std::string_view source_of(const FrameRunRequest& request) {
    return std::string_view(request.gaze).substr(0, request.gaze.find(':'));
}

std::string_view scene_of(const FrameRunRequest& request) {
    return request.settings->values().render.scene;
}

bool is_openxr(const FrameRunRequest& request) {
    return request.settings->values().target.name == "openxr";
}

/// What stands in a setting's way, as a message has it.
std::string gaze_in_force(const FrameRunRequest& request) {
    return request.gaze.empty() ? std::string("a recording's gaze") : "--gaze " + request.gaze;
}
std::string scene_in_force(const FrameRunRequest& request) {
    return request.settings->with_origin("render.scene");
}
std::string target_in_force(const FrameRunRequest& request) {
    return request.settings->with_origin("target.name");
}
std::string clock_in_force(const FrameRunRequest& request) {
    return request.clock == RunClock::Wall ? "--clock wall" : "the recording's own time line";
}
std::string watching_in_force(const FrameRunRequest& request) {
    return request.monitor ? "--monitor alone" : "nobody watching the run";
}
std::string this_command(const FrameRunRequest& /*request*/) { return "this command"; }

/// When settings have an effect, beside what their rows say of other settings.
struct Rule {
    std::string_view keys;  ///< what they begin with: a group with its point, or one key
    bool (*has_effect)(const FrameRunRequest&);
    std::string (*in_force)(const FrameRunRequest&);
    std::string_view with;  ///< what they have an effect with
};

using Request = const FrameRunRequest&;

constexpr std::array kRules{
    Rule{"hid.", [](Request run) { return source_of(run) == "hid"; }, gaze_in_force, "--gaze hid"},
    Rule{"steam_frame.", [](Request run) { return source_of(run) == "steam-frame"; }, gaze_in_force,
         "--gaze steam-frame"},
    Rule{"trace.", [](Request run) { return run.reads_trace; }, gaze_in_force, "--gaze trace:FILE"},
    Rule{"sim.", [](Request run) { return source_of(run) == "sim"; }, gaze_in_force, "--gaze sim"},
    Rule{"profile.tracker",
         [](Request run) { return source_of(run) != "fixed" || run.settings->values().gaze.widen; },
         gaze_in_force, "gaze of a tracker, or gaze.widen = true"},
    Rule{"gaze.fixation_from_depth", [](Request run) { return run.openxr_gaze.has_value(); },
         gaze_in_force, "--gaze openxr"},
    Rule{"lightfield.",
         [](Request run) { return run.many_pictures || scene::is_light_field(scene_of(run)); },
         scene_in_force, "a light field: lightfield, or a .lightfield file"},
    Rule{"render.specular_filter",
         [](Request run) { return run.many_pictures || scene::is_of_meshes(scene_of(run)); },
         scene_in_force, "a scene of meshes: gallery, or a .gltf or .glb file"},
    Rule{"render.footprint",
         [](Request run) { return run.many_pictures || !scene::is_light_field(scene_of(run)); },
         scene_in_force, "any scene that is no light field"},
    Rule{"openxr.", is_openxr, target_in_force, "--target openxr"},
    Rule{"target.validation", is_openxr, target_in_force, "--target openxr"},
    Rule{"render.depth", is_openxr, target_in_force, "--target openxr"},
    Rule{"virtual_time.", [](Request run) { return run.clock == RunClock::Virtual; },
         clock_in_force, "--clock virtual"},
    Rule{"monitor.interval_s", [](Request run) { return run.monitor_json.has_value(); },
         watching_in_force, "--monitor-json"},
    Rule{"monitor.window_s",
         [](Request run) {
             return run.monitor || run.monitor_json ||
                    run.settings->values().profile.budget != "none";
         },
         watching_in_force, "--monitor, --monitor-json or --budget"},
    Rule{"layer.", [](Request) { return false; }, this_command, "gazeloop layer"},
};

bool is_of(const Rule& rule, std::string_view key) {
    return rule.keys.ends_with('.') ? key.starts_with(rule.keys) : key == rule.keys;
}

}  // namespace

std::vector<std::string> without_effect(const FrameRunRequest& request) {
    const ProgramSettings& settings = *request.settings;
    const auto asked = [&](const std::string& key) {
        return settings.origin(key).starts_with("--");
    };
    std::vector<std::string> lines;
    for (const settings::SettingRow& row : settings.rows()) {
        if (!asked(row.key)) {
            continue;
        }
        const settings::OnlyWhile& only = row.only_while;
        if (!settings.is_in_use(row) && !(request.many_pictures && only.key == "render.method")) {
            lines.push_back(fmt::format(
                "{} has no effect with {}: it has with {}", settings.with_origin(row.key),
                settings.with_origin(only.key), fmt::join(only.values, " or ")));
        }
        for (const Rule& rule : kRules) {
            if (is_of(rule, row.key) && !rule.has_effect(request)) {
                lines.push_back(fmt::format("{} has no effect with {}: it has with {}",
                                            settings.with_origin(row.key), rule.in_force(request),
                                            rule.with));
            }
        }
    }
    const auto wanted = static_cast<std::uint32_t>(settings.values().render.post_filter_px);
    const std::uint32_t taken = render::largest_post_filter(wanted);
    if (asked("render.post_filter") && wanted > 0 && taken != wanted) {
        lines.push_back(fmt::format(
            "{}: such filters have 3, 5, 7, ... px: {}", settings.with_origin("render.post_filter"),
            taken < 3 ? std::string("this is none") : fmt::format("taken as {}", taken)));
    }
    return lines;
}

}  // namespace gazeloop::run
