#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "runtime/foveation/log_polar/map_uniforms.h"
#include "runtime/render/frame_uniforms.h"
#include "runtime/render/map_buffers.h"

namespace gazeloop::numerics {

/// What a map is asked: a position of the picture, px, and an LP texel.
struct ProbeInput {
    glm::vec2 position_px{0.0F};
    glm::vec2 cell{0.0F};  ///< column, row; whole numbers
};

/// What it answered.
struct ProbeOutput {
    glm::vec2 share{0.0F};  ///< of the position
    glm::vec3 place{0.0F};  ///< the texel's centre: px (z = 0), or in the gaze frame a view ray
    glm::vec3 ray{0.0F};    ///< of the position, in world; the device's answer alone
};

/// The view, and the part of the map that depends on the gaze.
struct ProbeUniforms {
    render::FrameUniforms frame;
    foveation::MapUniforms map;
};

/// Runs the maps as the shaders have them (shaders/lib) on the device.
class MapProbe {
  public:
    explicit MapProbe(const vulkan::Context& context);

    /// Waits for the answers. `uniforms` decide the gaze, `in_gaze_frame` which of the two maps.
    [[nodiscard]] std::vector<ProbeOutput> run(const render::MapBuffers& tables,
                                               const ProbeUniforms& uniforms, bool in_gaze_frame,
                                               std::span<const ProbeInput> inputs) const;

  private:
    const vulkan::Context* context_;
    vk::raii::DescriptorSetLayout frame_layout_{nullptr};
    vk::raii::DescriptorSetLayout empty_layout_{nullptr};
    vk::raii::DescriptorSetLayout map_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    std::array<vk::raii::Pipeline, 2> pipelines_{nullptr, nullptr};  ///< by in_gaze_frame
};

}  // namespace gazeloop::numerics
