#include "runtime/scene/mesh_content.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "runtime/error.h"
#include "runtime/scene/mesh/check_mesh_data.h"
#include "runtime/scene/mesh_texture.h"
#include "runtime/scene/sky/sky_cube.h"
#include "runtime/vulkan/raster_pipeline.h"

namespace gazeloop::scene {
namespace {

using Type = vk::DescriptorType;

constexpr std::size_t kMaterialStride = 256;  ///< the most that offsets of uniforms may ask for
static_assert(sizeof(MaterialUniforms) <= kMaterialStride);

/// Around the place where the viewer stands: what the sun's fine shadow map holds.
constexpr float kNearShadow_m = 7.0F;
constexpr std::uint32_t kReflectionStepCount = 18;
constexpr std::uint32_t kOcclusionTapCount = 8;

constexpr std::array kAttributes{
    vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32B32Sfloat,
                                        offsetof(mesh::Vertex, position_m)),
    vk::VertexInputAttributeDescription(1, 0, vk::Format::eR32G32B32Sfloat,
                                        offsetof(mesh::Vertex, normal)),
    vk::VertexInputAttributeDescription(2, 0, vk::Format::eR32G32B32A32Sfloat,
                                        offsetof(mesh::Vertex, tangent)),
    vk::VertexInputAttributeDescription(3, 0, vk::Format::eR32G32B32A32Sfloat,
                                        offsetof(mesh::Vertex, uv)),
    vk::VertexInputAttributeDescription(4, 0, vk::Format::eR8G8B8A8Unorm,
                                        offsetof(mesh::Vertex, color))};
constexpr std::array kDepthAttributes{kAttributes[0], kAttributes[3], kAttributes[4]};

vk::SamplerAddressMode mode_of(mesh::Wrap wrap) {
    switch (wrap) {
        case mesh::Wrap::Repeat:
            return vk::SamplerAddressMode::eRepeat;
        case mesh::Wrap::Mirror:
            return vk::SamplerAddressMode::eMirroredRepeat;
        case mesh::Wrap::Clamp:
            return vk::SamplerAddressMode::eClampToEdge;
    }
    return vk::SamplerAddressMode::eRepeat;
}

mesh::Light default_sun() {
    mesh::Light light;
    light.intensity = 3.0F;
    light.direction = glm::normalize(glm::vec3(-0.5F, -0.75F, -0.45F));
    return light;
}

/// Whether both read the same texels.
bool same(const mesh::TextureUse& a, const mesh::TextureUse& b) {
    return a.image == b.image && a.uv_set == b.uv_set && a.transform == b.transform &&
           a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v && a.nearest == b.nearest;
}

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& objects) {
    return std::as_bytes(std::span(objects));
}

}  // namespace

MeshContent::MeshContent(const vulkan::Context& context, const mesh::MeshData& data,
                         const MeshNeeds& needs, const HighlightFilters& filters)
    : context_(&context), needs_(needs), filters_(filters), primitives_(data.primitives) {
    value_or_throw(mesh::check_mesh_data(data));
    draw_list_ = mesh::DrawList(data);
    clusters_ = mesh::Clusters(data);
    const vk::raii::Device& device = context.device();
    using Stage = vk::ShaderStageFlagBits;
    constexpr std::array kView{Type::eUniformBuffer, Type::eStorageBuffer};
    constexpr std::array kMaterial{Type::eUniformBuffer,        Type::eCombinedImageSampler,
                                   Type::eCombinedImageSampler, Type::eCombinedImageSampler,
                                   Type::eCombinedImageSampler, Type::eCombinedImageSampler};
    constexpr std::array kSky{Type::eCombinedImageSampler};
    constexpr std::array kLighting{Type::eUniformBuffer,        Type::eCombinedImageSampler,
                                   Type::eCombinedImageSampler, Type::eCombinedImageSampler,
                                   Type::eCombinedImageSampler, Type::eCombinedImageSampler,
                                   Type::eCombinedImageSampler};
    view_layout_ = vulkan::make_set_layout(device, kView, Stage::eVertex | Stage::eFragment);
    material_layout_ = vulkan::make_set_layout(device, kMaterial, Stage::eFragment);
    sky_layout_ = vulkan::make_set_layout(device, kSky, Stage::eFragment);
    lighting_layout_ = vulkan::make_set_layout(device, kLighting, Stage::eFragment);
    const std::array mesh_sets{*view_layout_, *material_layout_};
    mesh_layout_ = vk::raii::PipelineLayout(device, vk::PipelineLayoutCreateInfo({}, mesh_sets));
    const std::array sky_sets{*view_layout_, *sky_layout_};
    sky_pipeline_layout_ =
        vk::raii::PipelineLayout(device, vk::PipelineLayoutCreateInfo({}, sky_sets));
    const auto materials = static_cast<std::uint32_t>(data.materials.size());
    const auto maps = static_cast<std::uint32_t>(kMostShadowMaps);
    const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, materials + maps),
                           vk::DescriptorPoolSize(Type::eStorageBuffer, maps),
                           vk::DescriptorPoolSize(Type::eCombinedImageSampler, 5 * materials + 1)};
    pool_ = vk::raii::DescriptorPool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             materials + maps + 1, sizes));
    using Mode = vk::SamplerAddressMode;
    plain_sampler_ = vk::raii::Sampler(
        device, vk::SamplerCreateInfo({}, vk::Filter::eNearest, vk::Filter::eNearest,
                                      vk::SamplerMipmapMode::eNearest, Mode::eClampToEdge,
                                      Mode::eClampToEdge, Mode::eClampToEdge));
    sky_sampler_ = vk::raii::Sampler(
        device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                      vk::SamplerMipmapMode::eLinear, Mode::eClampToEdge,
                                      Mode::eClampToEdge, Mode::eClampToEdge, 0.0F, VK_FALSE, 1.0F,
                                      VK_FALSE, {}, 0.0F, VK_LOD_CLAMP_NONE));
    make_buffers(data);
    make_textures(data);
    make_materials(data);
    make_sky(data);
    make_lights(data);
}

void MeshContent::make_buffers(const mesh::MeshData& data) {
    using Usage = vk::BufferUsageFlagBits;
    // Buffers of no bytes are not allowed.
    const std::vector<mesh::Vertex> vertices =
        data.vertices.empty() ? std::vector<mesh::Vertex>(1) : std::vector<mesh::Vertex>{};
    const std::vector<std::uint32_t> indices =
        data.indices.empty() ? std::vector<std::uint32_t>(3) : std::vector<std::uint32_t>{};
    vertices_ = vulkan::DeviceBuffer(
        *context_, bytes_of(vertices.empty() ? data.vertices : vertices), Usage::eVertexBuffer);
    indices_ = vulkan::DeviceBuffer(*context_, bytes_of(indices.empty() ? data.indices : indices),
                                    Usage::eIndexBuffer);
    std::vector<glm::vec4> rows;
    rows.reserve(3 * data.instances.size() + 3);
    for (const mesh::Instance& instance : data.instances) {
        const glm::mat4x3& m = instance.world_from_local;
        world_from_local_.push_back(m);
        most_indices_ += data.primitives[data.levels[instance.first_level].primitive].index_count;
        for (int row = 0; row < 3; ++row) {
            rows.emplace_back(m[0][row], m[1][row], m[2][row], m[3][row]);
        }
        mirrored_.push_back(glm::dot(glm::cross(m[0], m[1]), m[2]) < 0.0F);
    }
    rows.resize(std::max<std::size_t>(rows.size(), 3));
    instances_ = vulkan::DeviceBuffer(*context_, bytes_of(rows), Usage::eStorageBuffer);
}

void MeshContent::make_textures(const mesh::MeshData& data) {
    mesh::Image white;
    white.width = 1;
    white.height = 1;
    white.texels.assign(4, std::byte{255});
    blank_ = texture_of(*context_, white);
    textures_ = textures_of(*context_, data.images);
}

vk::Sampler MeshContent::sampler_of(const mesh::TextureUse& use) {
    for (const SamplerState& state : samplers_) {
        if (state.wrap_u == use.wrap_u && state.wrap_v == use.wrap_v &&
            state.nearest == use.nearest) {
            return *state.sampler;
        }
    }
    samplers_.push_back(
        {use.wrap_u, use.wrap_v, use.nearest,
         vk::raii::Sampler(
             context_->device(),
             vk::SamplerCreateInfo({}, use.nearest ? vk::Filter::eNearest : vk::Filter::eLinear,
                                   vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear,
                                   mode_of(use.wrap_u), mode_of(use.wrap_v),
                                   vk::SamplerAddressMode::eRepeat, 0.0F, VK_FALSE, 1.0F, VK_FALSE,
                                   {}, 0.0F, VK_LOD_CLAMP_NONE))});
    return *samplers_.back().sampler;
}

void MeshContent::make_materials(const mesh::MeshData& data) {
    const vk::raii::Device& device = context_->device();
    std::vector<std::byte> uniforms(std::max<std::size_t>(1, data.materials.size()) *
                                    kMaterialStride);
    for (std::size_t i = 0; i < data.materials.size(); ++i) {
        const MaterialUniforms one = uniforms_of(data.materials[i]);
        std::memcpy(uniforms.data() + i * kMaterialStride, &one, sizeof one);
    }
    material_uniforms_ =
        vulkan::DeviceBuffer(*context_, uniforms, vk::BufferUsageFlagBits::eUniformBuffer);
    for (std::size_t i = 0; i < data.materials.size(); ++i) {
        const mesh::Material& material = data.materials[i];
        MaterialState state;
        state.masked = material.alpha_mode == mesh::AlphaMode::Mask;
        state.double_sided = material.double_sided;
        state.kind = kind_of(material);
        state.set = std::move(vk::raii::DescriptorSets(
            device, vk::DescriptorSetAllocateInfo(*pool_, *material_layout_))[0]);
        const vk::DescriptorBufferInfo buffer(material_uniforms_.buffer(), i * kMaterialStride,
                                              sizeof(MaterialUniforms));
        device.updateDescriptorSets(
            vk::WriteDescriptorSet(*state.set, 0, 0, Type::eUniformBuffer, {}, buffer), {});
        PipelineKey key{
            .masked = state.masked,
            .shares_texel = same(material.occlusion_texture, material.metallic_roughness_texture),
            .kind = state.kind};
        std::uint32_t binding = 1;
        for (const mesh::TextureUse* use : textures_of(material)) {
            const bool there = use->image != mesh::kNone;
            key.textures |= there ? 1U << (binding - 1) : 0U;
            const vk::DescriptorImageInfo info(sampler_of(*use),
                                               there ? textures_[use->image].view() : blank_.view(),
                                               vk::ImageLayout::eShaderReadOnlyOptimal);
            device.updateDescriptorSets(
                vk::WriteDescriptorSet(*state.set, binding++, 0, Type::eCombinedImageSampler, info),
                {});
        }
        make_pipelines(state, key);
        materials_.push_back(std::move(state));
    }
}

void MeshContent::make_pipelines(MaterialState& state, const PipelineKey& key) {
    const auto made = std::ranges::find(pipelines_, key, &Pipelines::key);
    state.pipelines = static_cast<std::size_t>(made - pipelines_.begin());
    if (made != pipelines_.end()) {
        return;
    }
    const vk::raii::Device& device = context_->device();
    const std::array constants{vulkan::ShaderConstant{0, key.textures},
                               vulkan::ShaderConstant{1, key.masked ? 1U : 0U},
                               vulkan::ShaderConstant{2, static_cast<std::uint32_t>(key.kind)},
                               vulkan::ShaderConstant{3, filters_.pixel ? 1U : 0U},
                               vulkan::ShaderConstant{4, key.shares_texel ? 1U : 0U}};
    Pipelines pipelines{.key = key};
    pipelines.depth = vulkan::make_raster_pipeline(device, mesh_layout_,
                                                   {.vertex = "depth.vert",
                                                    .fragment = key.masked ? "depth.frag" : "",
                                                    .attributes = kDepthAttributes,
                                                    .stride = sizeof(mesh::Vertex),
                                                    .depth_format = kSceneDepthFormat,
                                                    .constants = constants});
    pipelines.surface = vulkan::make_raster_pipeline(
        device, mesh_layout_,
        {.vertex = "g_buffer.vert",
         .fragment = "g_buffer.frag",
         .attributes = kAttributes,
         .stride = sizeof(mesh::Vertex),
         .format = kGBufferFormat,
         .depth_format = kSceneDepthFormat,
         .compare = needs_.depth_first ? vk::CompareOp::eGreaterOrEqual : vk::CompareOp::eGreater,
         .constants = constants});
    pipelines_.push_back(std::move(pipelines));
}

void MeshContent::make_sky(const mesh::MeshData& data) {
    const sky::SkyCube cube = sky::bake(data.sky);
    std::vector<vulkan::LevelTexels> levels;
    for (std::uint32_t level = 0; level < sky::SkyCube::kLevels; ++level) {
        const std::uint32_t face_texels = sky::SkyCube::face_of(level);
        const std::size_t count = std::size_t{face_texels} * face_texels;
        for (std::uint32_t face = 0; face < 6; ++face) {
            vulkan::LevelTexels part{level, face, vk::Extent2D(face_texels, face_texels), {}};
            part.bytes.resize(count * sizeof(std::uint64_t));
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint64_t half =
                    glm::packHalf4x16(glm::vec4(cube.levels.at(level)[face * count + i], 1.0F));
                std::memcpy(part.bytes.data() + i * sizeof half, &half, sizeof half);
            }
            levels.push_back(std::move(part));
        }
    }
    using Usage = vk::ImageUsageFlagBits;
    sky_ = vulkan::LayeredImage(*context_,
                                {.extent = vk::Extent2D(sky::SkyCube::kFace, sky::SkyCube::kFace),
                                 .format = vk::Format::eR16G16B16A16Sfloat,
                                 .usage = Usage::eSampled | Usage::eTransferDst,
                                 .levels = sky::SkyCube::kLevels,
                                 .layers = 6,
                                 .view = vk::ImageViewType::eCube});
    vulkan::upload(*context_, sky_, levels);
    for (std::size_t i = 0; i < cube.diffuse.size(); ++i) {
        lighting_.sky_diffuse.at(i) = glm::vec4(cube.diffuse.at(i), 0.0F);
    }
    const vk::raii::Device& device = context_->device();
    sky_set_ = std::move(
        vk::raii::DescriptorSets(device, vk::DescriptorSetAllocateInfo(*pool_, *sky_layout_))[0]);
    const vk::DescriptorImageInfo info(*sky_sampler_, sky_.view(),
                                       vk::ImageLayout::eShaderReadOnlyOptimal);
    device.updateDescriptorSets(
        vk::WriteDescriptorSet(*sky_set_, 0, 0, Type::eCombinedImageSampler, info), {});
    sky_pipeline_ = vulkan::make_raster_pipeline(device, sky_pipeline_layout_,
                                                 {.vertex = "full_screen.vert",
                                                  .fragment = "sky.frag",
                                                  .format = kGBufferFormat,
                                                  .depth_format = kSceneDepthFormat,
                                                  .compare = vk::CompareOp::eGreaterOrEqual,
                                                  .writes_depth = false});
}

void MeshContent::make_lights(const mesh::MeshData& data) {
    std::vector<mesh::Light> lights = data.lights;
    if (lights.empty()) {
        spdlog::info("the scene has no light: a sun is added, high up behind the right shoulder");
        lights.push_back(default_sun());
    }
    const auto casts = [&](const mesh::Light& light) {
        return needs_.shadows && light.casts_shadow && light.kind != mesh::LightKind::Point;
    };
    std::ranges::stable_partition(lights, casts);
    if (lights.size() > kMostLights) {
        spdlog::warn("the scene has {} lights: {} of them are shown, those with shadows first",
                     lights.size(), kMostLights);
        lights.resize(kMostLights);
    }
    const glm::vec4 all_m = draw_list_.main_sphere();
    // Where viewers stand.
    const glm::vec4 near_m(0.0F, -0.5F, -0.6F * kNearShadow_m, kNearShadow_m);
    std::uint32_t shadowed = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const mesh::Light& light = lights[i];
        LightUniforms& uniforms = lighting_.lights.at(i);
        uniforms = uniforms_of(light);
        if (!casts(light)) {
            continue;
        }
        const auto views = mesh::shadow_views(light, near_m, all_m, kShadowTexels);
        if (shadow_views_.size() + views.size() > kMostShadowMaps) {
            spdlog::warn(
                "the scene has more lights with shadows than {} shadow maps serve: the "
                "others cast none",
                kMostShadowMaps);
            break;
        }
        uniforms.shape.z = static_cast<float>(shadow_views_.size());
        uniforms.shape.w = static_cast<float>(shadow_views_.size() + views.size() - 1);
        for (const mesh::ShadowView& view : views) {
            const std::size_t map = shadow_views_.size();
            // From [-1, 1] to [0, 1] in x and y, times w.
            const glm::mat4 halved =
                glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(0.5F, 0.5F, 0.0F)),
                           glm::vec3(0.5F, 0.5F, 1.0F));
            lighting_.shadow_from_world.at(map) = halved * view.clip_from_world;
            lighting_.shadow_texels.at(map) = {view.texel_m, view.texel_per_m, 1e-4F, 0.0F};
            shadow_views_.push_back(view);
        }
        shadowed = static_cast<std::uint32_t>(i + 1);
    }
    const auto sun = std::ranges::find(lights, mesh::LightKind::Directional, &mesh::Light::kind);
    if (sun != lights.end()) {
        constexpr float kSunRadius_rad = 0.012F;  // twice and a half its true one: it is to be seen
        to_sun_ = glm::vec4(-sun->direction, std::cos(kSunRadius_rad));
        sun_ = glm::vec4(sun->color * sun->intensity * 8.0F, 0.0F);
    }
    lighting_.more = {1.0F / data.exposure, 1.0F / kShadowTexels, 0.0F, 0.0F};
    lights_ = vulkan::DeviceBuffer(*context_, std::as_bytes(std::span(&lighting_, 1)),
                                   vk::BufferUsageFlagBits::eUniformBuffer);
    constants_ = {{kShadowLights, shadowed},
                  {kPlainLights, static_cast<std::uint32_t>(lights.size()) - shadowed},
                  {kHasGlass, needs_.glass ? 1U : 0U},
                  {kReflectionSteps, needs_.reflections ? kReflectionStepCount : 0U},
                  {kOcclusionTaps, kOcclusionTapCount},
                  {kFootprint, filters_.footprint ? 1U : 0U}};
    make_shadow_maps();
}

void MeshContent::make_shadow_maps() {
    using Usage = vk::ImageUsageFlagBits;
    const vk::raii::Device& device = context_->device();
    const bool any = !shadow_views_.empty();
    // A scene without shadows still has a set to fill.
    const std::uint32_t texels = any ? kShadowTexels : 1;
    shadow_maps_ = vulkan::LayeredImage(
        *context_, {.extent = vk::Extent2D(texels, texels),
                    .format = kSceneDepthFormat,
                    .usage = Usage::eSampled | Usage::eDepthStencilAttachment | Usage::eTransferDst,
                    .aspect = vk::ImageAspectFlagBits::eDepth,
                    .layers = std::max(1U, static_cast<std::uint32_t>(shadow_views_.size())),
                    .view = vk::ImageViewType::e2DArray});
    if (!any) {
        vulkan::upload(*context_, shadow_maps_,
                       {{0, 0, vk::Extent2D(1, 1), std::vector<std::byte>(sizeof(float))}});
        return;
    }
    for (const mesh::ShadowView& view : shadow_views_) {
        ViewUniforms uniforms;
        uniforms.clip_from_world = view.clip_from_world;
        shadow_uniforms_.emplace_back(*context_, sizeof uniforms,
                                      vk::BufferUsageFlagBits::eUniformBuffer);
        shadow_uniforms_.back().write(uniforms);
        shadow_sets_.push_back(std::move(vk::raii::DescriptorSets(
            device, vk::DescriptorSetAllocateInfo(*pool_, *view_layout_))[0]));
        write_view_set(*shadow_sets_.back(), shadow_uniforms_.back().buffer());
    }
}

void MeshContent::write_view_set(vk::DescriptorSet set, vk::Buffer uniforms) const {
    const vk::DescriptorBufferInfo view(uniforms, 0, VK_WHOLE_SIZE);
    const vk::DescriptorBufferInfo instances(instances_.buffer(), 0, VK_WHOLE_SIZE);
    const std::array writes{vk::WriteDescriptorSet(set, 0, 0, Type::eUniformBuffer, {}, view),
                            vk::WriteDescriptorSet(set, 1, 0, Type::eStorageBuffer, {}, instances)};
    context_->device().updateDescriptorSets(writes, {});
}

void MeshContent::write_lighting_set(vk::DescriptorSet set, vk::ImageView g_buffer,
                                     vk::ImageView depth, vk::ImageView glass_buffer,
                                     vk::ImageView glass_depth) const {
    const vk::DescriptorBufferInfo lights(lights_.buffer(), 0, VK_WHOLE_SIZE);
    context_->device().updateDescriptorSets(
        vk::WriteDescriptorSet(set, 0, 0, Type::eUniformBuffer, {}, lights), {});
    constexpr auto kRead = vk::ImageLayout::eShaderReadOnlyOptimal;
    const std::array images{
        vk::DescriptorImageInfo(*plain_sampler_, g_buffer, kRead),
        vk::DescriptorImageInfo(*plain_sampler_, depth, kRead),
        vk::DescriptorImageInfo(*plain_sampler_, glass_buffer ? glass_buffer : g_buffer, kRead),
        vk::DescriptorImageInfo(*plain_sampler_, glass_depth ? glass_depth : depth, kRead),
        vk::DescriptorImageInfo(*plain_sampler_, shadow_maps_.view(), kRead),
        vk::DescriptorImageInfo(*sky_sampler_, sky_.view(), kRead)};
    std::uint32_t binding = 1;
    for (const vk::DescriptorImageInfo& image : images) {
        context_->device().updateDescriptorSets(
            vk::WriteDescriptorSet(set, binding++, 0, Type::eCombinedImageSampler, image), {});
    }
}

bool MeshContent::belongs(Pass pass, TexelKind kind) {
    const bool through = kind == TexelKind::Glass || kind == TexelKind::Veil;
    return (pass == Pass::Glass) == through;
}

void MeshContent::choose(Pass pass, const mesh::Frustum& frustum,
                         std::vector<mesh::Draw>& draws) const {
    draw_list_.choose(
        frustum, [&](std::uint32_t material) { return belongs(pass, materials_[material].kind); },
        draws);
}

void MeshContent::face(const std::vector<mesh::Draw>& draws, const mesh::Frustum& frustum,
                       std::span<std::uint32_t> indices, std::uint32_t& used,
                       FacingIndices& facing) const {
    facing.ranges.clear();
    for (const mesh::Draw& draw : draws) {
        FacingIndices::Range range{.first = used, .count = std::nullopt};
        const bool both_sides = materials_[primitives_[draw.primitive].material].double_sided;
        if (!both_sides) {
            range.count = clusters_.facing(
                draw.primitive, mesh::Clusters::view_of(frustum, world_from_local_[draw.instance]),
                indices.subspan(used));
            used += range.count.value_or(0);
        }
        facing.ranges.push_back(range);
    }
}

void MeshContent::draw(const vk::raii::CommandBuffer& commands, Pass pass, vk::DescriptorSet view,
                       const std::vector<mesh::Draw>& draws, const FacingIndices* facing) const {
    constexpr auto kGraphics = vk::PipelineBindPoint::eGraphics;
    commands.bindDescriptorSets(kGraphics, *mesh_layout_, 0, view, {});
    commands.bindVertexBuffers(0, vertices_.buffer(), vk::DeviceSize{0});
    vk::Pipeline bound;
    vk::Buffer bound_indices;
    std::optional<std::uint32_t> material;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const mesh::Draw& draw = draws[i];
        const mesh::Primitive& primitive = primitives_[draw.primitive];
        const MaterialState& state = materials_[primitive.material];
        const Pipelines& pipelines = pipelines_[state.pipelines];
        const bool part = facing != nullptr && facing->ranges[i].count.has_value();
        const std::uint32_t count = part ? *facing->ranges[i].count : primitive.index_count;
        if (count == 0) {
            continue;
        }
        const vk::Pipeline wanted = pass == Pass::Depth ? *pipelines.depth : *pipelines.surface;
        if (bound != wanted) {
            commands.bindPipeline(kGraphics, wanted);
            bound = wanted;
        }
        if (material != primitive.material) {
            commands.bindDescriptorSets(kGraphics, *mesh_layout_, 1, *state.set, {});
            material = primitive.material;
        }
        const vk::Buffer indices = part ? facing->buffer : indices_.buffer();
        if (bound_indices != indices) {
            commands.bindIndexBuffer(indices, 0, vk::IndexType::eUint32);
            bound_indices = indices;
        }
        commands.setCullMode(state.double_sided ? vk::CullModeFlagBits::eNone
                                                : vk::CullModeFlagBits::eBack);
        commands.setFrontFace(mirrored_[draw.instance] ? vk::FrontFace::eClockwise
                                                       : vk::FrontFace::eCounterClockwise);
        commands.drawIndexed(count, 1, part ? facing->ranges[i].first : primitive.first_index,
                             static_cast<std::int32_t>(primitive.first_vertex), draw.instance);
    }
}

void MeshContent::draw_sky(const vk::raii::CommandBuffer& commands, vk::DescriptorSet view) const {
    constexpr auto kGraphics = vk::PipelineBindPoint::eGraphics;
    commands.bindPipeline(kGraphics, *sky_pipeline_);
    commands.bindDescriptorSets(kGraphics, *sky_pipeline_layout_, 0, {view, *sky_set_}, {});
    commands.setCullMode(vk::CullModeFlagBits::eNone);
    commands.setFrontFace(vk::FrontFace::eCounterClockwise);
    commands.draw(3, 1, 0, 0);
}

void MeshContent::draw_shadows(const vk::raii::CommandBuffer& commands) {
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    const auto to = [&](vk::ImageLayout from, vk::ImageLayout next, Stage before, Access wrote,
                        vk::PipelineStageFlags2 after, vk::AccessFlags2 reads) {
        const vk::ImageMemoryBarrier2 barrier(before, wrote, after, reads, from, next,
                                              VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                              shadow_maps_.image(), shadow_maps_.range());
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    };
    to(vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthStencilAttachmentOptimal,
       Stage::eFragmentShader, Access::eNone,
       Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
       Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    std::vector<mesh::Draw> draws;
    for (std::uint32_t map = 0; map < shadow_views_.size(); ++map) {
        choose(Pass::Depth, shadow_views_[map].frustum, draws);
        const vk::RenderingAttachmentInfo depth(
            shadow_maps_.layer(map), vk::ImageLayout::eDepthStencilAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
            vk::ClearValue(vk::ClearDepthStencilValue(0.0F, 0)));
        const vk::Rect2D area({0, 0}, shadow_maps_.extent());
        commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, 0, nullptr, &depth));
        commands.setViewport(0, vk::Viewport(0.0F, 0.0F, static_cast<float>(kShadowTexels),
                                             static_cast<float>(kShadowTexels), 0.0F, 1.0F));
        commands.setScissor(0, area);
        draw(commands, Pass::Depth, *shadow_sets_[map], draws, nullptr);
        commands.endRendering();
    }
    to(vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal,
       Stage::eLateFragmentTests, Access::eDepthStencilAttachmentWrite, Stage::eFragmentShader,
       Access::eShaderSampledRead);
    shadows_drawn_ = true;
}

}  // namespace gazeloop::scene
