#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/openxr_layer/permissions.h"

namespace gazeloop::openxr_layer {

/// The layer's library that belongs to this program: of its build, or installed with it.
/// Errors (BadInput): where it was looked for.
Expected<std::filesystem::path> layer_library();

/// The manifest that switches the layer on in every OpenXR program of the user. Errors (BadInput):
/// there is no home.
Expected<std::filesystem::path> user_manifest();

/// Writes the user's manifest and, where there are any, these settings (KEY=VALUE) into layer.toml,
/// in place of what is there. Errors: Usage for a setting that is none of the layer's; BadInput for
/// a file that cannot be written.
Expected<void> enable(const std::vector<std::string>& assignments);

/// Removes the user's manifest; settings and decisions stay. Whether it was there.
Expected<bool> disable();

/// Whether an application may have gaze. Gives whether that changes anything. Errors (BadInput):
/// there is no such executable, unless decisions on it are forgotten; as Permissions::read(), or
/// the file cannot be written.
Expected<bool> decide(const std::string& executable, Permissions::Answer answer);

}  // namespace gazeloop::openxr_layer
