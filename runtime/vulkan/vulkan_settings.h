#pragma once

#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::vulkan {

/// The settings vulkan.*
struct VulkanSettings {
    std::string device;
    bool validation = false;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(VulkanSettings& vulkan);

}  // namespace gazeloop::vulkan
