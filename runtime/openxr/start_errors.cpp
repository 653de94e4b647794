#include "runtime/openxr/start_errors.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/environment.h"
#include "runtime/vulkan/driver_environment.h"
#include "runtime/vulkan/loader_manifest.h"

namespace gazeloop::openxr {
namespace {

constexpr std::string_view kOtherRuntime =
    "./dev setup builds an in-process Monado; --target headless needs no runtime";

bool is_there(std::string_view layer) {
    std::uint32_t count = 0;
    std::vector<XrApiLayerProperties> layers;
    if (XR_SUCCEEDED(xrEnumerateApiLayerProperties(0, &count, nullptr))) {
        layers.assign(count, typed<XrApiLayerProperties>(XR_TYPE_API_LAYER_PROPERTIES));
        if (XR_FAILED(xrEnumerateApiLayerProperties(count, &count, layers.data()))) {
            layers.clear();
        }
    }
    return std::ranges::any_of(
        layers, [layer](const XrApiLayerProperties& one) { return layer == one.layerName; });
}

/// Where the loader looked for layers, if not in the usual folders; begins with a blank.
std::string looked_in() {
    const auto path = environment_value("XR_API_LAYER_PATH");
    if (!path) {
        return " in the usual folders";
    }
    std::string text = fmt::format(
        " in XR_API_LAYER_PATH='{}', which stands for all the usual "
        "folders",
        *path);
    for (const std::string& folder : split_list(*path)) {
        if (std::error_code ignored; !std::filesystem::is_directory(folder, ignored)) {
            text += fmt::format(" ('{}' is no folder)", folder);
        }
    }
    return text;
}

/// The layers that were asked for and are not there, each with who asked; empty if none.
std::vector<std::string> absent_layers(const char* validation_layer) {
    std::vector<std::string> absent;
    if (const auto named = environment_value("XR_ENABLE_API_LAYERS")) {
        for (const std::string& layer : split_list(*named)) {
            if (!is_there(layer)) {
                absent.push_back(fmt::format(
                    "XR_ENABLE_API_LAYERS='{}' names the layer {}, which no manifest{} has: "
                    "correct or unset XR_ENABLE_API_LAYERS, or name the layer's folder in "
                    "XR_API_LAYER_PATH",
                    *named, layer, looked_in()));
            }
        }
    }
    if (validation_layer != nullptr && !is_there(validation_layer)) {
        absent.push_back(fmt::format(
            "target.validation is on, but no manifest{} has its layer {}: {}install it (Debian: "
            "openxr-layer-corevalidation)",
            looked_in(), validation_layer,
            environment_value("XR_API_LAYER_PATH") ? "unset XR_API_LAYER_PATH, or " : ""));
    }
    return absent;
}

}  // namespace

SetupError not_loaded(const RuntimeChoice& choice, XrResult result) {
    const bool named = choice.reason == "XR_RUNTIME_JSON";
    const std::string runtime =
        named ? fmt::format("the runtime that XR_RUNTIME_JSON='{}' names", choice.manifest)
              : fmt::format("the runtime '{}' ({})", choice.manifest, choice.reason);
    const auto fault = vulkan::manifest_fault(choice.manifest, "runtime");
    return {ErrorKind::NoDevice,
            fmt::format("OpenXR: {} could not be loaded ({}){}: {}; {}", runtime, xr_name(result),
                        fault ? ": that file " + *fault : "",
                        named ? "correct or unset XR_RUNTIME_JSON"
                              : "install it again, or name another one in XR_RUNTIME_JSON",
                        kOtherRuntime)};
}

SetupError not_started(const RuntimeChoice& choice, XrResult result, const char* validation_layer) {
    if (result == XR_ERROR_API_LAYER_NOT_PRESENT) {
        if (const auto absent = absent_layers(validation_layer); !absent.empty()) {
            return {ErrorKind::NoDevice, fmt::format("OpenXR: {}", fmt::join(absent, "; "))};
        }
    }
    const std::string driver_fault = vulkan::driver_environment_fault();
    const auto layers = environment_value("XR_ENABLE_API_LAYERS");
    return {
        ErrorKind::NoDevice,
        fmt::format("OpenXR: the runtime {} did not start ({}): {}{}; {}", choice.manifest,
                    xr_name(result),
                    driver_fault.empty() ? "is its service running, and does Vulkan have a driver "
                                           "(vulkaninfo)?"
                                         : driver_fault,
                    layers ? fmt::format(" XR_ENABLE_API_LAYERS='{}' puts layers before it, "
                                         "which may fail, too: try without",
                                         *layers)
                           : "",
                    kOtherRuntime)};
}

}  // namespace gazeloop::openxr
