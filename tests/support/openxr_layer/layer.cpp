#include "tests/support/openxr_layer/layer.h"

#include <openxr/openxr_reflection.h>

#include <vector>

#include "runtime/openxr_layer/loader_interface.h"

namespace gazeloop::tests {

Layer& layer() {
    static Layer the_layer;
    return the_layer;
}

std::optional<XrResult> result_named(std::string_view text) {
#define GAZELOOP_RESULT(name, value) \
    if (text == #name) {             \
        return name;                 \
    }
    XR_LIST_ENUM_XrResult(GAZELOOP_RESULT)
#undef GAZELOOP_RESULT
        return std::nullopt;
}

std::optional<XrResult> failure_of(std::string_view function) {
    const auto effect = layer().plan.call(function);
    if (!effect) {
        return std::nullopt;
    }
    const auto result = result_named(*effect);
    if (!result) {
        refuse_fault(function, *effect);
    }
    return result;
}

namespace {

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) {
    for (const auto& hook : {&eye_gaze_hook, &button_hook, &mask_hook, &space_hook, &frame_hook}) {
        if (const PFN_xrVoidFunction own = hook(name)) {
            *function = own;
            return XR_SUCCESS;
        }
    }
    return layer().next_proc(instance, name, function);
}

XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info,
                                               const openxr_layer::XrApiLayerCreateInfo* layer_info,
                                               XrInstance* instance) {
    XrInstanceCreateInfo passed_on = *info;
    std::vector<const char*> extensions(info->enabledExtensionNames,
                                        info->enabledExtensionNames + info->enabledExtensionCount);
    if (provides_eye_gaze()) {
        std::erase_if(extensions, [](std::string_view name) {
            return name == XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME;
        });
        passed_on.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
        passed_on.enabledExtensionNames = extensions.data();
    }
    openxr_layer::XrApiLayerCreateInfo below = *layer_info;
    below.nextInfo = layer_info->nextInfo->next;
    const XrResult result =
        layer_info->nextInfo->nextCreateApiLayerInstance(&passed_on, &below, instance);
    layer().next_proc = layer_info->nextInfo->nextGetInstanceProcAddr;
    layer().instance = *instance;
    return result;
}

}  // namespace
}  // namespace gazeloop::tests

extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrNegotiateLoaderApiLayerInterface(
    const gazeloop::openxr_layer::XrNegotiateLoaderInfo* loader, const char*,
    gazeloop::openxr_layer::XrNegotiateApiLayerRequest* request) {
    using namespace gazeloop::openxr_layer;
    if (loader == nullptr || request == nullptr ||
        loader->structType != XrLoaderStruct::LoaderInfo ||
        request->structType != XrLoaderStruct::ApiLayerRequest ||
        loader->minInterfaceVersion > kLoaderInterfaceVersion) {
        return XR_ERROR_INITIALIZATION_FAILED;
    }
    request->layerInterfaceVersion = kLoaderInterfaceVersion;
    request->layerApiVersion = XR_CURRENT_API_VERSION;
    request->getInstanceProcAddr = &gazeloop::tests::get_instance_proc_addr;
    request->createApiLayerInstance = &gazeloop::tests::create_instance;
    return XR_SUCCESS;
}
