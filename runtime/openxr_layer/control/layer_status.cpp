#include "runtime/openxr_layer/control/layer_status.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>

#include "runtime/environment.h"
#include "runtime/openxr_layer/control/layer_files.h"
#include "runtime/openxr_layer/layer_configuration.h"
#include "runtime/openxr_layer/sightings.h"
#include "runtime/openxr_layer/user_folders.h"

namespace gazeloop::openxr_layer {
namespace {

struct Status {
    std::optional<std::string> library;
    std::string manifest;  ///< the user's, if it is there
    bool switched_on = false;
    bool switched_off = false;
    Expected<LayerConfiguration> configuration = load_configuration();
    std::vector<Sighting> seen = sightings();
};

Status status() {
    Status status;
    if (const auto library = layer_library()) {
        status.library = library->string();
    }
    std::error_code failure;
    if (const auto manifest = user_manifest();
        manifest && std::filesystem::exists(*manifest, failure)) {
        status.manifest = manifest->string();
    }
    status.switched_on = environment_value("GAZELOOP_LAYER").has_value();
    status.switched_off = environment_value("GAZELOOP_LAYER_DISABLE").has_value();
    return status;
}

std::string state_text(const Status& status) {
    if (status.switched_off) {
        return "off here: GAZELOOP_LAYER_DISABLE is set";
    }
    if (!status.manifest.empty()) {
        return fmt::format("on for this user ({})", status.manifest);
    }
    return status.switched_on
               ? "on here where it is installed: GAZELOOP_LAYER is set"
               : "off: gazeloop layer enable switches it on for this user, GAZELOOP_LAYER=1 for "
                 "one program where it is installed";
}

std::string or_none(const std::string& text) { return text.empty() ? "none" : text; }

}  // namespace

nlohmann::ordered_json layer_status_json() {
    const Status now = status();
    nlohmann::ordered_json json;
    json["library"] = now.library ? nlohmann::ordered_json(*now.library) : nullptr;
    json["enabled_for_user"] = !now.manifest.empty();
    json["disabled_here"] = now.switched_off;
    json["error"] = nullptr;
    if (now.configuration) {
        const LayerSettings& layer = now.configuration->values.layer;
        json["gaze"] = layer.gaze;
        json["eye_gaze"] = layer.eye_gaze;
        json["record"] = layer.record;
        json["unknown_applications"] = layer.unknown_applications;
    } else {
        json["error"] = now.configuration.error().message;
    }
    json["applications"] = nlohmann::ordered_json::array();
    for (const Sighting& seen : now.seen) {
        json["applications"].push_back({{"application", seen.application},
                                        {"executable", seen.executable},
                                        {"seen", seen.seen_utc},
                                        {"runtime", seen.runtime},
                                        {"eye_gaze", seen.eye_gaze},
                                        {"source", seen.source},
                                        {"permission", seen.permission},
                                        {"read_gaze", seen.read_gaze_utc},
                                        {"recording", seen.recording}});
    }
    return json;
}

std::string layer_status_text() {
    const Status now = status();
    std::string text = fmt::format("OpenXR API layer\n  library    {}\n  state      {}\n",
                                   now.library.value_or("not built"), state_text(now));
    auto out = std::back_inserter(text);
    if (now.configuration) {
        const LayerSettings& layer = now.configuration->values.layer;
        fmt::format_to(out, "  gaze       {}, provided {}\n", or_none(layer.gaze), layer.eye_gaze);
        fmt::format_to(out, "  recording  {}\n", or_none(layer.record));
        fmt::format_to(out, "  unknown    {} (applications that were not decided on)\n",
                       layer.unknown_applications);
    } else {
        fmt::format_to(out, "  PROBLEM    {}\n", now.configuration.error().message);
    }
    if (const auto state = layer_state()) {
        fmt::format_to(out, "  log        {}\n", (*state / "layer.log").string());
    }
    fmt::format_to(out, "applications{}\n", now.seen.empty() ? ": none was seen yet" : "");
    for (const Sighting& seen : now.seen) {
        fmt::format_to(out, "  {}  {} ({})\n    on {}; eye gaze: {}", seen.seen_utc,
                       seen.application, seen.executable, seen.runtime, seen.eye_gaze);
        if (seen.eye_gaze == "layer") {
            fmt::format_to(
                out, ", {}; source: {}; {}",
                seen.permission.empty() ? "never asked" : seen.permission, or_none(seen.source),
                seen.read_gaze_utc.empty() ? "never read" : "first read " + seen.read_gaze_utc);
        }
        fmt::format_to(out, "\n");
        if (!seen.recording.empty()) {
            fmt::format_to(out, "    recorded {}\n", seen.recording);
        }
    }
    return text;
}

}  // namespace gazeloop::openxr_layer
