#pragma once

#include <string>

#include "runtime/display/display_profile.h"

namespace gazeloop::openxr {

/// Which OpenXR runtime the loader will take, and why.
struct RuntimeChoice {
    std::string manifest;  ///< path of its JSON file
    std::string
        reason;  ///< "XR_RUNTIME_JSON", "active runtime of the system", "built by ./dev setup"
};

/// Decides on the runtime before the first OpenXR call. The user's choice (XR_RUNTIME_JSON), then
/// the system's (active_runtime.json, or Debian's Monado package), then the Monado that `./dev
/// setup` built into the cache folder. For that Monado the environment is set so that it simulates
/// the display (size, refresh, fields of view, eyes' distance) and composites into nothing. Throws
/// SetupError (NoDevice), naming the remedy, when there is none or the file is missing.
RuntimeChoice choose_runtime(const display::DisplayProfile& display);

}  // namespace gazeloop::openxr
