#pragma once

#include <gtest/gtest.h>

#include <map>

#include "runtime/scene/gltf/load_gltf.h"
#include "tests/support/gltf_file.h"

namespace gazeloop::tests {

/// Files beside a scene that is in memory.
using FilesBeside = std::map<std::string, std::vector<std::byte>>;

inline Expected<scene::gltf::LoadedScene> try_to_load(std::span<const std::byte> file,
                                                      const FilesBeside& beside,
                                                      scene::gltf::LoadOptions options = {}) {
    options.threads = options.threads == 0 ? 1 : options.threads;
    const scene::gltf::ReadFile read_file = [&](const std::string& path, std::uint64_t most_bytes,
                                                const std::string& place,
                                                scene::gltf::Bytes& bytes) {
        const auto found = beside.find(path);
        if (found == beside.end()) {
            scene::gltf::refuse(place, path + " is not there");
        }
        bytes = found->second;
        bytes.resize(std::min<std::uint64_t>(bytes.size(), most_bytes));
    };
    return scene::gltf::load_gltf(file, "scene.gltf", read_file, options);
}

inline Expected<scene::gltf::LoadedScene> try_to_load(
    const GltfFile& file, FilesBeside beside = {}, const scene::gltf::LoadOptions& options = {}) {
    beside.try_emplace("scene.bin", file.binary);
    const std::string text = file.text();
    return try_to_load(std::as_bytes(std::span(text)), beside, options);
}

/// The scene; a test fails that expects one and gets an error.
inline scene::gltf::LoadedScene loaded(const GltfFile& file, FilesBeside beside = {},
                                       const scene::gltf::LoadOptions& options = {}) {
    auto scene = try_to_load(file, std::move(beside), options);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? std::move(*scene) : scene::gltf::LoadedScene{};
}

/// Why it is refused; "" where it is not.
inline std::string refusal_of(const GltfFile& file, FilesBeside beside = {},
                              const scene::gltf::LoadOptions& options = {}) {
    const auto scene = try_to_load(file, std::move(beside), options);
    if (scene) {
        return "";
    }
    EXPECT_EQ(scene.error().kind, ErrorKind::BadInput);
    return scene.error().message;
}

/// All notes, one per line.
inline std::string notes_of(const scene::gltf::LoadedScene& scene) {
    std::string lines;
    for (const scene::gltf::Note& note : scene.notes) {
        lines += scene::gltf::note_text(note) + "\n";
    }
    return lines;
}

}  // namespace gazeloop::tests
