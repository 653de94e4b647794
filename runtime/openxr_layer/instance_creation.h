#pragma once

#include "runtime/openxr_layer/loader_interface.h"

namespace gazeloop::openxr_layer {

inline constexpr const char* kLayerName = "XR_APILAYER_GAZELOOP_gaze";

/// Makes the layer's part of an instance. Whatever goes wrong in it, the application gets the
/// instance that it would have without the layer, less what only the layer could give.
XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info,
                                               const XrApiLayerCreateInfo* layer_info,
                                               XrInstance* instance) noexcept;

/// The layer's function of a name, or that of whoever is below it.
XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) noexcept;

}  // namespace gazeloop::openxr_layer
