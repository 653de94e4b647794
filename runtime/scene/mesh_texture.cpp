#include "runtime/scene/mesh_texture.h"

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

}  // namespace

vulkan::LayeredImage texture_of(const vulkan::Context& context, const mesh::Image& image) {
    if (image.format == mesh::TexelFormat::Rgba16 && image.color_space == mesh::ColorSpace::Srgb) {
        return texture_of(context, mesh::as_light(image));
    }
    using Usage = vk::ImageUsageFlagBits;
    std::vector<vulkan::LevelTexels> levels{
        {0, 0, vk::Extent2D(image.width, image.height), image.texels}};
    for (mesh::MipLevel& level : mesh::smaller_levels(image)) {
        levels.push_back({static_cast<std::uint32_t>(levels.size()), 0,
                          vk::Extent2D(level.width, level.height), std::move(level.texels)});
    }
    vulkan::LayeredImage texture(context, {.extent = vk::Extent2D(image.width, image.height),
                                           .format = format_of(image),
                                           .usage = Usage::eSampled | Usage::eTransferDst,
                                           .levels = static_cast<std::uint32_t>(levels.size())});
    vulkan::upload(context, texture, levels);
    return texture;
}

}  // namespace gazeloop::scene
