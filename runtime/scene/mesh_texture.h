#pragma once

#include "runtime/scene/mesh/mesh_data.h"
#include "runtime/vulkan/layered_image.h"

namespace gazeloop::scene {

/// A picture with all its smaller levels on the GPU, in a format that decodes its colours.
[[nodiscard]] vulkan::LayeredImage texture_of(const vulkan::Context& context,
                                              const mesh::Image& image);

}  // namespace gazeloop::scene
