#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gazeloop::vulkan {

/// Why a loader (Vulkan's or OpenXR's) cannot load what a manifest names: "does not exist", "is no
/// JSON", ...; a clause that follows the file's name. None where nothing is wrong with it. Loads
/// the library to know, so ask only once the loader has failed. `section` of the manifest names the
/// library: "ICD", "runtime".
[[nodiscard]] std::optional<std::string> manifest_fault(const std::filesystem::path& manifest,
                                                        std::string_view section);

}  // namespace gazeloop::vulkan
