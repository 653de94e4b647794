#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "runtime/render/passes/method_passes.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// Descriptor set 2 of a method, one for each frame in flight and eye: what a frame owns until the
/// GPU has finished it. Binding 0 is a uniform buffer, binding 1 EyePlan::table (a storage buffer).
/// Then come the method's own storage buffers, then its images.
class EyeSets {
  public:
    struct Shape {
        std::size_t uniform_bytes = sizeof(foveation::EyePlan::uniforms);
        std::uint32_t buffers = 0;
        std::uint32_t images = 0;
    };
    /// Images are read through `sampler`, which must outlive this.
    EyeSets(const PassSetup& setup, const Shape& shape, vk::Sampler sampler);

    [[nodiscard]] vk::DescriptorSetLayout layout() const { return *layout_; }
    [[nodiscard]] vk::DescriptorSet of(std::size_t slot, std::size_t eye) const {
        return *slots_[slot][eye].set;
    }

    /// States an eye's table size, the greatest that a plan can have, its buffers and images, for
    /// all slots. Precondition: no frame is unfinished on the GPU; as many as were announced.
    void attach(std::size_t eye, std::size_t table_words, std::span<const vk::Buffer> buffers,
                std::span<const vk::ImageView> images);
    /// Another image for one slot. Precondition: its frame is not submitted.
    void attach_image(std::size_t slot, std::size_t eye, std::uint32_t image, vk::ImageView view);

    /// What the shaders are told of a plan.
    void write(std::size_t slot, std::size_t eye, const foveation::EyePlan& plan) {
        write(slot, eye, plan.uniforms, plan.table);
    }
    template <typename Uniforms>
    void write(std::size_t slot, std::size_t eye, const Uniforms& uniforms,
               std::span<const std::uint32_t> table) {
        EyeSlot& at = slots_[slot][eye];
        at.uniforms.write(uniforms);
        at.table.write(table);
    }

  private:
    struct EyeSlot {
        vulkan::HostBuffer uniforms;
        vulkan::HostBuffer table;
        vk::raii::DescriptorSet set{nullptr};
    };
    void write_buffer(const EyeSlot& at, std::uint32_t binding, vk::DescriptorType type,
                      vk::Buffer buffer) const;

    const vulkan::Context* context_;
    std::uint32_t first_image_;
    vk::Sampler sampler_;
    vk::raii::DescriptorSetLayout layout_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<gaze::PerEye<EyeSlot>> slots_;
};

}  // namespace gazeloop::render
