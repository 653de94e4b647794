#pragma once

#include <array>

#include "runtime/openxr/xr_check.h"

namespace gazeloop::openxr {

/// What an OpenXR runtime must offer.
inline constexpr std::array<const char*, 2> kRequiredXrExtensions{
    XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME};

}  // namespace gazeloop::openxr
