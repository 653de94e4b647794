#include "runtime/scene/gltf/json_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

namespace gazeloop::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNesting = 64;
constexpr std::size_t kMostText = std::size_t{1} << 30U;
/// Beyond these, doubles are no longer exact.
constexpr double kMostInteger = 9007199254740991.0;
/// tinygltf keeps the offsets of sparse accessors in an int.
constexpr double kMostInt = 2147483647.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::array<std::string_view, 7> kSupported{
    "KHR_lights_punctual",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",    "KHR_materials_transmission",
    "KHR_materials_unlit",  "KHR_mesh_quantization",
    "KHR_texture_transform"};

// ---- rules --------------------------------------------------------------------------------------

struct Shape;

/// What a value may be.
struct Rule {
    enum class Kind : std::uint8_t { Boolean, Integer, Number, Text, Index, Object, List, Map };
    Kind kind = Kind::Boolean;
    double min = -kInfinity;
    double max = kInfinity;
    bool above_min = false;                 ///< min itself is not allowed
    std::vector<double> numbers{};          ///< the only ones; empty: all
    std::vector<std::string_view> words{};  ///< the only ones; empty: all
    std::string_view list{};                ///< Index: of which of the document's lists
    const Shape* shape = nullptr;           ///< Object
    std::shared_ptr<const Rule> element{};  ///< List, Map
    std::vector<std::size_t> lengths{};     ///< List: the only ones; empty: 1 or more
};

struct Property {
    std::string_view name;
    Rule rule;
    bool required = false;
};

struct Shape {
    std::vector<Property> properties;
    /// Supported extensions that may be here.
    std::vector<std::pair<std::string_view, const Shape*>> extensions{};
};

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
    static const Shape shape{{}};
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
    static const Shape shape{{}};
    return shape;
}

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

// ---- holding a document against them ------------------------------------------------------------

/// At most 200 characters of what a file says, for messages.
std::string cited(const json& value) {
    constexpr std::size_t kMost = 200;
    if (value.is_object() || value.is_array()) {
        return value.is_object() ? "an object" : fmt::format("a list of {}", value.size());
    }
    const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    return text.size() > kMost ? fmt::format("{:.{}}...", text, kMost) : text;
}

std::size_t length_of(const json& document, std::string_view list) {
    const json::json_pointer pointer(fmt::format("/{}", list));
    const json* const found = document.contains(pointer) ? &document.at(pointer) : nullptr;
    return found != nullptr && found->is_array() ? found->size() : 0;
}

class RuleCheck {
  public:
    RuleCheck(const json& document, Notes& notes) : notes_(notes) {
        for (const std::string_view list :
             {"accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes",
              "nodes", "samplers", "scenes", "skins", "textures",
              "extensions/KHR_lights_punctual/lights"}) {
            lengths_[list] = length_of(document, list);
        }
        if (const auto used = document.find("extensionsUsed");
            used != document.end() && used->is_array()) {
            for (const json& name : *used) {
                if (name.is_string()) {
                    declared_.insert(name.get<std::string>());
                }
            }
        }
    }

    void check(json& value, const Rule& rule) {
        switch (rule.kind) {
            case Boolean:
                expect(value.is_boolean(), value, "true or false");
                break;
            case Integer:
                check_integer(value, rule);
                break;
            case Number:
                check_number(value, rule);
                break;
            case Text:
                expect(value.is_string(), value, "a string");
                expect(rule.words.empty() ||
                           std::ranges::find(rule.words, value.get_ref<const std::string&>()) !=
                               rule.words.end(),
                       value, fmt::format("one of {}", fmt::join(rule.words, ", ")));
                break;
            case Index:
                check_index(value, rule);
                break;
            case Object:
                expect(value.is_object(), value, "an object");
                check_object(value, *rule.shape);
                break;
            case List:
                check_list(value, rule);
                break;
            case Map:
                expect(value.is_object() && !value.empty(), value, "an object that is not empty");
                for (auto& [name, element] : value.items()) {
                    inside(name, [&] { check(element, *rule.element); });
                }
                break;
        }
    }

    /// The names of extensions that stand somewhere and have no effect.
    [[nodiscard]] const std::map<std::string, std::string>& unsupported() const {
        return unsupported_;
    }

  private:
    template <typename Step>
    void inside(std::string_view name, Step step) {
        const std::size_t before = place_.size();
        place_ += '/';
        for (const char c : name) {  // RFC 6901
            c == '~' ? place_ += "~0" : c == '/' ? place_ += "~1" : place_ += c;
        }
        step();
        place_.resize(before);
    }

    void expect(bool held, const json& value, std::string_view wanted) const {
        if (!held) {
            refuse(place_, fmt::format("is {}, must be {}", cited(value), wanted));
        }
    }

    static bool is_within(double number, const Rule& rule) {
        return std::isfinite(number) && number <= rule.max &&
               (rule.above_min ? number > rule.min : number >= rule.min);
    }

    void check_integer(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a whole number");
        const double number = value.get<double>();
        expect(number == std::floor(number) && std::abs(number) <= kMostInteger, value,
               "a whole number");
        if (!rule.numbers.empty()) {
            expect(std::ranges::find(rule.numbers, number) != rule.numbers.end(), value,
                   fmt::format("one of {}", fmt::join(rule.numbers, ", ")));
        } else {
            expect(is_within(number, rule), value,
                   fmt::format("from {:.0f} to {:.0f}", rule.min, rule.max));
        }
        store(value, number);
    }

    static void store(json& value, double whole) {
        if (whole >= 0.0) {
            value = static_cast<std::uint64_t>(whole);
        } else {
            value = static_cast<std::int64_t>(whole);
        }
    }

    void check_number(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a number");
        const double number = value.get<double>();
        // What is used in single precision must be finite there.
        constexpr double kLargest = std::numeric_limits<float>::max();
        expect(is_within(number, rule) && std::abs(number) <= kLargest, value,
               fmt::format("{} {} and at most {}", rule.above_min ? "above" : "at least",
                           std::max(rule.min, -kLargest), std::min(rule.max, kLargest)));
        value = number;
    }

    void check_index(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a whole number");
        const std::size_t length = lengths_.at(rule.list);
        const double number = value.get<double>();
        if (!(number >= 0.0 && number < static_cast<double>(length) &&
              number == std::floor(number))) {
            refuse(place_, fmt::format("{} is no index of {}, of which there are {}", cited(value),
                                       rule.list, length));
        }
        store(value, number);
    }

    void check_list(json& value, const Rule& rule) {
        expect(value.is_array(), value, "a list");
        const bool length_fits =
            rule.lengths.empty()
                ? !value.empty()
                : std::ranges::find(rule.lengths, value.size()) != rule.lengths.end();
        expect(length_fits, value,
               rule.lengths.empty()
                   ? "a list that is not empty"
                   : fmt::format("a list of {} numbers", fmt::join(rule.lengths, " or ")));
        for (std::size_t i = 0; i < value.size(); ++i) {
            inside(std::to_string(i), [&] { check(value[i], *rule.element); });
        }
    }

    void check_object(json& value, const Shape& shape) {
        if (&shape == &unread()) {
            value = json::object();
            return;
        }
        for (const Property& property : shape.properties) {
            const auto found = value.find(property.name);
            if (found != value.end()) {
                inside(property.name, [&] { check(*found, property.rule); });
            } else if (property.required) {
                refuse(place_, fmt::format("lacks '{}'", property.name));
            }
        }
        for (auto at = value.begin(); at != value.end();) {
            at = keeps(at.key(), at.value(), shape) ? std::next(at) : value.erase(at);
        }
    }

    bool keeps(const std::string& name, json& value, const Shape& shape) {
        if (std::ranges::find(shape.properties, name, &Property::name) != shape.properties.end()) {
            return true;
        }
        if (name == "extensions") {
            inside(name, [&] { check_extensions(value, shape); });
            return true;
        }
        if (name != "extras") {
            notes_.add("unknown " + name, place_ + "/" + name,
                       fmt::format("'{}' has no meaning here: left out", name));
        }
        return false;
    }

    void check_extensions(json& value, const Shape& shape) {
        expect(value.is_object(), value, "an object");
        for (auto at = value.begin(); at != value.end();) {
            const std::string& name = at.key();
            const auto known = std::ranges::find(shape.extensions, name,
                                                 [](const auto& entry) { return entry.first; });
            inside(name, [&] {
                expect(at.value().is_object(), at.value(), "an object");
                if (!declared_.contains(name)) {
                    notes_.add("undeclared " + name, place_,
                               fmt::format("{} is not listed in extensionsUsed", name));
                }
                if (known != shape.extensions.end()) {
                    check_object(at.value(), *known->second);
                } else {
                    unsupported_.try_emplace(name, place_);
                }
            });
            at = known != shape.extensions.end() ? std::next(at) : value.erase(at);
        }
    }

    Notes& notes_;
    std::map<std::string_view, std::size_t> lengths_;
    std::set<std::string, std::less<>> declared_;
    std::map<std::string, std::string> unsupported_;
    std::string place_;
};

// ---- version and extensions ---------------------------------------------------------------------

void check_version(const json& document) {
    const std::string version = document.at("asset").at("version").get<std::string>();
    const std::string needed = document.at("asset").contains("minVersion")
                                   ? document.at("asset").at("minVersion").get<std::string>()
                                   : "";
    const bool is_2 = version.starts_with("2.") && version.size() > 2 &&
                      std::all_of(version.begin() + 2, version.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
    if (!is_2) {
        refuse("/asset/version",
               fmt::format("is {}: only glTF 2 can be read; export the scene as glTF 2.0",
                           cited(version)));
    }
    if (!needed.empty() && needed != "2.0") {
        refuse("/asset/minVersion",
               fmt::format("asks for glTF {}: only 2.0 can be read; export the scene as glTF 2.0",
                           cited(needed)));
    }
}

std::string_view remedy_for(std::string_view extension) {
    if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
        extension == "KHR_meshopt_compression") {
        return "export the scene without mesh compression (gltf-transform copy does)";
    }
    if (extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" ||
        extension == "EXT_texture_avif") {
        return "export its textures as PNG or JPEG";
    }
    return "export the scene without it";
}

/// The names in a list of the document, at the place where they stand.
template <typename Step>
void for_each_name(const json& document, const char* list, Step step) {
    if (const auto names = document.find(list); names != document.end()) {
        for (std::size_t i = 0; i < names->size(); ++i) {
            step((*names)[i].get<std::string>(), fmt::format("/{}/{}", list, i));
        }
    }
}

/// Before anything else, since a file that needs another extension breaks other rules because of
/// it.
void check_required(const json& document, Notes& notes) {
    const auto required = document.find("extensionsRequired");
    if (required == document.end() || !required->is_array()) {
        return;  // the rules say what is wrong with it
    }
    std::set<std::string> used;
    if (const auto list = document.find("extensionsUsed");
        list != document.end() && list->is_array()) {
        for (const json& name : *list) {
            if (name.is_string()) {
                used.insert(name.get<std::string>());
            }
        }
    }
    for (std::size_t i = 0; i < required->size(); ++i) {
        const std::string place = fmt::format("/extensionsRequired/{}", i);
        if (!(*required)[i].is_string()) {
            continue;
        }
        const auto name = (*required)[i].get<std::string>();
        if (!is_supported_extension(name)) {
            refuse(place, fmt::format("the file requires {}, which is not supported; {}",
                                      cited(name), remedy_for(name)));
        }
        if (!used.contains(name)) {
            notes.add("required but unused " + name, place,
                      fmt::format("{} is not listed in extensionsUsed", name));
        }
    }
}

/// Brackets are counted outside strings, so that what reads the text may recurse.
void check_nesting(std::string_view text) {
    std::size_t depth = 0;
    bool is_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_text) {
            i += c == '\\' ? 1 : 0;
            is_text = c != '"';
        } else if (c == '"') {
            is_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMostNesting) {
                refuse("", fmt::format("its JSON is nested deeper than {} at byte {}: this is no "
                                       "scene that a program writes",
                                       kMostNesting, i));
            }
        } else if (c == '}' || c == ']') {
            depth -= depth > 0 ? 1 : 0;
        }
    }
}

/// Names that one object has twice, of which the parser keeps the last in silence. In a pass of its
/// own: the parser's callback looks at all that came before in a list at the end of each object.
class DuplicateNames final : public nlohmann::json_sax<json> {
  public:
    explicit DuplicateNames(Notes& notes) : notes_(notes) {}

    bool start_object(std::size_t /*elements*/) override {
        names_.emplace_back();
        return true;
    }
    bool key(string_t& name) override {
        if (!names_.back().insert(name).second) {
            notes_.add(
                "duplicate " + name, "",
                fmt::format("one object has two members {}: the last one counts", cited(name)));
        }
        return true;
    }
    bool end_object() override {
        names_.pop_back();
        return true;
    }
    bool null() override { return true; }
    bool boolean(bool /*value*/) override { return true; }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool string(string_t& /*value*/) override { return true; }
    bool binary(binary_t& /*value*/) override { return true; }
    bool start_array(std::size_t /*elements*/) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;  // json::parse() has thrown it before
    }

  private:
    Notes& notes_;
    std::vector<std::set<std::string, std::less<>>> names_;
};

}  // namespace

bool is_supported_extension(std::string_view name) {
    return std::ranges::find(kSupported, name) != kSupported.end();
}

json parse_json(std::string_view text, Notes& notes) {
    if (text.size() > kMostText) {
        refuse("", fmt::format("its JSON has {} bytes, more than 1 GiB: keep buffers in .bin files "
                               "or a .glb",
                               text.size()));
    }
    if (text.starts_with("\xEF\xBB\xBF")) {
        notes.add("byte order mark", "",
                  "starts with a byte order mark, which the standard forbids");
    }
    check_nesting(text);
    try {
        json document = json::parse(text);
        DuplicateNames duplicates(notes);
        json::sax_parse(text, &duplicates);
        if (!document.is_object()) {
            refuse("", fmt::format("its JSON is {}, must be an object", cited(document)));
        }
        return document;
    } catch (const json::exception& error) {  // bad syntax, or a number that no double holds
        refuse("", fmt::format("is not JSON: {:.200}", error.what()));
    }
}

void apply_rules(json& document, Notes& notes) {
    check_required(document, notes);
    if (!document.contains("asset")) {
        refuse("", "lacks 'asset': this is no glTF file");
    }
    RuleCheck check(document, notes);
    check.check(document, object(document_shape()));
    check_version(document);

    std::map<std::string, std::string> unsupported = check.unsupported();
    for_each_name(document, "extensionsUsed", [&](const std::string& name, const std::string& at) {
        if (!is_supported_extension(name)) {
            unsupported.try_emplace(name, at);
        }
    });
    for (const auto& [name, at] : unsupported) {
        notes.add("extension " + name, at,
                  is_supported_extension(name)
                      ? fmt::format("{} has no meaning here: left out", name)
                      : fmt::format("{} is not supported: shown without it", name));
    }
}

}  // namespace gazeloop::scene::gltf
