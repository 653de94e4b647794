// An OpenXR runtime that is the one named in GAZELOOP_REAL_RUNTIME (its library), but does not
// offer XR_EXT_eye_gaze_interaction.
#include <dlfcn.h>
#include <openxr/openxr.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "runtime/openxr_layer/loader_interface.h"

namespace gazeloop::tests {
namespace {

PFN_xrGetInstanceProcAddr g_real_proc = nullptr;

XRAPI_ATTR XrResult XRAPI_CALL enumerate_extensions(const char* of_layer, std::uint32_t capacity,
                                                    std::uint32_t* count,
                                                    XrExtensionProperties* properties) {
    PFN_xrVoidFunction function = nullptr;
    g_real_proc(XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties", &function);
    const auto real = reinterpret_cast<PFN_xrEnumerateInstanceExtensionProperties>(function);
    std::uint32_t offered = 0;
    if (const XrResult result = real(of_layer, 0, &offered, nullptr); XR_FAILED(result)) {
        return result;
    }
    std::vector<XrExtensionProperties> all(offered, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, "", 0});
    if (const XrResult result = real(of_layer, offered, &offered, all.data()); XR_FAILED(result)) {
        return result;
    }
    std::erase_if(all, [](const XrExtensionProperties& extension) {
        return std::string_view(extension.extensionName) ==
               XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME;
    });
    *count = static_cast<std::uint32_t>(all.size());
    if (capacity == 0) {
        return XR_SUCCESS;
    }
    if (capacity < all.size()) {
        return XR_ERROR_SIZE_INSUFFICIENT;
    }
    std::ranges::copy(all, properties);
    return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) {
    if (std::string_view(name) == "xrEnumerateInstanceExtensionProperties") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(&enumerate_extensions);
        return XR_SUCCESS;
    }
    return g_real_proc(instance, name, function);
}

}  // namespace
}  // namespace gazeloop::tests

extern "C" XRAPI_ATTR XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const gazeloop::openxr_layer::XrNegotiateLoaderInfo* loader,
                                  gazeloop::openxr_layer::XrNegotiateRuntimeRequest* request) {
    const char* const library = std::getenv("GAZELOOP_REAL_RUNTIME");
    void* const real = library != nullptr ? dlopen(library, RTLD_NOW) : nullptr;
    if (real == nullptr) {
        return XR_ERROR_INITIALIZATION_FAILED;
    }
    using Negotiate = XrResult(XRAPI_PTR*)(const gazeloop::openxr_layer::XrNegotiateLoaderInfo*,
                                           gazeloop::openxr_layer::XrNegotiateRuntimeRequest*);
    const auto negotiate =
        reinterpret_cast<Negotiate>(dlsym(real, "xrNegotiateLoaderRuntimeInterface"));
    const XrResult result = negotiate(loader, request);
    gazeloop::tests::g_real_proc = request->getInstanceProcAddr;
    request->getInstanceProcAddr = &gazeloop::tests::get_instance_proc_addr;
    return result;
}
