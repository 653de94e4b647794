#include "runtime/run/picture_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/vulkan/context.h"
#include "runtime/vulkan/processor.h"

namespace gazeloop::run {
namespace {

constexpr std::string_view kDevice = "vulkan device";
constexpr std::string_view kDriver = "vulkan driver";
constexpr std::string_view kProcessor = "processor";
constexpr std::string_view kInverseSquareRoot = "processor rsqrt";

std::string value_of(const std::vector<NamedValue>& device, std::string_view name) {
    const auto found = std::ranges::find(device, name, &NamedValue::name);
    return found == device.end() ? "" : found->value;
}

std::string text_of(const std::vector<NamedValue>& device) {
    std::string text =
        fmt::format("{}, driver {}", value_of(device, kDevice), value_of(device, kDriver));
    if (const std::string processor = value_of(device, kProcessor); !processor.empty()) {
        text += ", on " + processor;
    }
    return text;
}

}  // namespace

std::vector<NamedValue> picture_device(const vulkan::Context& context) {
    std::vector<NamedValue> device{{std::string(kDevice), context.device_name()},
                                   {std::string(kDriver), context.driver()}};
    if (context.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu) {
        device.push_back({std::string(kProcessor), vulkan::processor_name()});
        device.push_back({std::string(kInverseSquareRoot),
                          fmt::format("{:016x}", vulkan::inverse_square_root_hash())});
    }
    return device;
}

std::string other_renderer(const std::vector<NamedValue>& recorded,
                           const std::vector<NamedValue>& now) {
    const auto differs = [&](std::string_view name) {
        const std::string before = value_of(recorded, name);
        const std::string after = value_of(now, name);
        return !before.empty() && !after.empty() && before != after;
    };
    constexpr std::array kDecide{kDevice, kDriver, kInverseSquareRoot};
    return std::ranges::any_of(kDecide, differs)
               ? fmt::format("recorded with {}; this is {}", text_of(recorded), text_of(now))
               : "";
}

}  // namespace gazeloop::run
