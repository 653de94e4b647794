#pragma once

#include <array>
#include <cstdint>

#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
#include "runtime/openxr_layer/newer_openxr.h"

namespace gazeloop::openxr_layer {

/// What the layer's manifests list, from which the loader knows that an application may ask for it.
/// XrApiLayer_gazeloop.json.in says the same.
struct ProvidedExtension {
    const char* name;
    std::uint32_t version;
};
inline constexpr std::array kProvidedExtensions{
    ProvidedExtension{XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, 2},
    ProvidedExtension{XR_FB_FOVEATION_EXTENSION_NAME, 1},
    ProvidedExtension{XR_FB_FOVEATION_CONFIGURATION_EXTENSION_NAME, 1},
    ProvidedExtension{XR_FB_SWAPCHAIN_UPDATE_STATE_EXTENSION_NAME, 3},
    ProvidedExtension{newer::kFoveationEyeTrackedName, 1},
    ProvidedExtension{XR_VARJO_QUAD_VIEWS_EXTENSION_NAME, 1},
    ProvidedExtension{XR_GAZELOOP_GAZE_SAMPLE_EXTENSION_NAME, 1}};

}  // namespace gazeloop::openxr_layer
