#include "runtime/vulkan/vulkan_settings.h"

namespace gazeloop::vulkan {

std::vector<settings::SettingRow> rows_of(VulkanSettings& vulkan) {
    using settings::Concerns;
    return {
        {"vulkan.device", "part of the name of the Vulkan device to use (headless)",
         settings::Choice{.value = &vulkan.device}, Concerns::Machine},
        {"vulkan.validation", "load the Khronos validation layer, with synchronization checks",
         &vulkan.validation, Concerns::Machine},
    };
}

}  // namespace gazeloop::vulkan
