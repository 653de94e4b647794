#include "runtime/openxr/instance.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "runtime/error.h"
#include "runtime/openxr/enumerate.h"
#include "runtime/openxr/required_extensions.h"
#include "runtime/openxr/start_errors.h"

namespace gazeloop::openxr {
namespace {

constexpr const char* kCoreValidationLayer = "XR_APILAYER_LUNARG_core_validation";

/// The required ones and those of the wanted that the runtime offers.
std::vector<const char*> extensions_to_enable(const RuntimeChoice& choice,
                                              const std::vector<const char*>& wanted) {
    std::uint32_t count = 0;
    if (const XrResult listed = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
        XR_FAILED(listed)) {
        throw not_loaded(choice, listed);
    }
    const auto offered = enumerate(typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES),
                                   "xrEnumerateInstanceExtensionProperties", [](auto... a) {
                                       return xrEnumerateInstanceExtensionProperties(nullptr, a...);
                                   });
    const auto offers = [&offered](const char* name) {
        return std::ranges::any_of(offered, [name](const XrExtensionProperties& extension) {
            return std::strcmp(extension.extensionName, name) == 0;
        });
    };
    for (const char* name : kRequiredXrExtensions) {
        if (!offers(name)) {
            throw SetupError(ErrorKind::NoDevice,
                             fmt::format("the OpenXR runtime {} lacks {}: use another runtime "
                                         "(XR_RUNTIME_JSON) or --target headless",
                                         choice.manifest, name));
        }
    }
    std::vector<const char*> enabled(kRequiredXrExtensions.begin(), kRequiredXrExtensions.end());
    std::ranges::copy_if(wanted, std::back_inserter(enabled), offers);
    return enabled;
}

XrInstance create_instance(const RuntimeChoice& choice, bool validation,
                           const std::vector<const char*>& enabled) {
    auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strcpy(info.applicationInfo.applicationName, "gazeloop");
    std::strcpy(info.applicationInfo.engineName, "gazeloop");
    info.applicationInfo.applicationVersion = 1;
    info.applicationInfo.engineVersion = 1;
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
    info.enabledExtensionNames = enabled.data();
    if (validation) {
        info.enabledApiLayerCount = 1;
        info.enabledApiLayerNames = &kCoreValidationLayer;
    }
    XrInstance instance = XR_NULL_HANDLE;
    const XrResult created = xrCreateInstance(&info, &instance);
    // Whatever a runtime calls it, before there is an instance nothing can have been lost.
    if (XR_FAILED(created)) {
        throw not_started(choice, created, validation ? kCoreValidationLayer : nullptr);
    }
    return instance;
}

/// What xrGetSystem's failure means, and the remedy.
std::string no_system(std::string_view runtime, XrResult result) {
    switch (result) {
        case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
            return fmt::format(
                "{} has no head-mounted display now; connect one, or use --target "
                "headless",
                runtime);
        case XR_ERROR_FORM_FACTOR_UNSUPPORTED:
            return fmt::format(
                "{} is for no head-mounted displays; use another runtime "
                "(XR_RUNTIME_JSON), or --target headless",
                runtime);
        default:
            return fmt::format(
                "{} does not say whether it has a head-mounted display (xrGetSystem; "
                "its log may say why); use another runtime (XR_RUNTIME_JSON), or "
                "--target headless",
                runtime);
    }
}

}  // namespace

Instance::Instance(const RuntimeChoice& choice, const InstanceOptions& options)
    : enabled_(extensions_to_enable(choice, options.wanted)) {
    instance_ = create_instance(choice, options.validation, enabled_);
    auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
    xr_check(xrGetInstanceProperties(instance_, &properties), "xrGetInstanceProperties");
    runtime_name_ = fmt::format(
        "{} {}.{}.{}", properties.runtimeName, XR_VERSION_MAJOR(properties.runtimeVersion),
        XR_VERSION_MINOR(properties.runtimeVersion), XR_VERSION_PATCH(properties.runtimeVersion));
    auto system = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    system.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    const XrResult found = xrGetSystem(instance_, &system, &system_);
    xr_check(found, XR_SUCCEEDED(found) ? "" : no_system(runtime_name_, found));
    auto system_properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    xr_check(xrGetSystemProperties(instance_, system_, &system_properties),
             "xrGetSystemProperties");
    system_name_ = system_properties.systemName;
}

Instance::~Instance() {
    if (instance_ != XR_NULL_HANDLE) {
        xrDestroyInstance(instance_);
    }
}

bool Instance::has(std::string_view extension) const {
    return std::ranges::any_of(enabled_,
                               [extension](const char* enabled) { return extension == enabled; });
}

XrPath path_of(XrInstance instance, const char* text) {
    XrPath path = XR_NULL_PATH;
    xr_check(xrStringToPath(instance, text, &path), "xrStringToPath");
    return path;
}

}  // namespace gazeloop::openxr
