#pragma once

#include <openxr/openxr.h>

#include <cstddef>
#include <cstdint>

/// What the OpenXR loader and an API layer or a runtime say to each other when it is loaded. Debian
/// 12's headers (1.0.20) lack openxr_loader_negotiation.h; names and values are that header's, from
/// the OpenXR loader's specification (loader interface version 1).
namespace gazeloop::openxr_layer {

enum class XrLoaderStruct : std::uint32_t {
    LoaderInfo = 1,
    ApiLayerRequest = 2,
    RuntimeRequest = 3,
    ApiLayerCreateInfo = 4,
    ApiLayerNextInfo = 5,
};

struct XrNegotiateLoaderInfo {
    XrLoaderStruct structType;
    std::uint32_t structVersion;
    std::size_t structSize;
    std::uint32_t minInterfaceVersion;
    std::uint32_t maxInterfaceVersion;
    XrVersion minApiVersion;
    XrVersion maxApiVersion;
};

struct XrApiLayerCreateInfo;
using PFN_xrCreateApiLayerInstance = XrResult(XRAPI_PTR*)(const XrInstanceCreateInfo*,
                                                          const XrApiLayerCreateInfo*, XrInstance*);

struct XrNegotiateApiLayerRequest {
    XrLoaderStruct structType;
    std::uint32_t structVersion;
    std::size_t structSize;
    std::uint32_t layerInterfaceVersion;
    XrVersion layerApiVersion;
    PFN_xrGetInstanceProcAddr getInstanceProcAddr;
    PFN_xrCreateApiLayerInstance createApiLayerInstance;
};

struct XrNegotiateRuntimeRequest {
    XrLoaderStruct structType;
    std::uint32_t structVersion;
    std::size_t structSize;
    std::uint32_t runtimeInterfaceVersion;
    XrVersion runtimeApiVersion;
    PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};

struct XrApiLayerNextInfo {
    XrLoaderStruct structType;
    std::uint32_t structVersion;
    std::size_t structSize;
    char layerName[XR_MAX_API_LAYER_NAME_SIZE];
    PFN_xrGetInstanceProcAddr nextGetInstanceProcAddr;
    PFN_xrCreateApiLayerInstance nextCreateApiLayerInstance;
    XrApiLayerNextInfo* next;
};

struct XrApiLayerCreateInfo {
    XrLoaderStruct structType;
    std::uint32_t structVersion;
    std::size_t structSize;
    void* loaderInstance;
    char settingsFileLocation[512];
    XrApiLayerNextInfo* nextInfo;
};

inline constexpr std::uint32_t kLoaderInterfaceVersion = 1;

}  // namespace gazeloop::openxr_layer
