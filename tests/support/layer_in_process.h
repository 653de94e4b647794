#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/openxr/xr_check.h"
#include "runtime/openxr_layer/instance_creation.h"

namespace gazeloop::tests {

/// What an application asks xrCreateInstance for.
struct AskedInstance {
    const char* application = "";
    XrVersion version = XR_MAKE_VERSION(1, 0, 0);
    std::vector<const char*> extensions;
};

/// An instance through the layer in this process, as the loader makes one: `create` makes the
/// instance below the layer, whose functions `below` gives.
inline XrResult create_through_layer(
    const AskedInstance& asked, PFN_xrGetInstanceProcAddr below,
    openxr_layer::PFN_xrCreateApiLayerInstance create, XrInstance& instance,
    openxr_layer::PFN_xrCreateApiLayerInstance layers_create = &openxr_layer::create_instance) {
    openxr_layer::XrApiLayerNextInfo next{};
    next.structType = openxr_layer::XrLoaderStruct::ApiLayerNextInfo;
    next.nextGetInstanceProcAddr = below;
    next.nextCreateApiLayerInstance = create;
    openxr_layer::XrApiLayerCreateInfo layer{};
    layer.structType = openxr_layer::XrLoaderStruct::ApiLayerCreateInfo;
    layer.nextInfo = &next;
    auto info = openxr::typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strcpy(info.applicationInfo.applicationName, asked.application);
    info.applicationInfo.apiVersion = asked.version;
    info.enabledExtensionCount = static_cast<std::uint32_t>(asked.extensions.size());
    info.enabledExtensionNames = asked.extensions.data();
    return layers_create(&info, &layer, &instance);
}

/// The layer above an instance that is there already, which it gets as if it were new. `below` must
/// not end that instance.
inline void put_layer_above(XrInstance made, const AskedInstance& asked,
                            PFN_xrGetInstanceProcAddr below) {
    static XrInstance handed_over = XR_NULL_HANDLE;
    handed_over = made;
    const openxr_layer::PFN_xrCreateApiLayerInstance hand_over =
        [](const XrInstanceCreateInfo*, const openxr_layer::XrApiLayerCreateInfo*,
           XrInstance* instance) {
            *instance = handed_over;
            return XR_SUCCESS;
        };
    XrInstance instance = XR_NULL_HANDLE;
    openxr::xr_check(create_through_layer(asked, below, hand_over, instance),
                     "the layer's instance");
}

}  // namespace gazeloop::tests
