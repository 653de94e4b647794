#include "runtime/scene/mesh_texture.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <future>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/scene/mesh/mip_chain.h"

namespace gazeloop::scene {
namespace {

vk::Format format_of(const mesh::Image& image) {
    if (image.format == mesh::TexelFormat::Rgba16) {
        return vk::Format::eR16G16B16A16Unorm;
    }
    return image.color_space == mesh::ColorSpace::Srgb ? vk::Format::eR8G8B8A8Srgb
                                                       : vk::Format::eR8G8B8A8Unorm;
}

/// All of a texture that is made without the GPU.
struct Texels {
    vk::Format format = vk::Format::eUndefined;
    std::vector<vulkan::LevelTexels> levels;
};

Texels texels_of(const mesh::Image& image) {
    if (image.format == mesh::TexelFormat::Rgba16 && image.color_space == mesh::ColorSpace::Srgb) {
        return texels_of(mesh::as_light(image));
    }
    Texels texels{format_of(image),
                  {{0, 0, vk::Extent2D(image.width, image.height),
                    std::vector(image.texels.begin(), image.texels.end())}}};
    for (mesh::MipLevel& level : mesh::smaller_levels(image)) {
        texels.levels.push_back({static_cast<std::uint32_t>(texels.levels.size()), 0,
                                 vk::Extent2D(level.width, level.height), std::move(level.texels)});
    }
    return texels;
}

vulkan::LayeredImage uploaded(const vulkan::Context& context, const Texels& texels) {
    using Usage = vk::ImageUsageFlagBits;
    vulkan::LayeredImage texture(context,
                                 {.extent = texels.levels.front().extent,
                                  .format = texels.format,
                                  .usage = Usage::eSampled | Usage::eTransferDst,
                                  .levels = static_cast<std::uint32_t>(texels.levels.size())});
    vulkan::upload(context, texture, texels.levels);
    return texture;
}

}  // namespace

vulkan::LayeredImage texture_of(const vulkan::Context& context, const mesh::Image& image) {
    return uploaded(context, texels_of(image));
}

std::vector<vulkan::LayeredImage> textures_of(const vulkan::Context& context,
                                              std::span<const mesh::Image> images) {
    // Each holds up to 2.3 times its texels until it is uploaded: four of 4096 by 4096, 600 MiB.
    const std::size_t at_once = std::clamp(std::thread::hardware_concurrency(), 1U, 4U);
    std::vector<vulkan::LayeredImage> textures;
    textures.reserve(images.size());
    std::deque<std::future<Texels>> coming;
    for (std::size_t next = 0; textures.size() < images.size();) {
        for (; next < images.size() && coming.size() < at_once; ++next) {
            coming.push_back(std::async(std::launch::async,
                                        [&image = images[next]] { return texels_of(image); }));
        }
        textures.push_back(uploaded(context, coming.front().get()));
        coming.pop_front();
    }
    return textures;
}

}  // namespace gazeloop::scene
