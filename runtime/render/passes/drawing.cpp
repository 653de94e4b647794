#include "runtime/render/passes/drawing.h"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {

std::vector<vulkan::ShaderConstant> with_scene(
    const scene::Scene& scene, std::initializer_list<vulkan::ShaderConstant> constants) {
    std::vector<vulkan::ShaderConstant> all(constants);
    const auto more = scene.constants();
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

bool takes_linear(vk::Format format) {
    return format == vk::Format::eR8G8B8A8Srgb || format == vk::Format::eB8G8R8A8Srgb ||
           format == vk::Format::eR16G16B16A16Sfloat;
}

void begin_rendering(const vk::raii::CommandBuffer& commands, vk::ImageView view,
                     vk::Extent2D extent, vk::AttachmentLoadOp load,
                     const std::array<float, 4>& background, vk::ImageView depth_view) {
    const vk::RenderingAttachmentInfo attachment(view, vk::ImageLayout::eColorAttachmentOptimal, {},
                                                 {}, {}, load, vk::AttachmentStoreOp::eStore,
                                                 vk::ClearColorValue(background));
    const vk::RenderingAttachmentInfo depth(
        depth_view, vk::ImageLayout::eDepthStencilAttachmentOptimal, {}, {}, {}, load,
        vk::AttachmentStoreOp::eStore, vk::ClearValue(vk::ClearDepthStencilValue(0.0F, 0)));
    const vk::Rect2D area({0, 0}, extent);
    commands.beginRendering(
        vk::RenderingInfo({}, area, 1, 0, attachment, depth_view ? &depth : nullptr));
    commands.setViewport(0, vk::Viewport(0.0F, 0.0F, static_cast<float>(extent.width),
                                         static_cast<float>(extent.height), 0.0F, 1.0F));
    commands.setScissor(0, area);
}

void draw_tiles(const vk::raii::CommandBuffer& commands, std::span<const foveation::Tile> tiles,
                std::uint32_t instance) {
    for (const foveation::Tile& tile : tiles) {
        commands.setScissor(
            0, vk::Rect2D({static_cast<std::int32_t>(tile.x0), static_cast<std::int32_t>(tile.y0)},
                          {tile.x1 - tile.x0, tile.y1 - tile.y0}));
        commands.draw(3, 1, 0, instance);
    }
}

void draw_visible(const vk::raii::CommandBuffer& commands, const foveation::HiddenArea* hidden) {
    if (hidden != nullptr) {
        draw_tiles(commands, hidden->visible_tiles(), 0);
    } else {
        commands.draw(3, 1, 0, 0);
    }
}

void draw_visible_tiles(const vk::raii::CommandBuffer& commands,
                        std::span<const foveation::Tile> tiles,
                        const foveation::HiddenArea* hidden) {
    if (hidden == nullptr) {
        draw_tiles(commands, tiles, 0);
        return;
    }
    for (const foveation::Tile& tile : tiles) {
        for (const foveation::Tile& visible : hidden->visible_tiles()) {
            const foveation::Tile both{std::max(tile.x0, visible.x0), std::max(tile.y0, visible.y0),
                                       std::min(tile.x1, visible.x1),
                                       std::min(tile.y1, visible.y1)};
            if (both.x0 < both.x1 && both.y0 < both.y1) {
                draw_tiles(commands, std::span(&both, 1), 0);
            }
        }
    }
}

void shade_cells(const vk::raii::CommandBuffer& commands, vulkan::TrackedColorImage& cells,
                 std::span<const foveation::Tile> tiles, std::uint32_t instance,
                 const std::optional<std::array<float, 4>>& unshaded, vulkan::Use read) {
    cells.tracked.use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
    if (!tiles.empty() || unshaded) {
        begin_rendering(commands, cells.image.view(), cells.image.extent(),
                        unshaded ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare,
                        unshaded.value_or(std::array<float, 4>{}));
        draw_tiles(commands, tiles, instance);
        commands.endRendering();
    }
    cells.tracked.use(commands, read);
}

vk::raii::Sampler make_sampler(const vk::raii::Device& device, vk::Filter filter) {
    constexpr auto kClamp = vk::SamplerAddressMode::eClampToEdge;
    return {device, vk::SamplerCreateInfo({}, filter, filter, vk::SamplerMipmapMode::eNearest,
                                          kClamp, kClamp, kClamp)};
}

std::string resolve_shader(std::string_view name, const PassSetup& setup) {
    return fmt::format("{}.{}", name,
                       setup.depth_format == vk::Format::eUndefined ? "frag" : "depth.frag");
}

void bind_sets(const vk::raii::CommandBuffer& commands, const vk::raii::PipelineLayout& layout,
               const FrameRecording& frame, std::size_t eye, vk::DescriptorSet method) {
    constexpr auto kGraphics = vk::PipelineBindPoint::eGraphics;
    commands.bindDescriptorSets(kGraphics, *layout, vulkan::kFrameSet, frame.frame_sets[eye], {});
    if (frame.scene_sets[eye]) {
        commands.bindDescriptorSets(kGraphics, *layout, vulkan::kSceneSet, frame.scene_sets[eye],
                                    {});
    }
    if (method) {
        commands.bindDescriptorSets(kGraphics, *layout, vulkan::kMethodSet, method, {});
    }
}

}  // namespace gazeloop::render
