#include "runtime/scene/gltf/document_shape.h"

namespace gazeloop::scene::gltf {
namespace {

/// tinygltf keeps the offsets of sparse accessors in an int.
constexpr double kMostInt = 2147483647.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using enum Rule::Kind;

Rule boolean() { return {.kind = Boolean}; }
Rule text() { return {.kind = Text}; }
Rule word(std::vector<std::string_view> words) { return {.kind = Text, .words = std::move(words)}; }
Rule integer(double min, double max = kMostInteger) {
    return {.kind = Integer, .min = min, .max = max};
}
Rule code(std::vector<double> numbers) { return {.kind = Integer, .numbers = std::move(numbers)}; }
Rule number(double min = -kInfinity, double max = kInfinity) {
    return {.kind = Number, .min = min, .max = max};
}
Rule index(std::string_view list) { return {.kind = Index, .list = list}; }
Rule object(const Shape& shape) { return {.kind = Object, .shape = &shape}; }
Rule list(Rule element, std::vector<std::size_t> lengths = {}) {
    return {.kind = List,
            .element = std::make_shared<const Rule>(std::move(element)),
            .lengths = std::move(lengths)};
}
Rule map(Rule element) {
    return {.kind = Map, .element = std::make_shared<const Rule>(std::move(element))};
}
Rule objects(const Shape& shape) { return list(object(shape)); }

constexpr bool kRequired = true;

const Shape& asset() {
    static const Shape shape{{{"version", text(), kRequired},
                              {"minVersion", text()},
                              {"generator", text()},
                              {"copyright", text()}}};
    return shape;
}

const Shape& buffer() {
    static const Shape shape{
        {{"uri", text()}, {"byteLength", integer(1), kRequired}, {"name", text()}}};
    return shape;
}

const Shape& buffer_view() {
    static const Shape shape{{{"buffer", index("buffers"), kRequired},
                              {"byteOffset", integer(0)},
                              {"byteLength", integer(1), kRequired},
                              {"byteStride", integer(4, 252)},
                              {"target", code({34962, 34963})},
                              {"name", text()}}};
    return shape;
}

const Shape& sparse_indices() {
    static const Shape shape{{{"bufferView", index("bufferViews"), kRequired},
                              {"byteOffset", integer(0, kMostInt)},
                              {"componentType", code({5121, 5123, 5125}), kRequired}}};
    return shape;
}

const Shape& sparse_values() {
    static const Shape shape{
        {{"bufferView", index("bufferViews"), kRequired}, {"byteOffset", integer(0, kMostInt)}}};
    return shape;
}

const Shape& sparse() {
    static const Shape shape{{{"count", integer(1, kMostInt), kRequired},
                              {"indices", object(sparse_indices()), kRequired},
                              {"values", object(sparse_values()), kRequired}}};
    return shape;
}

const Shape& accessor() {
    static const Shape shape{
        {{"bufferView", index("bufferViews")},
         {"byteOffset", integer(0)},
         {"componentType", code({5120, 5121, 5122, 5123, 5125, 5126}), kRequired},
         {"normalized", boolean()},
         {"count", integer(1), kRequired},
         {"type", word({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}), kRequired},
         {"max", list(number(), {1, 2, 3, 4, 9, 16})},
         {"min", list(number(), {1, 2, 3, 4, 9, 16})},
         {"sparse", object(sparse())},
         {"name", text()}}};
    return shape;
}

const Shape& image() {
    static const Shape shape{{{"uri", text()},
                              {"mimeType", text()},
                              {"bufferView", index("bufferViews")},
                              {"name", text()}}};
    return shape;
}

const Shape& sampler() {
    static const Shape shape{{{"magFilter", code({9728, 9729})},
                              {"minFilter", code({9728, 9729, 9984, 9985, 9986, 9987})},
                              {"wrapS", code({33071, 33648, 10497})},
                              {"wrapT", code({33071, 33648, 10497})},
                              {"name", text()}}};
    return shape;
}

const Shape& texture() {
    static const Shape shape{
        {{"sampler", index("samplers")}, {"source", index("images")}, {"name", text()}}};
    return shape;
}

const Shape& texture_transform() {
    static const Shape shape{{{"offset", list(number(), {2})},
                              {"rotation", number()},
                              {"scale", list(number(), {2})},
                              {"texCoord", integer(0, kMostInt)}}};
    return shape;
}

/// A texture's use, with what this use has beside: "scale", "strength" or nothing.
Shape texture_use(std::vector<Property> beside) {
    beside.push_back({"index", index("textures"), kRequired});
    beside.push_back({"texCoord", integer(0, kMostInt)});
    return {std::move(beside), {{"KHR_texture_transform", &texture_transform()}}};
}
const Shape& plain_texture() {
    static const Shape shape = texture_use({});
    return shape;
}
const Shape& normal_texture() {
    static const Shape shape = texture_use({{"scale", number()}});
    return shape;
}
const Shape& occlusion_texture() {
    static const Shape shape = texture_use({{"strength", number(0, 1)}});
    return shape;
}

const Shape& metallic_roughness() {
    static const Shape shape{{{"baseColorFactor", list(number(0, 1), {4})},
                              {"baseColorTexture", object(plain_texture())},
                              {"metallicFactor", number(0, 1)},
                              {"roughnessFactor", number(0, 1)},
                              {"metallicRoughnessTexture", object(plain_texture())}}};
    return shape;
}

const Shape& emissive_strength() {
    static const Shape shape{{{"emissiveStrength", number(0)}}};
    return shape;
}

const Shape& transmission() {
    // Its texture is left out, as a property that is not known here.
    static const Shape shape{{{"transmissionFactor", number(0, 1)}}};
    return shape;
}
const Shape& refraction() {
    static const Shape shape{{{"ior", number(0)}}};
    return shape;
}
const Shape& unlit() {
    static const Shape shape{.properties = {}, .is_read = false};
    return shape;
}

const Shape& material() {
    static const Shape shape{{{"name", text()},
                              {"pbrMetallicRoughness", object(metallic_roughness())},
                              {"normalTexture", object(normal_texture())},
                              {"occlusionTexture", object(occlusion_texture())},
                              {"emissiveTexture", object(plain_texture())},
                              {"emissiveFactor", list(number(0, 1), {3})},
                              {"alphaMode", word({"OPAQUE", "MASK", "BLEND"})},
                              {"alphaCutoff", number(0)},
                              {"doubleSided", boolean()}},
                             {{"KHR_materials_emissive_strength", &emissive_strength()},
                              {"KHR_materials_ior", &refraction()},
                              {"KHR_materials_transmission", &transmission()},
                              {"KHR_materials_unlit", &unlit()}}};
    return shape;
}

const Shape& primitive() {
    static const Shape shape{{{"attributes", map(index("accessors")), kRequired},
                              {"indices", index("accessors")},
                              {"material", index("materials")},
                              {"mode", integer(0, 6)},
                              {"targets", list(map(index("accessors")))}}};
    return shape;
}

const Shape& mesh() {
    static const Shape shape{{{"primitives", objects(primitive()), kRequired},
                              {"weights", list(number())},
                              {"name", text()}}};
    return shape;
}

const Shape& light_use() {
    static const Shape shape{
        {{"light", index("extensions/KHR_lights_punctual/lights"), kRequired}}};
    return shape;
}

const Shape& node() {
    static const Shape shape{{{"camera", index("cameras")},
                              {"children", list(index("nodes"))},
                              {"skin", index("skins")},
                              {"matrix", list(number(), {16})},
                              {"mesh", index("meshes")},
                              {"rotation", list(number(-1, 1), {4})},
                              {"scale", list(number(), {3})},
                              {"translation", list(number(), {3})},
                              {"weights", list(number())},
                              {"name", text()}},
                             {{"KHR_lights_punctual", &light_use()}}};
    return shape;
}

const Shape& scene() {
    static const Shape shape{{{"nodes", list(index("nodes"))}, {"name", text()}}};
    return shape;
}

constexpr double kHalfPi = 1.5707963267948966;

const Shape& spot() {
    static const Shape shape{
        {{"innerConeAngle", number(0, kHalfPi)},
         {"outerConeAngle", {.kind = Number, .min = 0, .max = kHalfPi, .above_min = true}}}};
    return shape;
}

const Shape& light() {
    static const Shape shape{{{"name", text()},
                              {"color", list(number(0, 1), {3})},
                              {"intensity", number(0)},
                              {"type", word({"directional", "point", "spot"}), kRequired},
                              {"spot", object(spot())},
                              {"range", {.kind = Number, .min = 0, .above_min = true}}}};
    return shape;
}

const Shape& lights() {
    static const Shape shape{{{"lights", objects(light()), kRequired}}};
    return shape;
}

/// What is not shown, and therefore not looked into: cameras, skins, animations.
const Shape& unread() {
    static const Shape shape{.properties = {}, .is_read = false};
    return shape;
}

}  // namespace

const Shape& document_shape() {
    static const Shape shape{{{"asset", object(asset()), kRequired},
                              {"extensionsUsed", list(text())},
                              {"extensionsRequired", list(text())},
                              {"buffers", objects(buffer())},
                              {"bufferViews", objects(buffer_view())},
                              {"accessors", objects(accessor())},
                              {"images", objects(image())},
                              {"samplers", objects(sampler())},
                              {"textures", objects(texture())},
                              {"materials", objects(material())},
                              {"meshes", objects(mesh())},
                              {"nodes", objects(node())},
                              {"scenes", objects(scene())},
                              {"scene", index("scenes")},
                              {"cameras", objects(unread())},
                              {"skins", objects(unread())},
                              {"animations", objects(unread())}},
                             {{"KHR_lights_punctual", &lights()}}};
    return shape;
}

}  // namespace gazeloop::scene::gltf
