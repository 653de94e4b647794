#include "runtime/vulkan/vulkan_settings.h"

namespace gazeloop::vulkan {

std::vector<settings::SettingRow> rows_of(VulkanSettings& vulkan) {
    using settings::Concerns;
    return {
        {"vulkan.device", "part of the Vulkan device's name (headless)",
         settings::Choice{.value = &vulkan.device}, Concerns::Machine},
        {"vulkan.validation", "Khronos validation layer, with synchronization", &vulkan.validation,
         Concerns::Machine},
    };
}

}  // namespace gazeloop::vulkan
