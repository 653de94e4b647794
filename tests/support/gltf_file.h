#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace gazeloop::tests {

/// A small glTF file that a test makes and then spoils: its JSON is `document`, and its first
/// buffer is `binary` ("scene.bin", or the chunk of a .glb).
struct GltfFile {
    nlohmann::json document{{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> binary;

    /// A view of these bytes, at a multiple of four; its index.
    std::size_t add_view(std::span<const std::byte> bytes) {
        binary.resize((binary.size() + 3) / 4 * 4);
        nlohmann::json& views = list("bufferViews");
        views.push_back(
            {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        return views.size() - 1;
    }

    template <typename Number>
    std::size_t add_view_of(const std::vector<Number>& numbers) {
        return add_view(std::as_bytes(std::span(numbers)));
    }

    /// An accessor of numbers that lie without gaps; its index.
    template <typename Number>
    std::size_t add_accessor(const std::string& type, const std::vector<Number>& numbers) {
        const std::size_t view = add_view_of(numbers);
        const std::size_t each = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
        nlohmann::json& accessors = list("accessors");
        accessors.push_back({{"bufferView", view},
                             {"componentType", component_of<Number>()},
                             {"count", numbers.size() / each},
                             {"type", type}});
        return accessors.size() - 1;
    }

    /// The same, as positions must be: with min and max.
    template <typename Number>
    std::size_t add_positions(const std::vector<Number>& numbers) {
        const std::size_t index = add_accessor("VEC3", numbers);
        nlohmann::json low = nlohmann::json::array();
        nlohmann::json high = nlohmann::json::array();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Number min = numbers[axis];
            Number max = numbers[axis];
            for (std::size_t i = axis; i < numbers.size(); i += 3) {
                min = std::min(min, numbers[i]);
                max = std::max(max, numbers[i]);
            }
            low.push_back(min);
            high.push_back(max);
        }
        document["accessors"][index]["min"] = low;
        document["accessors"][index]["max"] = high;
        return index;
    }

    /// A list of the document, made where there is none.
    nlohmann::json& list(const char* name) {
        nlohmann::json& found = document[name];
        if (found.is_null()) {
            found = nlohmann::json::array();
        }
        return found;
    }

    /// A .gltf whose buffer is a file.
    [[nodiscard]] std::string text() const {
        nlohmann::json complete = document;
        if (!binary.empty() && !complete.contains("buffers")) {
            complete["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", binary.size()}}};
        }
        return complete.dump();
    }

    [[nodiscard]] std::vector<std::byte> glb() const {
        nlohmann::json complete = document;
        if (!binary.empty() && !complete.contains("buffers")) {
            complete["buffers"] = {{{"byteLength", binary.size()}}};
        }
        std::string json = complete.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::vector<std::byte> chunk = binary;
        chunk.resize((chunk.size() + 3) / 4 * 4);
        std::vector<std::byte> file;
        append_word(file, 0x46546C67);
        append_word(file, 2);
        append_word(file, static_cast<std::uint32_t>(12 + 8 + json.size() +
                                                     (chunk.empty() ? 0 : 8 + chunk.size())));
        append_word(file, static_cast<std::uint32_t>(json.size()));
        append_word(file, 0x4E4F534A);
        const auto text_bytes = std::as_bytes(std::span(json));
        file.insert(file.end(), text_bytes.begin(), text_bytes.end());
        if (!chunk.empty()) {
            append_word(file, static_cast<std::uint32_t>(chunk.size()));
            append_word(file, 0x004E4942);
            file.insert(file.end(), chunk.begin(), chunk.end());
        }
        return file;
    }

    static void append_word(std::vector<std::byte>& to, std::uint32_t word) {
        for (unsigned i = 0; i < 4; ++i) {
            to.push_back(static_cast<std::byte>(word >> (8 * i)));
        }
    }

  private:
    template <typename Number>
    static int component_of() {
        return std::is_same_v<Number, std::int8_t>     ? 5120
               : std::is_same_v<Number, std::uint8_t>  ? 5121
               : std::is_same_v<Number, std::int16_t>  ? 5122
               : std::is_same_v<Number, std::uint16_t> ? 5123
               : std::is_same_v<Number, std::uint32_t> ? 5125
                                                       : 5126;
    }
};

/// One triangle in the plane z = 0 with corners (0,0), (1,0), (0,1), of the default material.
inline GltfFile one_triangle() {
    GltfFile file;
    const std::size_t positions =
        file.add_positions<float>({0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F});
    file.document["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    file.document["nodes"] = {{{"mesh", 0}}};
    file.document["scenes"] = {{{"nodes", {0}}}};
    file.document["scene"] = 0;
    return file;
}

}  // namespace gazeloop::tests
