#pragma once

#include "runtime/error.h"
#include "runtime/openxr/runtime_choice.h"
#include "runtime/openxr/xr_check.h"

namespace gazeloop::openxr {

// Why a runtime did not come up. The loader's codes have several causes each; these errors
// (NoDevice) look at manifests, layers and the environment, and name the one that holds.

/// The loader could not load the runtime (its first call failed with `result`).
[[nodiscard]] SetupError not_loaded(const RuntimeChoice& choice, XrResult result);

/// xrCreateInstance failed with `result`. `validation_layer` was asked for, if not null.
[[nodiscard]] SetupError not_started(const RuntimeChoice& choice, XrResult result,
                                     const char* validation_layer);

}  // namespace gazeloop::openxr
