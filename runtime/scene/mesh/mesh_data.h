#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <string>
#include <vector>

#include "runtime/memory/large_pages.h"

// A scene of triangle meshes as plain data: what a file loader or a generator makes and a renderer
// draws. Axes as OpenXR's (+X right, +Y up, -Z forward), metres, linear Rec.709 light. The material
// model is that of glTF 2.0 (metallic-roughness) with its defaults.
namespace gazeloop::scene::mesh {

/// Index that refers to nothing.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// As it lies in the GPU's vertex buffer.
struct Vertex {
    glm::vec3 position_m{0.0F};          ///< in the primitive's own frame
    glm::vec3 normal{0.0F, 0.0F, 1.0F};  ///< unit length
    /// Unit vector along increasing u of the normal map; w is 1 or -1, the bitangent is
    /// w * cross(normal, tangent).
    glm::vec4 tangent{1.0F, 0.0F, 0.0F, 1.0F};
    std::array<glm::vec2, 2> uv{};  ///< origin top-left; may lie outside [0, 1]
    /// Multiplies the base colour; linear, 255 is 1.
    std::array<std::uint8_t, 4> color{255, 255, 255, 255};
};
static_assert(sizeof(Vertex) == 60);

/// An axis-aligned box. Empty while low exceeds high.
struct Bounds {
    glm::vec3 low_m{std::numeric_limits<float>::infinity()};
    glm::vec3 high_m{-std::numeric_limits<float>::infinity()};
};

/// Triangles of one material: indices [first_index, first_index + index_count) of the scene's index
/// list, each relative to `first_vertex`. Counter-clockwise seen from the front.
struct Primitive {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;  ///< a multiple of 3
    std::uint32_t first_vertex = 0;
    std::uint32_t vertex_count = 0;  ///< every index lies below it
    std::uint32_t material = 0;
    Bounds bounds{};  ///< of the vertices that are used
};

/// The same thing in several finenesses. Level 0 is the finest.
struct DetailLevel {
    std::uint32_t primitive = 0;
    /// How far its surface lies from the true one, in the primitive's frame, m; rising.
    float error_m = 0.0F;
};

/// One thing in the world: a range of `levels`, coarser and coarser. A thing that has no coarser
/// form has one level.
struct Instance {
    std::uint32_t first_level = 0;
    std::uint32_t level_count = 1;
    /// Columns: the frame's axes and its origin in world. May mirror (negative determinant), which
    /// turns the winding round.
    glm::mat4x3 world_from_local{1.0F};
};

enum class Wrap : std::uint8_t { Repeat, Mirror, Clamp };

/// How a material reads an image.
struct TextureUse {
    std::uint32_t image = kNone;  ///< kNone: the texture is 1 (normal: straight up)
    std::uint32_t uv_set = 0;     ///< 0 or 1
    /// Maps (u, v, 1) to the place in the image: KHR_texture_transform. The third row is (0, 0, 1).
    glm::mat3 transform{1.0F};
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    bool nearest = false;  ///< enlarged without filter
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

struct Material {
    std::string name{};
    glm::vec4 base_color{1.0F};  ///< linear
    float metallic = 1.0F;
    float roughness = 1.0F;  ///< perceptual, as in glTF
    float normal_scale = 1.0F;
    float occlusion_strength = 1.0F;
    glm::vec3 emissive{0.0F};  ///< with KHR_materials_emissive_strength multiplied in
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5F;  ///< of Mask
    bool double_sided = false;
    bool unlit = false;
    /// Share of light that is let through, [0, 1] (KHR_materials_transmission); glass has 1.
    float transmission = 0.0F;
    float index_of_refraction = 1.5F;

    TextureUse base_color_texture{};          ///< sRGB; alpha linear
    TextureUse metallic_roughness_texture{};  ///< linear: g roughness, b metallic
    TextureUse normal_texture{};              ///< linear
    TextureUse occlusion_texture{};           ///< linear: r
    TextureUse emissive_texture{};            ///< sRGB
};

enum class ColorSpace : std::uint8_t { Linear, Srgb };
enum class TexelFormat : std::uint8_t { Rgba8, Rgba16 };

/// A decoded picture, rows from the top without padding, four channels. One that is used in both
/// colour spaces is listed twice. Mips are the renderer's business.
struct Image {
    std::string name{};  ///< for messages
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    ColorSpace color_space = ColorSpace::Linear;
    TexelFormat format = TexelFormat::Rgba8;
    /// width * height * (4 or 8) bytes, native byte order
    memory::LargePagesVector<std::byte> texels{};
};

enum class LightKind : std::uint8_t { Directional, Point, Spot };

/// As KHR_lights_punctual.
struct Light {
    LightKind kind = LightKind::Directional;
    glm::vec3 color{1.0F};   ///< linear; times intensity
    float intensity = 1.0F;  ///< directional: lux; else candela
    glm::vec3 position_m{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit; the way that the light goes
    float range_m = std::numeric_limits<float>::infinity();
    float inner_cone_rad = 0.0F;          ///< of Spot, from its axis
    float outer_cone_rad = 0.785398163F;  ///< of Spot; above the inner one, at most pi / 2
    bool casts_shadow = true;
};

/// Where the scene's maker put a camera: its frame in world.
struct Viewpoint {
    std::string name{};
    glm::mat4x3 world_from_camera{1.0F};
};

/// The sky and what it lights. A scene without one gets a plain daylight.
struct Sky {
    glm::vec3 zenith{0.20F, 0.34F, 0.62F};  ///< radiance
    glm::vec3 horizon{0.75F, 0.80F, 0.85F};
    glm::vec3 ground{0.16F, 0.14F, 0.12F};
    float clouds = 0.0F;  ///< cover, [0, 1]
};

/// Everything. Whoever makes it guarantees that all indices refer to what is there, all numbers are
/// finite (ranges of lights aside) and unit vectors are unit; check_mesh_data() holds it to that.
struct MeshData {
    std::vector<Vertex> vertices{};
    std::vector<std::uint32_t> indices{};
    std::vector<Primitive> primitives{};
    std::vector<DetailLevel> levels{};
    std::vector<Instance> instances{};
    std::vector<Material> materials{};
    std::vector<Image> images{};
    std::vector<Light> lights{};  ///< none: a sun is added
    std::vector<Viewpoint> viewpoints{};
    Sky sky{};
    /// Radiance in the file's units that is to be shown as 1: pictures are divided by it.
    float exposure = 1.0F;
};

}  // namespace gazeloop::scene::mesh
