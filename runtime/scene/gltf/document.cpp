// The one file that knows tinygltf. It parses without checking a single index, range, mode or
// version, and passes over what has another type than expected; so apply_rules() comes before it
// and check_document() after it, and it is given neither buffers nor pictures.
#include "runtime/scene/gltf/document.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/check_document.h"
#include "runtime/scene/gltf/json_rules.h"
#include "runtime/scene/gltf/json_text.h"

namespace gazeloop::scene::gltf {
namespace {

using nlohmann::json;

constexpr const char* kLights = "KHR_lights_punctual";

// ---- taking out what tinygltf is not to see -----------------------------------------------------

std::optional<std::string> take_text(json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end()) {
        return std::nullopt;
    }
    std::string text = std::move(found->get_ref<std::string&>());
    object.erase(found);
    return text;
}

/// tinygltf would read buffers at once, and check only their length: it gets one byte instead.
std::vector<BufferSource> take_buffers(json& document) {
    std::vector<BufferSource> buffers;
    if (const auto list = document.find("buffers"); list != document.end()) {
        for (json& buffer : *list) {
            buffers.push_back(
                {take_text(buffer, "uri"), buffer.at("byteLength").get<std::uint64_t>()});
            buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
        }
    }
    return buffers;
}

/// tinygltf would decode pictures, and fail over one that nothing uses.
std::vector<ImageSource> take_images(json& document) {
    std::vector<ImageSource> images;
    if (const auto list = document.find("images"); list != document.end()) {
        for (std::size_t i = 0; i < list->size(); ++i) {
            json& image = (*list)[i];
            ImageSource source{.uri = take_text(image, "uri"), .view = {}};
            if (const auto view = image.find("bufferView"); view != image.end()) {
                source.view = view->get<std::uint32_t>();
            }
            if (source.uri.has_value() == source.view.has_value()) {
                refuse(fmt::format("/images/{}", i), "must have either 'uri' or 'bufferView'");
            }
            images.push_back(std::move(source));
        }
        document.erase(list);
    }
    return images;
}

/// tinygltf refuses indices whose accessor has no view, which are zeros. They get a view that is
/// one more than there are, and document_of() knows it again.
void add_view_of_zeros(json& document) {
    const auto accessors = document.find("accessors");
    if (accessors == document.end()) {
        return;
    }
    json& views = document["bufferViews"];
    if (views.is_null()) {
        views = json::array();
    }
    const std::size_t zeros = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    for (json& accessor : *accessors) {
        if (!accessor.contains("bufferView")) {
            accessor["bufferView"] = zeros;
        }
    }
}

/// What tinygltf resolves in favour of one, or lets pass.
void check_contradictions(const json& document, Notes& notes) {
    if (const auto nodes = document.find("nodes"); nodes != document.end()) {
        for (std::size_t i = 0; i < nodes->size(); ++i) {
            const json& node = (*nodes)[i];
            if (node.contains("matrix") && (node.contains("translation") ||
                                            node.contains("rotation") || node.contains("scale"))) {
                notes.add("matrix and trs", fmt::format("/nodes/{}", i),
                          "has a matrix and translation, rotation or scale: the matrix counts");
            }
        }
    }
    const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (document.contains(lights)) {
        for (std::size_t i = 0; i < document.at(lights).size(); ++i) {
            const json& light = document.at(lights)[i];
            if (light.at("type") == "spot" && !light.contains("spot")) {
                refuse(fmt::format("/extensions/KHR_lights_punctual/lights/{}", i),
                       "is a spot light and lacks 'spot'");
            }
        }
    }
}

/// Takes it out, since tinygltf would find fault with it.
void take_what_is_not_shown(json& document, Notes& notes) {
    for (const auto& [list, consequence] :
         {std::pair{"animations", "nothing moves"},
          std::pair{"skins", "their meshes are shown in the pose that they were bound in"}}) {
        if (const auto found = document.find(list); found != document.end()) {
            notes.add(list, fmt::format("/{}", list),
                      fmt::format("{} {} not supported: {}", found->size(),
                                  found->size() == 1 ? "is" : "are", consequence));
        }
    }
    for (const char* list : {"animations", "skins", "cameras"}) {
        document.erase(list);
    }
}

tinygltf::Model parse(const json& document, Notes& notes) {
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    tinygltf::TinyGLTF reader;
    const std::string text = document.dump();
    const bool is_read = reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                                    static_cast<unsigned>(text.size()), "");
    errors.resize(std::min<std::size_t>(errors.size(), 200));
    if (!is_read) {
        refuse("", fmt::format("cannot be read: {}", errors));
    }
    if (!errors.empty()) {
        notes.add("tinygltf", "", errors);
    }
    return model;
}

// ---- from tinygltf's types to ours --------------------------------------------------------------

/// tinygltf's -1 for nothing.
std::optional<std::uint32_t> index_of(int index) {
    return index < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(index));
}

Component component_of(int code) {
    switch (code) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return Component::Int8;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return Component::Uint8;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return Component::Int16;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return Component::Uint16;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return Component::Uint32;
        default:
            return Component::Float;
    }
}

ElementType element_of(int code) {
    switch (code) {
        case TINYGLTF_TYPE_VEC2:
            return ElementType::Vec2;
        case TINYGLTF_TYPE_VEC3:
            return ElementType::Vec3;
        case TINYGLTF_TYPE_VEC4:
            return ElementType::Vec4;
        case TINYGLTF_TYPE_MAT2:
            return ElementType::Mat2;
        case TINYGLTF_TYPE_MAT3:
            return ElementType::Mat3;
        case TINYGLTF_TYPE_MAT4:
            return ElementType::Mat4;
        default:
            return ElementType::Scalar;
    }
}

Accessor accessor_of(const tinygltf::Accessor& from, std::size_t view_of_zeros) {
    Accessor to{.view = index_of(from.bufferView),
                .offset = from.byteOffset,
                .count = from.count,
                .component = component_of(from.componentType),
                .type = element_of(from.type),
                .normalized = from.normalized,
                .min = from.minValues,
                .max = from.maxValues,
                .sparse = {}};
    if (to.view == view_of_zeros) {
        to.view.reset();
    }
    if (from.sparse.isSparse) {
        to.sparse =
            Sparse{.count = static_cast<std::uint64_t>(from.sparse.count),
                   .index_view = static_cast<std::uint32_t>(from.sparse.indices.bufferView),
                   .index_offset = static_cast<std::uint64_t>(from.sparse.indices.byteOffset),
                   .index_component = component_of(from.sparse.indices.componentType),
                   .value_view = static_cast<std::uint32_t>(from.sparse.values.bufferView),
                   .value_offset = static_cast<std::uint64_t>(from.sparse.values.byteOffset)};
    }
    return to;
}

mesh::Wrap wrap_of(int code) {
    return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? mesh::Wrap::Clamp
           : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? mesh::Wrap::Mirror
                                                           : mesh::Wrap::Repeat;
}

Texture texture_of(const tinygltf::Model& model, const tinygltf::Texture& from) {
    Texture to{.image = index_of(from.source)};
    if (from.sampler >= 0) {
        const tinygltf::Sampler& sampler =
            model.samplers.at(static_cast<std::size_t>(from.sampler));
        to.wrap_u = wrap_of(sampler.wrapS);
        to.wrap_v = wrap_of(sampler.wrapT);
        to.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return to;
}

double number_or(const tinygltf::Value& object, const char* name, double otherwise) {
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

glm::dvec2 pair_or(const tinygltf::Value& object, const char* name, double otherwise) {
    if (!object.Has(name)) {
        return glm::dvec2(otherwise);
    }
    const tinygltf::Value& pair = object.Get(name);
    return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: scaled, then turned counter-clockwise (v points down), then moved.
glm::mat3 transform_of(const tinygltf::Value& extension) {
    const glm::dvec2 offset = pair_or(extension, "offset", 0.0);
    const glm::dvec2 scale = pair_or(extension, "scale", 1.0);
    const double rotation_rad = number_or(extension, "rotation", 0.0);
    const double c = std::cos(rotation_rad);
    const double s = std::sin(rotation_rad);
    return {glm::dmat3(glm::dvec3(c * scale.x, -s * scale.x, 0.0),
                       glm::dvec3(s * scale.y, c * scale.y, 0.0), glm::dvec3(offset, 1.0))};
}

template <typename Info>
std::optional<TextureReference> reference_of(const Info& info, std::string place) {
    const auto texture = index_of(info.index);
    if (!texture) {
        return std::nullopt;
    }
    TextureReference to{.texture = *texture,
                        .uv_set = static_cast<std::uint32_t>(info.texCoord),
                        .transform = glm::mat3(1.0F),
                        .place = std::move(place)};
    if (const auto extension = info.extensions.find("KHR_texture_transform");
        extension != info.extensions.end()) {
        to.transform = transform_of(extension->second);
        to.uv_set = static_cast<std::uint32_t>(
            number_or(extension->second, "texCoord", static_cast<double>(to.uv_set)));
    }
    return to;
}

/// Numbers of a list that apply_rules() has counted.
glm::dvec3 vec3_or(const std::vector<double>& numbers, double otherwise) {
    return numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2])
                               : glm::dvec3(otherwise);
}

/// 0 stands for a surface that reflects everything at every angle, which is not supported.
float refraction_of(double ior, const std::string& place, Notes& notes) {
    const std::string at = place + "/extensions/KHR_materials_ior/ior";
    if (ior == 0.0) {
        notes.add("ior", at, "is 0, which is not supported: taken as 1.5");
        return 1.5F;
    }
    if (ior < 1.0) {
        refuse(at, fmt::format("is {}, must be 0 or at least 1", ior));
    }
    return static_cast<float>(ior);
}

MaterialSource material_of(const tinygltf::Material& from, const std::string& place, Notes& notes) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    MaterialSource to;
    mesh::Material& material = to.material;
    material.name = from.name;
    material.base_color = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.normal_scale = static_cast<float>(from.normalTexture.scale);
    material.occlusion_strength = static_cast<float>(from.occlusionTexture.strength);
    material.emissive = vec3_or(from.emissiveFactor, 0.0);
    material.alpha_mode = from.alphaMode == "MASK"    ? mesh::AlphaMode::Mask
                          : from.alphaMode == "BLEND" ? mesh::AlphaMode::Blend
                                                      : mesh::AlphaMode::Opaque;
    material.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    material.double_sided = from.doubleSided;
    const auto extension = [&](const char* name) -> const tinygltf::Value* {
        const auto found = from.extensions.find(name);
        return found == from.extensions.end() ? nullptr : &found->second;
    };
    if (const auto* strength = extension("KHR_materials_emissive_strength")) {
        material.emissive *= static_cast<float>(number_or(*strength, "emissiveStrength", 1.0));
    }
    if (const auto* transmission = extension("KHR_materials_transmission")) {
        material.transmission =
            static_cast<float>(number_or(*transmission, "transmissionFactor", 0.0));
    }
    if (const auto* ior = extension("KHR_materials_ior")) {
        material.index_of_refraction = refraction_of(number_or(*ior, "ior", 1.5), place, notes);
    }
    material.unlit = extension("KHR_materials_unlit") != nullptr;

    to.base_color =
        reference_of(pbr.baseColorTexture, place + "/pbrMetallicRoughness/baseColorTexture");
    to.metallic_roughness = reference_of(pbr.metallicRoughnessTexture,
                                         place + "/pbrMetallicRoughness/metallicRoughnessTexture");
    to.normal = reference_of(from.normalTexture, place + "/normalTexture");
    to.occlusion = reference_of(from.occlusionTexture, place + "/occlusionTexture");
    to.emissive = reference_of(from.emissiveTexture, place + "/emissiveTexture");
    if (material.unlit) {  // shown is what it emits: that is its base colour, and nothing else
        material.emissive = glm::vec3(material.base_color);
        to.emissive = to.base_color;
    }
    return to;
}

MeshSource mesh_of(const tinygltf::Mesh& from) {
    MeshSource to{.name = from.name, .primitives = {}};
    for (const tinygltf::Primitive& primitive : from.primitives) {
        PrimitiveSource& source = to.primitives.emplace_back();
        for (const auto& [name, accessor] : primitive.attributes) {
            source.attributes[name] = static_cast<std::uint32_t>(accessor);
        }
        source.indices = index_of(primitive.indices);
        source.material = index_of(primitive.material);
        source.mode = primitive.mode < 0 ? Mode::Triangles : static_cast<Mode>(primitive.mode);
        source.has_targets = !primitive.targets.empty();
    }
    return to;
}

/// Of a quaternion (x, y, z, w) that need not be unit; none where it is zero.
glm::dquat rotation_of(const std::vector<double>& numbers, const std::string& place, Notes& notes) {
    if (numbers.empty()) {
        return glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
    const glm::dquat rotation(numbers[3], numbers[0], numbers[1], numbers[2]);
    const double length = glm::length(rotation);
    if (length < 1e-6) {
        refuse(place + "/rotation", "is zero, which is no rotation; the identity is [0, 0, 0, 1]");
    }
    if (std::abs(length - 1.0) > 1e-3) {
        notes.add("rotation", place + "/rotation",
                  fmt::format("has length {:.4g}, must have 1: taken as its direction", length));
    }
    return rotation / length;
}

glm::dmat4 transform_of(const tinygltf::Node& from, const std::string& place, Notes& notes) {
    if (!from.matrix.empty()) {
        const glm::dmat4 matrix = glm::make_mat4(from.matrix.data());
        if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 ||
            matrix[3][3] != 1.0) {
            refuse(place + "/matrix", "its last row must be 0, 0, 0, 1");
        }
        return matrix;
    }
    glm::dmat4 matrix = glm::mat4_cast(rotation_of(from.rotation, place, notes));
    const glm::dvec3 scale = vec3_or(from.scale, 1.0);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= scale[axis];
    }
    matrix[3] = glm::dvec4(vec3_or(from.translation, 0.0), 1.0);
    return matrix;
}

Node node_of(const tinygltf::Node& from, const std::string& place, Notes& notes) {
    Node to{.name = from.name,
            .children = {},
            .parent_from_node = transform_of(from, place, notes),
            .mesh = index_of(from.mesh),
            .light = {},
            .is_camera = from.camera >= 0,
            .has_skin = from.skin >= 0};
    for (const int child : from.children) {
        to.children.push_back(static_cast<std::uint32_t>(child));
    }
    if (const auto light = from.extensions.find(kLights); light != from.extensions.end()) {
        to.light = static_cast<std::uint32_t>(light->second.Get("light").GetNumberAsInt());
    }
    return to;
}

mesh::Light light_of(const tinygltf::Light& from, const std::string& place) {
    mesh::Light to;
    to.kind = from.type == "point"  ? mesh::LightKind::Point
              : from.type == "spot" ? mesh::LightKind::Spot
                                    : mesh::LightKind::Directional;
    to.color = vec3_or(from.color, 1.0);
    to.intensity = static_cast<float>(from.intensity);
    if (from.range > 0.0) {  // absent otherwise
        to.range_m = static_cast<float>(from.range);
    }
    if (to.kind == mesh::LightKind::Spot) {
        to.inner_cone_rad = static_cast<float>(from.spot.innerConeAngle);
        to.outer_cone_rad = static_cast<float>(from.spot.outerConeAngle);
        if (!(to.inner_cone_rad < to.outer_cone_rad)) {
            refuse(place + "/spot", fmt::format("innerConeAngle {} must be below outerConeAngle {}",
                                                to.inner_cone_rad, to.outer_cone_rad));
        }
    }
    return to;
}

std::vector<std::uint32_t> roots_of(const tinygltf::Model& model, Notes& notes) {
    std::vector<std::uint32_t> roots;
    if (model.scenes.empty()) {
        refuse("", "has no scene, so that nothing says what to show; export it with one");
    }
    if (model.defaultScene < 0 && model.scenes.size() > 1) {
        notes.add("default scene", "/scenes",
                  fmt::format("no scene is the default one: the first of {} is shown",
                              model.scenes.size()));
    }
    for (const int node :
         model.scenes.at(static_cast<std::size_t>(std::max(model.defaultScene, 0))).nodes) {
        roots.push_back(static_cast<std::uint32_t>(node));
    }
    return roots;
}

void fill(Document& to, const tinygltf::Model& from, Notes& notes) {
    std::size_t count = 0;
    for (const tinygltf::BufferView& view : from.bufferViews) {
        to.views.push_back({.buffer = static_cast<std::uint32_t>(view.buffer),
                            .offset = view.byteOffset,
                            .bytes = view.byteLength,
                            .stride = static_cast<std::uint32_t>(view.byteStride)});
    }
    if (!from.accessors.empty()) {
        to.views.pop_back();  // that of zeros
    }
    for (const tinygltf::Accessor& accessor : from.accessors) {
        to.accessors.push_back(accessor_of(accessor, to.views.size()));
    }
    for (const tinygltf::Texture& texture : from.textures) {
        to.textures.push_back(texture_of(from, texture));
    }
    for (const tinygltf::Material& material : from.materials) {
        to.materials.push_back(material_of(material, fmt::format("/materials/{}", count++), notes));
    }
    for (const tinygltf::Mesh& mesh : from.meshes) {
        to.meshes.push_back(mesh_of(mesh));
    }
    count = 0;
    for (const tinygltf::Node& node : from.nodes) {
        to.nodes.push_back(node_of(node, fmt::format("/nodes/{}", count++), notes));
    }
    count = 0;
    for (const tinygltf::Light& light : from.lights) {
        to.lights.push_back(
            light_of(light, fmt::format("/extensions/KHR_lights_punctual/lights/{}", count++)));
    }
    to.roots = roots_of(from, notes);
    to.is_quantized = std::ranges::find(from.extensionsUsed, "KHR_mesh_quantization") !=
                      from.extensionsUsed.end();
}

}  // namespace

std::uint32_t component_bytes(Component component) {
    switch (component) {
        case Component::Int8:
        case Component::Uint8:
            return 1;
        case Component::Int16:
        case Component::Uint16:
            return 2;
        default:
            return 4;
    }
}

std::uint32_t component_count(ElementType type) {
    constexpr std::array<std::uint32_t, 7> kCounts{1, 2, 3, 4, 4, 9, 16};
    return kCounts.at(static_cast<std::size_t>(type));
}

std::uint32_t element_bytes(ElementType type, Component component) {
    const std::uint32_t rows = type == ElementType::Mat2   ? 2
                               : type == ElementType::Mat3 ? 3
                               : type == ElementType::Mat4 ? 4
                                                           : 0;
    if (rows == 0) {
        return component_count(type) * component_bytes(component);
    }
    const std::uint32_t column = (rows * component_bytes(component) + 3U) & ~3U;
    return rows * column;
}

Document read_document(std::string_view text, Notes& notes) {
    json parsed = parse_json(text, notes);
    apply_rules(parsed, notes);
    check_contradictions(parsed, notes);
    take_what_is_not_shown(parsed, notes);
    Document document;
    document.buffers = take_buffers(parsed);
    document.images = take_images(parsed);
    add_view_of_zeros(parsed);
    fill(document, parse(parsed, notes), notes);
    check_document(document, notes);
    return document;
}

}  // namespace gazeloop::scene::gltf
