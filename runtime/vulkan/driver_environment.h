#pragma once

#include <string>

namespace gazeloop::vulkan {

/// What in the environment keeps Vulkan's loader from a driver, each variable with its value, and
/// the remedy: files that VK_DRIVER_FILES or VK_ICD_FILENAMES name and that are no drivers,
/// VK_LOADER_DRIVERS_SELECT and the like. Empty where nothing does. Ask once Vulkan has failed.
[[nodiscard]] std::string driver_environment_fault();

/// What to do where there is no driver: of the environment, if it is to blame, else to install one.
[[nodiscard]] std::string no_driver_remedy();

}  // namespace gazeloop::vulkan
