#pragma once

#include <span>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/pipelines.h"
#include "shaders/shader_library.h"

namespace gazeloop::vulkan {

/// A shader of the library, for as long as a pipeline is made of it.
inline vk::raii::ShaderModule load_shader(const vk::raii::Device& device, std::string_view name) {
    const auto words = shaders::spirv(name);
    return {device, vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data())};
}

/// The values of specialization constants as Vulkan takes them; info() refers to this.
class Specialization {
  public:
    explicit Specialization(std::span<const ShaderConstant> constants) {
        for (const ShaderConstant& constant : constants) {
            entries_.emplace_back(
                constant.id, static_cast<std::uint32_t>(values_.size() * sizeof(std::uint32_t)),
                sizeof(std::uint32_t));
            values_.push_back(constant.value);
        }
    }
    [[nodiscard]] vk::SpecializationInfo info() const {
        return {static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                values_.size() * sizeof(std::uint32_t), values_.data()};
    }

  private:
    std::vector<std::uint32_t> values_;
    std::vector<vk::SpecializationMapEntry> entries_;
};

}  // namespace gazeloop::vulkan
