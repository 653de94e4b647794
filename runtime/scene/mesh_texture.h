#pragma once

#include <span>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"
#include "runtime/vulkan/layered_image.h"

namespace gazeloop::scene {

/// A picture with all its smaller levels on the GPU, in a format that decodes its colours.
[[nodiscard]] vulkan::LayeredImage texture_of(const vulkan::Context& context,
                                              const mesh::Image& image);

/// The same of several, in their order; up to four of the processors make smaller levels.
[[nodiscard]] std::vector<vulkan::LayeredImage> textures_of(const vulkan::Context& context,
                                                            std::span<const mesh::Image> images);

}  // namespace gazeloop::scene
