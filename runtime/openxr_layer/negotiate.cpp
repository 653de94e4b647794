// The one function that the layer's library exports.
#include "runtime/openxr_layer/instance_creation.h"

extern "C" __attribute__((visibility("default"))) XRAPI_ATTR XrResult XRAPI_CALL
xrNegotiateLoaderApiLayerInterface(const gazeloop::openxr_layer::XrNegotiateLoaderInfo* loader,
                                   const char*,
                                   gazeloop::openxr_layer::XrNegotiateApiLayerRequest* request) {
    using namespace gazeloop::openxr_layer;
    if (loader == nullptr || request == nullptr ||
        loader->structType != XrLoaderStruct::LoaderInfo || loader->structSize < sizeof *loader ||
        request->structType != XrLoaderStruct::ApiLayerRequest ||
        request->structSize < sizeof *request ||
        loader->minInterfaceVersion > kLoaderInterfaceVersion ||
        loader->maxInterfaceVersion < kLoaderInterfaceVersion) {
        return XR_ERROR_INITIALIZATION_FAILED;
    }
    request->layerInterfaceVersion = kLoaderInterfaceVersion;
    request->layerApiVersion = XR_CURRENT_API_VERSION;
    request->getInstanceProcAddr = &get_instance_proc_addr;
    request->createApiLayerInstance = &create_instance;
    return XR_SUCCESS;
}
