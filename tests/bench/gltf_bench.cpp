#include <fmt/core.h>
#include <malloc.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "runtime/scene/gltf/load_gltf.h"
#include "runtime/scene/gltf/picture.h"
#include "runtime/scene/mesh/mip_chain.h"
#include "tests/bench/bench.h"
#include "tests/bench/processor_time.h"
#include "tests/support/cache_folder.h"
#include "tests/support/encoded_pictures.h"
#include "tests/support/gltf_file.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "gltf";
constexpr const char* kCase = "1M-triangles";
constexpr unsigned kMeshes = 16;
constexpr std::uint32_t kColumns = 250;
constexpr std::uint32_t kRows = 125;  // 16 x 250 x 125 x 2 triangles
constexpr unsigned kTextures = 22;
constexpr std::uint32_t kTexels = 1024;

using scene::gltf::Bytes;

void write(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

/// Smooth with some grain: packs about as photographs do.
std::vector<std::uint8_t> texture_pixels(unsigned number) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t{kTexels} * kTexels * 3);
    std::uint32_t noise = number + 1;
    for (std::uint32_t y = 0; y < kTexels; ++y) {
        for (std::uint32_t x = 0; x < kTexels; ++x) {
            noise = noise * 1664525U + 1013904223U;
            const double wave = std::sin(0.01 * (x + number)) * std::cos(0.013 * y);
            for (unsigned c = 0; c < 3; ++c) {
                pixels.push_back(static_cast<std::uint8_t>(128.0 + 90.0 * wave * (1.0 + 0.1 * c) +
                                                           (noise >> (24U + c) & 7U)));
            }
        }
    }
    return pixels;
}

/// A wavy sheet; its primitive.
nlohmann::json add_sheet(tests::GltfFile& file, unsigned number) {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uv;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y <= kRows; ++y) {
        for (std::uint32_t x = 0; x <= kColumns; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(kColumns);
            const float v = static_cast<float>(y) / static_cast<float>(kRows);
            const float phase = 20.0F * u + static_cast<float>(number);
            positions.insert(positions.end(), {u, v, 0.02F * std::sin(phase)});
            const float slope = 0.4F * std::cos(phase);
            const float length = std::sqrt(1.0F + slope * slope);
            normals.insert(normals.end(), {-slope / length, 0.0F, 1.0F / length});
            uv.insert(uv.end(), {u, v});
            if (x > 0 && y > 0) {
                const std::uint32_t at = y * (kColumns + 1) + x;
                const std::uint32_t above = at - kColumns - 1;
                indices.insert(indices.end(), {above - 1, above, at, above - 1, at, at - 1});
            }
        }
    }
    return {{"attributes",
             {{"POSITION", file.add_positions(positions)},
              {"NORMAL", file.add_accessor("VEC3", normals)},
              {"TEXCOORD_0", file.add_accessor("VEC2", uv)}}},
            {"indices", file.add_accessor("SCALAR", indices)}};
}

/// Colour, normals and the rest of a material in textures.
nlohmann::json material_of(unsigned first_texture) {
    return {{"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", first_texture % kTextures}}},
              {"metallicRoughnessTexture", {{"index", (first_texture + 1) % kTextures}}}}},
            {"normalTexture", {{"index", (first_texture + 2) % kTextures}}}};
}

/// The scene, made once and kept.
std::filesystem::path scene_file() {
    const auto folder = std::filesystem::path(tests::cache_folder()) / "bench" / "gltf-1m";
    const auto complete = folder / "scene.gltf";
    if (std::filesystem::exists(complete)) {
        return complete;
    }
    std::filesystem::create_directories(folder);
    tests::GltfFile file;
    for (unsigned i = 0; i < kTextures; ++i) {
        const auto pixels = texture_pixels(i);
        const bool is_png = i % 2 == 0;
        const std::string name = fmt::format("{}.{}", i, is_png ? "png" : "jpg");
        write(folder / name,
              is_png ? tests::encoded_png(kTexels, kTexels, PNG_FORMAT_RGB, pixels.data())
                     : tests::encoded_jpeg(kTexels, kTexels, JCS_RGB, 3, pixels));
        file.list("images").push_back({{"uri", name}});
        file.list("textures").push_back({{"source", i}});
    }
    for (unsigned i = 0; i < kMeshes; ++i) {
        nlohmann::json primitive = add_sheet(file, i);
        primitive["material"] = i % 8;
        file.list("meshes").push_back({{"primitives", {primitive}}});
        file.list("nodes").push_back({{"mesh", i}, {"translation", {i % 4, i / 4, 0}}});
    }
    for (unsigned i = 0; i < 8; ++i) {
        file.list("materials").push_back(material_of(3 * i));
    }
    std::vector<unsigned> roots(kMeshes);
    for (unsigned i = 0; i < kMeshes; ++i) {
        roots[i] = i;
    }
    file.document["scenes"] = {{{"nodes", roots}}};
    file.document["scene"] = 0;
    write(folder / "scene.bin", file.binary);
    const std::string text = file.text();
    write(complete, std::as_bytes(std::span(text)));
    return complete;
}

std::uint64_t heap_bytes() {
    const auto heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

/// Most memory held since the last call.
std::uint64_t peak_bytes_since_last() {
    std::ifstream status("/proc/self/status");
    std::uint64_t kib = 0;
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) {
            kib = std::stoull(line.substr(6));
        }
    }
    std::ofstream("/proc/self/clear_refs") << 5;
    return kib * 1024;
}

/// What nobody who shows the scene can do without: its files read, its pictures decoded.
std::uint64_t read_and_decode(const std::filesystem::path& folder) {
    std::uint64_t texel_bytes = 0;
    const auto read = scene::gltf::files_of(folder);
    constexpr std::uint64_t kAll = std::uint64_t{1} << 40U;
    Bytes bytes;
    read("scene.bin", kAll, "", bytes);
    bytes = {};
    for (unsigned i = 0; i < kTextures; ++i) {
        read(fmt::format("{}.{}", i, i % 2 == 0 ? "png" : "jpg"), kAll, "", bytes);
        scene::mesh::Image image;
        scene::gltf::Notes notes;
        const auto header = scene::gltf::read_picture_header(bytes, "", {});
        scene::gltf::decode_picture(bytes, header, "", image, notes);
        texel_bytes += image.texels.size();
    }
    return texel_bytes;
}

scene::gltf::LoadedScene load(const std::filesystem::path& file, bool coarser_forms) {
    auto scene = scene::gltf::load_gltf(file, {.coarser_forms = coarser_forms, .threads = 1});
    if (!scene) {
        throw std::runtime_error(scene.error().message);
    }
    return std::move(*scene);
}

}  // namespace

std::vector<Figure> gltf(const Options& options) {
    if (!options.wants(kCase)) {
        return {};
    }
    const auto file = scene_file();
    std::vector<double> files_s;
    std::vector<double> load_s;
    std::vector<double> plain_load_s;
    std::vector<double> levels_s;
    std::vector<double> held;
    std::vector<double> peak;
    std::uint64_t texel_bytes = 0;
    for (unsigned round = 0; round < options.rounds; ++round) {
        double begin = process_seconds();
        texel_bytes = read_and_decode(file.parent_path());
        files_s.push_back(process_seconds() - begin);

        begin = process_seconds();
        (void)load(file, false);
        plain_load_s.push_back(process_seconds() - begin);

        malloc_trim(0);
        const std::uint64_t before = heap_bytes();
        peak_bytes_since_last();
        const std::uint64_t resident_before = peak_bytes_since_last();
        begin = process_seconds();
        const scene::gltf::LoadedScene scene = load(file, true);
        const double loaded = process_seconds();
        // Of what is uploaded then; processors share it (mesh_texture.h).
        for (const scene::mesh::Image& image : scene.data.images) {
            (void)scene::mesh::smaller_levels(image);
        }
        load_s.push_back(process_seconds() - begin);
        levels_s.push_back(process_seconds() - loaded);
        plain_load_s.back() += levels_s.back();
        held.push_back(static_cast<double>(heap_bytes() - before));
        peak.push_back(static_cast<double>(peak_bytes_since_last() - resident_before));
    }
    const auto buffers =
        static_cast<double>(std::filesystem::file_size(file.parent_path() / "scene.bin"));
    const double needed = buffers + static_cast<double>(texel_bytes) * 4.0 / 3.0;
    constexpr double kMiB = 1024.0 * 1024.0;
    return {{kBench, kCase, "files read and decoded", median(files_s), "s", "lower"},
            {kBench, kCase, "load", median(load_s), "s", "lower"},
            {kBench, kCase, "time_ratio", median(load_s) / median(files_s), "x", "lower", 1.0, 2.0},
            {kBench, kCase, "time_ratio without levels", median(plain_load_s) / median(files_s),
             "x", "lower", 1.0},
            {kBench, kCase, "smaller levels of pictures", median(levels_s), "s", "lower"},
            {kBench, kCase, "buffers and mip chains", needed / kMiB, "MiB", "lower"},
            {kBench, kCase, "memory_ratio", median(held) / needed, "x", "lower", std::nullopt, 1.3},
            {kBench, kCase, "peak_memory_ratio", median(peak) / needed, "x", "lower"}};
}

}  // namespace gazeloop::bench
