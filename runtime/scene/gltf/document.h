#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/gltf/refusal.h"
#include "runtime/scene/mesh/mesh_data.h"

// What a glTF file says, as plain data with the standard's defaults filled in. Every index in it
// points at something, every range lies inside what it is a range of, nodes form trees.
namespace gazeloop::scene::gltf {

/// Where bytes come from: a URI, or, without one, the binary chunk of a .glb.
struct BufferSource {
    std::optional<std::string> uri;
    std::uint64_t bytes = 0;
};

struct BufferView {
    std::uint32_t buffer = 0;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint32_t stride = 0;  ///< 0: elements lie without gaps
};

enum class Component : std::uint8_t { Int8, Uint8, Int16, Uint16, Uint32, Float };
[[nodiscard]] std::uint32_t component_bytes(Component component);

enum class ElementType : std::uint8_t { Scalar, Vec2, Vec3, Vec4, Mat2, Mat3, Mat4 };
/// Components per element.
[[nodiscard]] std::uint32_t component_count(ElementType type);
/// Bytes of an element; columns of matrices start at multiples of four.
[[nodiscard]] std::uint32_t element_bytes(ElementType type, Component component);

/// Elements that replace those of the accessor at `indices`.
struct Sparse {
    std::uint64_t count = 0;
    std::uint32_t index_view = 0;
    std::uint64_t index_offset = 0;
    Component index_component = Component::Uint32;
    std::uint32_t value_view = 0;
    std::uint64_t value_offset = 0;
};

struct Accessor {
    std::optional<std::uint32_t> view;  ///< none: all zeros
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
    Component component = Component::Float;
    ElementType type = ElementType::Scalar;
    bool normalized = false;
    std::vector<double> min;  ///< empty, or one per component
    std::vector<double> max;
    std::optional<Sparse> sparse;
};

/// A picture's file: a URI or a view.
struct ImageSource {
    std::optional<std::string> uri;
    std::optional<std::uint32_t> view;
};

/// A texture, not yet decoded.
struct Texture {
    std::optional<std::uint32_t> image;  ///< none: only an unsupported extension names one
    mesh::Wrap wrap_u = mesh::Wrap::Repeat;
    mesh::Wrap wrap_v = mesh::Wrap::Repeat;
    bool nearest = false;
};

/// How a material uses a texture.
struct TextureReference {
    std::uint32_t texture = 0;
    std::uint32_t uv_set = 0;  ///< n of TEXCOORD_n
    glm::mat3 transform{1.0F};
    std::string place;  ///< JSON pointer
};

/// A material without its images.
struct MaterialSource {
    mesh::Material material;
    std::optional<TextureReference> base_color;
    std::optional<TextureReference> metallic_roughness;
    std::optional<TextureReference> normal;
    std::optional<TextureReference> occlusion;
    std::optional<TextureReference> emissive;
};

enum class Mode : std::uint8_t {
    Points,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan
};

struct PrimitiveSource {
    std::map<std::string, std::uint32_t> attributes;  ///< accessors by name
    std::optional<std::uint32_t> indices;
    std::optional<std::uint32_t> material;
    Mode mode = Mode::Triangles;
    bool has_targets = false;
};

struct MeshSource {
    std::string name;
    std::vector<PrimitiveSource> primitives;
};

struct Node {
    std::string name;
    std::vector<std::uint32_t> children;
    glm::dmat4 parent_from_node{1.0};
    std::optional<std::uint32_t> mesh;
    std::optional<std::uint32_t> light;
    bool is_camera = false;
    bool has_skin = false;
};

struct Document {
    std::vector<BufferSource> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<ImageSource> images;
    std::vector<Texture> textures;
    std::vector<MaterialSource> materials;
    std::vector<MeshSource> meshes;
    std::vector<Node> nodes;
    std::vector<mesh::Light> lights;   ///< in the node's frame
    std::vector<std::uint32_t> roots;  ///< nodes of the scene that is shown
    bool is_quantized = false;         ///< KHR_mesh_quantization is in use
};

/// Reads the JSON of a file. Throws Refusal with the JSON pointer; what is merely doubtful, or not
/// shown, is noted.
[[nodiscard]] Document read_document(std::string_view json, Notes& notes);

}  // namespace gazeloop::scene::gltf
