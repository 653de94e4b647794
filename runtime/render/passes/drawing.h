#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/foveation/picture/hidden_area.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/render/passes/method_passes.h"
#include "runtime/vulkan/tracked_color_image.h"

namespace gazeloop::render {

/// constant_id of the shaders' specialization constants (shaders/lib, shaders/resolve).
enum ShaderConstantId : std::uint32_t {
    kEncodeSrgb = 0,
    kSamples = 1,
    kInGazeFrame = 2,
    kWithDisc = 3,
    kOfMethod = 4,  ///< and beyond: what one method alone knows
    kJittered = 10
};

/// The constants of a pass that asks the scene, and the scene's own.
[[nodiscard]] std::vector<vulkan::ShaderConstant> with_scene(
    const scene::Scene& scene, std::initializer_list<vulkan::ShaderConstant> constants);

/// Whether a format takes linear light: it encodes sRGB by itself, or it holds floats. Else the
/// pass that writes it encodes.
[[nodiscard]] bool takes_linear(vk::Format format);

/// Begins rendering into a colour image and, unless its view is null, a depth image; viewport and
/// scissor are the whole. Cleared depth is infinitely far.
void begin_rendering(const vk::raii::CommandBuffer& commands, vk::ImageView view,
                     vk::Extent2D extent, vk::AttachmentLoadOp load,
                     const std::array<float, 4>& background = {}, vk::ImageView depth_view = {});

/// One large triangle for each tile, which the scissor cuts.
void draw_tiles(const vk::raii::CommandBuffer& commands, std::span<const foveation::Tile> tiles,
                std::uint32_t instance);

/// The whole picture, or what of it is visible.
void draw_visible(const vk::raii::CommandBuffer& commands, const foveation::HiddenArea* hidden);

/// Of the tiles, what of them is visible.
void draw_visible_tiles(const vk::raii::CommandBuffer& commands,
                        std::span<const foveation::Tile> tiles,
                        const foveation::HiddenArea* hidden);

/// Shades the cells of a grid into an image and makes that readable. Pipeline and sets are bound.
/// Tiles may be none: nothing of it is read then, but its layout must be right. `unshaded`: what
/// the image then holds everywhere else. `read`: how shaders read it.
void shade_cells(const vk::raii::CommandBuffer& commands, vulkan::TrackedColorImage& cells,
                 std::span<const foveation::Tile> tiles, std::uint32_t instance,
                 const std::optional<std::array<float, 4>>& unshaded,
                 vulkan::Use read = vulkan::Use::Sampled);

/// A sampler that clamps to the edge.
[[nodiscard]] vk::raii::Sampler make_sampler(const vk::raii::Device& device, vk::Filter filter);

/// The fragment shader of a resolve, as the targets ask for it: with depth it is a variant, because
/// the mere statement of a depth costs a third of a resolve.
[[nodiscard]] std::string resolve_shader(std::string_view name, const PassSetup& setup);

/// Draws both eyes' pictures without the parts that no eye sees. `draw_eye(e)` draws one, into the
/// target that is bound.
template <typename DrawEye>  // no std::function: no allocation per frame
void draw_pictures(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                   const PassSetup& setup, const DrawEye& draw_eye) {
    const bool depth = setup.depth_format != vk::Format::eUndefined;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const EyeTarget& target = frame.view.targets[e];
        frame.color[e].use(commands, vulkan::Use::ColorTarget, vulkan::Keep::Nothing);
        if (depth) {
            frame.depth[e].use(commands, vulkan::Use::DepthTarget, vulkan::Keep::Nothing);
        }
        const bool hidden = frame.view.hidden[e] != nullptr;
        begin_rendering(commands, target.view, setup.extents[e],
                        hidden ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare, {},
                        depth ? target.depth_view : vk::ImageView{});
        draw_eye(e);
        commands.endRendering();
    }
}

/// Binds the sets of frame and scene, and of the method unless it is null.
void bind_sets(const vk::raii::CommandBuffer& commands, const vk::raii::PipelineLayout& layout,
               const FrameRecording& frame, std::size_t eye, vk::DescriptorSet method = {});

}  // namespace gazeloop::render
