#include "runtime/openxr_layer/instance_creation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
#include "runtime/openxr_layer/hook.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr const char* kEyeGaze = XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME;
constexpr const char* kTimes = XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME;
constexpr const char* kSamples = XR_GAZELOOP_GAZE_SAMPLE_EXTENSION_NAME;

using Names = std::vector<const char*>;

bool has(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// What the runtime lists; nothing where it does not answer without an instance. Layers between
/// are not asked: they have nothing to say to this, and Debian's validation layer calls it an
/// error.
std::vector<XrExtensionProperties> offered_below(const XrApiLayerNextInfo& next) {
    const XrApiLayerNextInfo* lowest = &next;
    while (lowest->next != nullptr) {
        lowest = lowest->next;
    }
    const auto enumerate = function_of<PFN_xrEnumerateInstanceExtensionProperties>(
        lowest->nextGetInstanceProcAddr, XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties");
    std::uint32_t count = 0;
    if (enumerate == nullptr || XR_FAILED(enumerate(nullptr, 0, &count, nullptr))) {
        return {};
    }
    std::vector<XrExtensionProperties> all(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, "", 0});
    if (XR_FAILED(enumerate(nullptr, count, &count, all.data()))) {
        return {};
    }
    all.resize(count);
    return all;
}

bool lists(const std::vector<XrExtensionProperties>& offered, std::string_view name) {
    return std::ranges::any_of(offered,
                               [name](const auto& one) { return one.extensionName == name; });
}

std::string executable() {
    std::error_code failure;
    const auto path = std::filesystem::read_symlink("/proc/self/exe", failure);
    return failure ? "an unknown executable" : path.string();
}

/// What the files say. A configuration that does not hold provides no gaze and records nothing.
LayerConfiguration configuration_or_none() {
    auto configuration = load_configuration();
    if (configuration) {
        return std::move(*configuration);
    }
    say(LogLevel::Warning, configuration.error().message + ": there is no gaze and no recording");
    return {};
}

/// Whether the runtime itself has eyes to look at. Not known without a headset: then it has none.
bool runtime_supports_eye_gaze(const LayeredInstance& layered) {
    XrSystemGetInfo get{};
    get.type = XR_TYPE_SYSTEM_GET_INFO;
    get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    XrSystemId system = XR_NULL_SYSTEM_ID;
    XrSystemEyeGazeInteractionPropertiesEXT eyes{};
    eyes.type = XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT;
    XrSystemProperties properties{};
    properties.type = XR_TYPE_SYSTEM_PROPERTIES;
    properties.next = &eyes;
    return XR_SUCCEEDED(layered.next.GetSystem(layered.handle, &get, &system)) &&
           XR_SUCCEEDED(layered.next.GetSystemProperties(layered.handle, system, &properties)) &&
           eyes.supportsEyeGazeInteraction == XR_TRUE;
}

/// Whether a runtime has four views of its own (not every one lists the extension for them).
bool runtime_has_quad_views(const LayeredInstance& layered) {
    XrSystemGetInfo get{};
    get.type = XR_TYPE_SYSTEM_GET_INFO;
    get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    XrSystemId system = XR_NULL_SYSTEM_ID;
    std::array<XrViewConfigurationType, 16> types{};
    std::uint32_t count = 0;
    return XR_SUCCEEDED(layered.next.GetSystem(layered.handle, &get, &system)) &&
           XR_SUCCEEDED(layered.next.EnumerateViewConfigurations(
               layered.handle, system, static_cast<std::uint32_t>(types.size()), &count,
               types.data())) &&
           std::ranges::find(types, kQuadViews) != types.end();
}

std::string runtime_name(const LayeredInstance& layered) {
    XrInstanceProperties properties{};
    properties.type = XR_TYPE_INSTANCE_PROPERTIES;
    if (XR_FAILED(layered.next.GetInstanceProperties(layered.handle, &properties))) {
        return "an unknown runtime";
    }
    const XrVersion version = properties.runtimeVersion;
    return fmt::format("{} {}.{}.{}", properties.runtimeName, XR_VERSION_MAJOR(version),
                       XR_VERSION_MINOR(version), XR_VERSION_PATCH(version));
}

XrPath path_of(const LayeredInstance& layered, const char* text) {
    XrPath path = XR_NULL_PATH;
    layered.next.StringToPath(layered.handle, text, &path);
    return path;
}

/// Whose gaze the application is offered, as `gazeloop layer status` says it.
std::string_view provider_text(EyeGazeBy by) {
    constexpr std::array<std::string_view, 3> kTexts{"not asked for", "runtime", "layer"};
    return kTexts[static_cast<std::size_t>(by)];
}

/// What an application and the runtime below agree on.
struct Extensions {
    Names wanted;     ///< by the application
    Names passed_on;  ///< of them and of the layer's own wishes, to the one below
    bool eye_gaze_passed = false;
    bool times_for_layer_alone = false;
    OwnExtensions own;
};

/// Those that the layer can give where the runtime has them not.
struct Given {
    std::string_view name;
    bool OwnExtensions::* own;
    std::string LayerSettings::* setting;
};
constexpr std::array kGiven{Given{XR_FB_FOVEATION_EXTENSION_NAME,
                                  &OwnExtensions::foveation_profiles, &LayerSettings::foveation},
                            Given{XR_FB_FOVEATION_CONFIGURATION_EXTENSION_NAME,
                                  &OwnExtensions::foveation_profiles, &LayerSettings::foveation},
                            Given{XR_FB_SWAPCHAIN_UPDATE_STATE_EXTENSION_NAME,
                                  &OwnExtensions::swapchain_state, &LayerSettings::foveation},
                            Given{newer::kFoveationEyeTrackedName, &OwnExtensions::foveation_state,
                                  &LayerSettings::foveation},
                            Given{XR_VARJO_QUAD_VIEWS_EXTENSION_NAME, &OwnExtensions::quad_views,
                                  &LayerSettings::quad_views}};

Extensions extensions_of(const XrInstanceCreateInfo& info, const XrApiLayerNextInfo& next,
                         const LayerSettings& settings) {
    Extensions extensions;
    extensions.wanted.assign(info.enabledExtensionNames,
                             info.enabledExtensionNames + info.enabledExtensionCount);
    const auto offered = offered_below(next);
    const bool is_below = lists(offered, kEyeGaze);
    for (const char* const name : extensions.wanted) {
        const std::string_view text = name;
        const auto given = std::ranges::find(kGiven, text, &Given::name);
        const bool gives =
            given != kGiven.end() && settings.*(given->setting) != "never" && !lists(offered, text);
        if (gives) {
            extensions.own.*(given->own) = true;
        }
        const bool layers_own = gives || text == kSamples ||
                                (text == kEyeGaze && (!is_below || settings.eye_gaze == "always"));
        if (!layers_own) {
            extensions.passed_on.push_back(name);
        }
    }
    extensions.eye_gaze_passed = has(extensions.passed_on, kEyeGaze);
    // Since 1.1 they need no extension, and insets are composited with Vulkan alone.
    const bool has_vulkan = has(extensions.wanted, XR_KHR_VULKAN_ENABLE_EXTENSION_NAME) ||
                            has(extensions.wanted, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
    const bool in_core = info.applicationInfo.apiVersion >= XR_MAKE_VERSION(1, 1, 0) &&
                         settings.quad_views != "never" &&
                         !has(extensions.passed_on, XR_VARJO_QUAD_VIEWS_EXTENSION_NAME);
    extensions.own.quad_views = has_vulkan && (extensions.own.quad_views || in_core);
    if (lists(offered, kTimes) && !has(extensions.passed_on, kTimes)) {
        extensions.passed_on.push_back(kTimes);
        extensions.times_for_layer_alone = true;
    }
    return extensions;
}

/// Fills in what depends on the instance that the one below has made.
void set_up(LayeredInstance& layered, const XrInstanceCreateInfo& info,
            const Extensions& extensions) {
    layered.next = next_functions(layered.next_proc, layered.handle);
    layered.times = TimeLine(layered.handle, layered.next);
    layered.application =
        std::string(info.applicationInfo.applicationName,
                    strnlen(info.applicationInfo.applicationName, XR_MAX_APPLICATION_NAME_SIZE));
    layered.runtime = runtime_name(layered);
    layered.tells_samples = has(extensions.wanted, kSamples);
    const LayerSettings& settings = layered.configuration.values.layer;
    if (has(extensions.wanted, kEyeGaze)) {
        const bool runtimes = extensions.eye_gaze_passed &&
                              (settings.eye_gaze == "never" || runtime_supports_eye_gaze(layered));
        layered.eye_gaze = runtimes ? EyeGazeBy::Runtime : EyeGazeBy::Layer;
    }
    const bool records = !settings.record.empty();
    layered.owns = extensions.own;
    layered.owns.quad_views = layered.owns.quad_views && !runtime_has_quad_views(layered);
    layered.inset_policy = {.periphery = settings.periphery,
                            .blend = settings.blend,
                            .margin_deg = layered.configuration.values.gaze.widen_error_deg,
                            .acuity = {.slope = settings.mar}};
    layered.passes_through = !layered.provides_eye_gaze() && !layered.owns.any() && !records;
    layered.sighting = {.application = layered.application,
                        .executable = executable(),
                        .pid = ::getpid(),
                        .seen_utc = utc_now(),
                        .runtime = layered.runtime,
                        .eye_gaze = std::string(provider_text(layered.eye_gaze)),
                        .source = settings.gaze,
                        .permission = "",
                        .read_gaze_utc = "",
                        .recording = ""};
    // What the eyes do is worked out for whoever is told.
    layered.configuration.values.gaze.events |= layered.tells_samples;
    if (!layered.passes_through) {
        auto feed = settings.eye_gaze == "never" && !layered.owns.any() && !records
                        ? nullptr
                        : open_feed(layered.configuration);
        if (!feed) {
            say(LogLevel::Warning, feed.error().message + ": there is no gaze");
        } else if (*feed == nullptr) {
            say(LogLevel::Info,
                "no gaze source: set layer.gaze, or use gazeloop layer enable --gaze");
        }
        layered.feed = feed ? *feed : nullptr;
        if (layered.provides_eye_gaze() || layered.owns.any()) {
            layered.permission.emplace(layered.sighting.executable, settings.unknown_applications);
        }
        layered.eyes = path_of(layered, "/user/eyes_ext");
        layered.gaze_pose = path_of(layered, "/user/eyes_ext/input/gaze_ext/pose");
        layered.profile = path_of(layered, "/interaction_profiles/ext/eye_gaze_interaction");
    }
    say(LogLevel::Info,
        fmt::format("{} ({}) on {}: eye gaze: {}; source: {}; recording: {}", layered.application,
                    layered.sighting.executable, layered.runtime, layered.sighting.eye_gaze,
                    settings.gaze.empty() ? "none" : settings.gaze,
                    records ? settings.record : "none"));
    keep(layered.sighting);
}

bool converts_times(std::string_view function) {
    return function == "xrConvertTimeToTimespecTimeKHR" ||
           function == "xrConvertTimespecTimeToTimeKHR";
}

/// Whether another copy of the layer is further down: two manifests may name it.
bool is_below(const XrApiLayerNextInfo* next) {
    for (; next != nullptr; next = next->next) {
        if (std::string_view(next->layerName) == kLayerName) {
            return true;
        }
    }
    return false;
}

XrResult make(const XrInstanceCreateInfo& info, const XrApiLayerCreateInfo& layer_info,
              XrInstance* instance) {
    const XrApiLayerNextInfo& own = *layer_info.nextInfo;
    XrApiLayerCreateInfo below = layer_info;
    below.nextInfo = own.next;
    auto layered = std::make_shared<LayeredInstance>();
    layered->next_proc = own.nextGetInstanceProcAddr;
    layered->passes_through = true;
    const bool twice = is_below(own.next);
    Extensions extensions;
    XrInstanceCreateInfo passed_on = info;
    if (!twice) {
        try {
            layered->configuration = configuration_or_none();
            extensions = extensions_of(info, own, layered->configuration.values.layer);
            passed_on.enabledExtensionCount =
                static_cast<std::uint32_t>(extensions.passed_on.size());
            passed_on.enabledExtensionNames = extensions.passed_on.data();
        } catch (const std::exception& error) {
            say(LogLevel::Warning, fmt::format("{}: the layer passes through", error.what()));
        }
    }
    const XrResult result = own.nextCreateApiLayerInstance(&passed_on, &below, instance);
    if (XR_FAILED(result)) {
        return result;
    }
    layered->handle = *instance;
    layered->hides_times = extensions.times_for_layer_alone;
    if (Instances::all().of(*instance) != nullptr) {
        return result;  // the copy below is this very library
    }
    try {
        if (!twice) {
            set_up(*layered, info, extensions);
        } else {
            layered->next = next_functions(layered->next_proc, layered->handle);
        }
    } catch (const std::exception& error) {
        layered->passes_through = true;
        say(LogLevel::Warning, fmt::format("{}: the layer passes through", error.what()));
    }
    Instances::all().add(layered);
    return result;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info,
                                               const XrApiLayerCreateInfo* layer_info,
                                               XrInstance* instance) noexcept {
    if (info == nullptr || instance == nullptr || layer_info == nullptr ||
        layer_info->structType != XrLoaderStruct::ApiLayerCreateInfo ||
        layer_info->nextInfo == nullptr ||
        layer_info->nextInfo->structType != XrLoaderStruct::ApiLayerNextInfo ||
        layer_info->nextInfo->nextCreateApiLayerInstance == nullptr ||
        layer_info->nextInfo->nextGetInstanceProcAddr == nullptr) {
        return XR_ERROR_INITIALIZATION_FAILED;
    }
    try {
        return make(*info, *layer_info, instance);
    } catch (...) {
        return XR_ERROR_OUT_OF_MEMORY;
    }
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) noexcept {
    if (name == nullptr || function == nullptr) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    *function = nullptr;
    const Instances::Pointer layered = Instances::all().of(instance);
    if (layered == nullptr) {
        return XR_ERROR_HANDLE_INVALID;
    }
    if (layered->hides_times && converts_times(name)) {
        return XR_ERROR_FUNCTION_UNSUPPORTED;
    }
    if (std::string_view(name) == "xrGetInstanceProcAddr") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(&get_instance_proc_addr);
        return XR_SUCCESS;
    }
    for (const auto& hooks : {&instance_hooks, &action_hooks, &space_hooks, &frame_hooks,
                              &foveation_hooks, &quad_view_hooks}) {
        for (const Hook& hook : hooks()) {
            // The end of the instance is heard of in any case.
            if (hook.name == name && hook.is_there(*layered) &&
                (!layered->passes_through || hook.name == "xrDestroyInstance")) {
                *function = hook.function;
                return XR_SUCCESS;
            }
        }
    }
    return layered->next_proc(instance, name, function);
}

}  // namespace gazeloop::openxr_layer
