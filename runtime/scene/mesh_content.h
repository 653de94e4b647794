#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/scene/mesh/clusters.h"
#include "runtime/scene/mesh/draw_list.h"
#include "runtime/scene/mesh/mesh_data.h"
#include "runtime/scene/mesh/shadow_view.h"
#include "runtime/scene/mesh_needs.h"
#include "runtime/scene/mesh_uniforms.h"
#include "runtime/vulkan/layered_image.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/pipelines.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::scene {

inline constexpr vk::Format kGBufferFormat = vk::Format::eR32G32B32A32Uint;
inline constexpr vk::Format kSceneDepthFormat = vk::Format::eD32Sfloat;

/// What of each of some draws is drawn: ranges of an index buffer of the frame's own, or all of a
/// primitive where the count is none.
struct FacingIndices {
    struct Range {
        std::uint32_t first = 0;
        std::optional<std::uint32_t> count;
    };
    vk::Buffer buffer;
    std::vector<Range> ranges;  ///< by draw
};

/// What keeps highlights from flickering.
struct HighlightFilters {
    bool pixel = true;       ///< they are as wide as normals turn within a pixel
    bool footprint = false;  ///< within what a sample stands for
};

/// What all renderers of a scene of meshes share on the GPU: vertices, textures, materials,
/// pipelines, the sky, the shadow maps.
class MeshContent {
  public:
    /// Throws SetupError: data that check_mesh_data() refuses (BadInput), no memory (NoDevice).
    MeshContent(const vulkan::Context& context, const mesh::MeshData& data, const MeshNeeds& needs,
                const HighlightFilters& filters);

    [[nodiscard]] const vulkan::Context& context() const { return *context_; }
    [[nodiscard]] const MeshNeeds& needs() const { return needs_; }
    [[nodiscard]] const std::vector<vulkan::ShaderConstant>& constants() const {
        return constants_;
    }

    /// Layout of ViewUniforms and instances: set 0 of the passes before the gaze.
    [[nodiscard]] vk::DescriptorSetLayout view_layout() const { return *view_layout_; }
    /// Writes a set of that layout.
    void write_view_set(vk::DescriptorSet set, vk::Buffer uniforms) const;
    /// Layout of what the lighting reads (shaders/scenes/mesh.glsl).
    [[nodiscard]] vk::DescriptorSetLayout lighting_layout() const { return *lighting_layout_; }
    /// Writes a set of that layout; without glass, its views are null.
    void write_lighting_set(vk::DescriptorSet set, vk::ImageView g_buffer, vk::ImageView depth,
                            vk::ImageView glass_buffer, vk::ImageView glass_depth) const;

    enum class Pass : std::uint8_t { Depth, Surfaces, Glass };
    /// What of a pass may be seen, the nearest first.
    void choose(Pass pass, const mesh::Frustum& frustum, std::vector<mesh::Draw>& draws) const;
    /// Writes the indices of what of these draws may be seen, from `used` on, which is moved on.
    /// What finds no room is drawn whole.
    void face(const std::vector<mesh::Draw>& draws, const mesh::Frustum& frustum,
              std::span<std::uint32_t> indices, std::uint32_t& used, FacingIndices& facing) const;
    /// Records draws of a pass into the targets that are bound; null: all of their triangles.
    void draw(const vk::raii::CommandBuffer& commands, Pass pass, vk::DescriptorSet view,
              const std::vector<mesh::Draw>& draws, const FacingIndices* facing) const;
    /// Indices that the finest forms of all things have together.
    [[nodiscard]] std::size_t most_indices() const { return most_indices_; }
    void draw_sky(const vk::raii::CommandBuffer& commands, vk::DescriptorSet view) const;

    /// Whether the shadow maps must be drawn in this frame.
    [[nodiscard]] bool shadows_due() const {
        return !shadow_views_.empty() && (needs_.shadows_each_frame || !shadows_drawn_);
    }
    /// Records them, and that the lighting reads them.
    void draw_shadows(const vk::raii::CommandBuffer& commands);

    [[nodiscard]] const glm::vec4& to_sun() const { return to_sun_; }
    [[nodiscard]] const glm::vec4& sun() const { return sun_; }

  private:
    struct PipelineKey {
        std::uint32_t textures = 0;
        bool masked = false;
        bool shares_texel = false;  ///< occlusion is in the texel of metallic and roughness
        TexelKind kind = TexelKind::Surface;
        friend bool operator==(const PipelineKey&, const PipelineKey&) = default;
    };
    struct Pipelines {
        PipelineKey key;
        vk::raii::Pipeline depth{nullptr};
        vk::raii::Pipeline surface{nullptr};
    };
    struct MaterialState {
        std::size_t pipelines = 0;
        bool masked = false;
        bool double_sided = false;
        TexelKind kind = TexelKind::Surface;
        vk::raii::DescriptorSet set{nullptr};
    };

    void make_buffers(const mesh::MeshData& data);
    void make_textures(const mesh::MeshData& data);
    void make_materials(const mesh::MeshData& data);
    void make_pipelines(MaterialState& state, const PipelineKey& key);
    void make_sky(const mesh::MeshData& data);
    void make_lights(const mesh::MeshData& data);
    void make_shadow_maps();
    [[nodiscard]] vk::Sampler sampler_of(const mesh::TextureUse& use);
    [[nodiscard]] static bool belongs(Pass pass, TexelKind kind);

    const vulkan::Context* context_;
    MeshNeeds needs_;
    HighlightFilters filters_;
    std::vector<vulkan::ShaderConstant> constants_;
    mesh::DrawList draw_list_;
    mesh::Clusters clusters_;
    std::size_t most_indices_ = 0;
    std::vector<mesh::Primitive> primitives_;
    std::vector<glm::mat4x3> world_from_local_;  ///< by instance
    std::vector<bool> mirrored_;                 ///< by instance
    glm::vec4 to_sun_{0.0F, 1.0F, 0.0F, 2.0F};
    glm::vec4 sun_{0.0F};

    vulkan::DeviceBuffer vertices_;
    vulkan::DeviceBuffer indices_;
    vulkan::DeviceBuffer instances_;
    vulkan::DeviceBuffer material_uniforms_;
    vulkan::DeviceBuffer lights_;
    MeshUniforms lighting_;
    std::vector<vulkan::LayeredImage> textures_;
    vulkan::LayeredImage blank_;  ///< white, where a material has no texture
    vulkan::LayeredImage sky_;
    vulkan::LayeredImage shadow_maps_;
    bool shadows_drawn_ = false;
    std::vector<mesh::ShadowView> shadow_views_;
    std::vector<vulkan::HostBuffer> shadow_uniforms_;

    struct SamplerState {
        mesh::Wrap wrap_u;
        mesh::Wrap wrap_v;
        bool nearest;
        vk::raii::Sampler sampler;
    };
    std::vector<SamplerState> samplers_;
    vk::raii::Sampler plain_sampler_{nullptr};  ///< nearest, clamped
    vk::raii::Sampler sky_sampler_{nullptr};
    vk::raii::DescriptorSetLayout view_layout_{nullptr};
    vk::raii::DescriptorSetLayout material_layout_{nullptr};
    vk::raii::DescriptorSetLayout sky_layout_{nullptr};
    vk::raii::DescriptorSetLayout lighting_layout_{nullptr};
    vk::raii::PipelineLayout mesh_layout_{nullptr};
    vk::raii::PipelineLayout sky_pipeline_layout_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    std::vector<vk::raii::DescriptorSet> shadow_sets_;
    vk::raii::DescriptorSet sky_set_{nullptr};
    vk::raii::Pipeline sky_pipeline_{nullptr};
    std::vector<Pipelines> pipelines_;
    std::vector<MaterialState> materials_;
};

}  // namespace gazeloop::scene
