#include "runtime/scene/gltf/load_gltf.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <new>
#include <set>
#include <thread>

#include "runtime/memory/large_pages.h"
#include "runtime/scene/gltf/container.h"
#include "runtime/scene/gltf/detail_levels.h"
#include "runtime/scene/gltf/geometry.h"
#include "runtime/scene/gltf/material_images.h"
#include "runtime/scene/gltf/meshopt_memory.h"
#include "runtime/scene/gltf/picture.h"
#include "runtime/scene/gltf/scene_walk.h"
#include "runtime/scene/gltf/shape_list.h"

namespace gazeloop::scene::gltf {
namespace {

/// No more than a picture's file may have; those that state a size are held to the budget too.
constexpr std::uint64_t kMostPictureFileBytes = std::uint64_t{1} << 30U;

/// A primitive as the file has it: a shape under a material.
struct Piece {
    std::uint32_t geometry = 0;
    std::uint32_t material = 0;
    auto operator<=>(const Piece&) const = default;
};

/// What the scene is made of before anything is decoded: each thing once.
struct Plan {
    std::vector<GeometryKey> geometries;
    std::vector<std::string> geometry_places;
    std::vector<mesh::Material> materials;
    std::vector<UsedImage> images;
    std::map<std::uint32_t, std::vector<Piece>> meshes;  ///< by mesh of the document
};

Plan plan_of(const Document& document, const ShownNodes& shown, Notes& notes) {
    Plan plan;
    MaterialImages images(document, notes);
    std::map<GeometryKey, std::uint32_t> geometries;
    std::map<std::optional<std::uint32_t>, std::pair<std::uint32_t, ShownMaterial>> materials;
    for (const PlacedMesh& placed : shown.meshes) {
        const auto [pieces, is_new] = plan.meshes.try_emplace(placed.mesh);
        if (!is_new) {
            continue;
        }
        const auto& primitives = document.meshes.at(placed.mesh).primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const PrimitiveSource& primitive = primitives[p];
            auto material = materials.find(primitive.material);
            if (material == materials.end()) {
                const auto index = static_cast<std::uint32_t>(plan.materials.size());
                material = materials
                               .emplace(primitive.material,
                                        std::pair{index, images.show(primitive.material)})
                               .first;
                plan.materials.push_back(material->second.second.material);
            }
            const GeometryKey key{.attributes = primitive.attributes,
                                  .indices = primitive.indices,
                                  .mode = primitive.mode,
                                  .uv_sets = material->second.second.uv_sets,
                                  .tangent_slot = material->second.second.tangent_slot};
            const auto [geometry, is_new_shape] =
                geometries.try_emplace(key, static_cast<std::uint32_t>(plan.geometries.size()));
            if (is_new_shape) {
                plan.geometries.push_back(key);
                plan.geometry_places.push_back(
                    fmt::format("/meshes/{}/primitives/{}", placed.mesh, p));
            }
            pieces->second.push_back({geometry->second, material->second.first});
        }
    }
    plan.images = images.images();
    return plan;
}

/// What a thread keeps from job to job: the faults of fresh memory take longer than its use.
struct ThreadMemory {
    MeshoptMemory meshopt;
    Bytes picture_file;
};

/// Runs jobs 0 to count - 1 on several threads. Throws what the first of those that failed threw.
template <typename Job>
void run_jobs(std::size_t count, const LoadOptions& options, Job job) {
    std::atomic<std::size_t> next = 0;
    std::size_t done = 0;
    std::size_t first_failed = count;
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
        ThreadMemory kept;
        for (std::size_t i = next++; i < count; i = next++) {
            std::exception_ptr caught;
            try {
                job(i, kept);
            } catch (...) {
                caught = std::current_exception();
            }
            const std::scoped_lock lock(mutex);
            if (caught && i < first_failed) {
                first_failed = i;
                failure = caught;
                next = count;  // those before it are under way, and what follows is not needed
            } else if (!caught && options.progress) {
                options.progress(++done, count);
            }
        }
    };
    const std::size_t wanted =
        options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min(wanted, count); ++i) {
            others.emplace_back(work);
        }
        work();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

/// Eight squares a side, magenta and black, that nobody takes for the scene's own.
void make_marked(mesh::Image& image) {
    constexpr std::uint32_t kSide = 8;
    image.width = kSide;
    image.height = kSide;
    image.format = mesh::TexelFormat::Rgba8;
    image.texels.clear();
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const bool is_lit = (i + i / kSide) % 2 == 0;
        const auto level = is_lit ? std::byte{255} : std::byte{0};
        image.texels.insert(image.texels.end(), {level, std::byte{0}, level, std::byte{255}});
    }
}

class Loader {
  public:
    Loader(const ReadFile& read_file, const LoadOptions& options)
        : read_file_(read_file), options_(options), budget_(options.limits) {}

    LoadedScene load(std::span<const std::byte> file) {
        budget_.take(file.size(), "", "its bytes");
        const Container container = open_container(file, notes_);
        const Document document = read_document(container.json, notes_);
        const ShownNodes shown = walk_scene(document, notes_);
        const Plan plan = plan_of(document, shown, notes_);
        const std::vector<Buffer> buffers =
            read_buffers(document, container.binary, read_file_, budget_, notes_);

        LoadedScene scene;
        reserve(document, plan, scene.data);
        ShapeList shapes(plan.geometries.size(), scene.data);
        scene.data.images.resize(plan.images.size());
        std::vector<Notes> notes(plan.images.size() + plan.geometries.size());
        const Source source{document, buffers};
        run_jobs(notes.size(), options_, [&](std::size_t i, ThreadMemory& kept) {
            if (i < plan.images.size()) {
                scene.data.images[i] =
                    read_image(source, plan.images[i], kept.picture_file, notes[i]);
            } else {
                const std::size_t g = i - plan.images.size();
                Geometry geometry = read_geometry(source, plan.geometries[g],
                                                  plan.geometry_places[g], budget_, notes[i]);
                if (options_.coarser_forms) {
                    add_coarser_forms(geometry);
                }
                shapes.put(g, std::move(geometry));
            }
        });
        for (const Notes& part : notes) {
            for (const Note& note : part.all()) {
                notes_.add(note);
            }
        }
        scene.data.materials = plan.materials;
        scene.data.lights = shown.lights;
        scene.data.viewpoints = shown.viewpoints;
        place(plan, shown, shapes, scene.data);
        if (scene.data.instances.empty()) {
            refuse("", "shows no triangle, so that there is nothing to render");
        }
        scene.notes = notes_.all();
        return scene;
    }

  private:
    /// `file`: memory for the picture's, if it has one.
    mesh::Image read_image(const Source& source, const UsedImage& used, Bytes& file, Notes& notes) {
        const ImageSource& from = source.document.images.at(used.image);
        const std::string place = fmt::format("/images/{}", used.image);
        mesh::Image image;
        image.name = from.uri && !from.uri->starts_with("data:") ? *from.uri : place;
        image.color_space = used.color_space;
        try {
            std::span<const std::byte> bytes;
            if (from.uri) {
                read_uri(*from.uri, kMostPictureFileBytes, place, read_file_, notes, file);
                bytes = file;
            } else {
                bytes = bytes_of(source.document, source.buffers, *from.view);
            }
            const PictureHeader header = read_picture_header(bytes, place, budget_.limits());
            budget_.take(header.bytes(), place, "its texels");
            decode_picture(bytes, header, place, image, notes);
        } catch (const Refusal& refusal) {
            if (!options_.mark_broken_pictures) {
                throw;
            }
            notes.add("marked picture", refusal.place(),
                      fmt::format("{}: shown as magenta and black (used by {})", refusal.what(),
                                  used.place));
            make_marked(image);
        }
        return image;
    }

    /// Room in the lists for what the shapes will need, by what their accessors have: vertices that
    /// shapes share are counted once, and coarser forms as a third of the finest.
    void reserve(const Document& document, const Plan& plan, mesh::MeshData& data) const {
        std::set<std::uint32_t> positions;
        std::uint64_t vertices = 0;
        std::uint64_t indices = 0;
        for (const GeometryKey& key : plan.geometries) {
            const auto position = key.attributes.find("POSITION");
            const bool is_shown = key.mode == Mode::Triangles || key.mode == Mode::TriangleStrip ||
                                  key.mode == Mode::TriangleFan;
            if (position == key.attributes.end() || !is_shown) {
                continue;
            }
            const std::uint64_t count = document.accessors.at(position->second).count;
            vertices += positions.insert(position->second).second ? count : 0;
            indices += key.indices ? document.accessors.at(*key.indices).count : count;
        }
        vertices = std::min(vertices, indices);
        indices += options_.coarser_forms ? indices / 3 : 0;
        // What does not fit will be refused where it is read.
        if (vertices * sizeof(mesh::Vertex) + indices * sizeof(std::uint32_t) <=
            options_.limits.most_bytes) {
            memory::reserve_in_large_pages(data.vertices, vertices);
            memory::reserve_in_large_pages(data.indices, indices);
        }
    }

    static void place(const Plan& plan, const ShownNodes& shown, ShapeList& shapes,
                      mesh::MeshData& data) {
        std::map<Piece, std::pair<std::uint32_t, std::uint32_t>> levels;  // first, count
        for (const PlacedMesh& mesh : shown.meshes) {
            for (const Piece& piece : plan.meshes.at(mesh.mesh)) {
                const auto [at, is_new] = levels.try_emplace(piece);
                if (is_new) {
                    at->second = shapes.add_levels(piece.geometry, piece.material);
                }
                if (at->second.second > 0) {
                    data.instances.push_back({.first_level = at->second.first,
                                              .level_count = at->second.second,
                                              .world_from_local = mesh.world_from_local});
                }
            }
        }
    }

    const ReadFile& read_file_;
    const LoadOptions& options_;
    Budget budget_;
    Notes notes_;
};

/// What a file says ends up on terminals: no control characters.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, '?');
    return text;
}

Error error_of(const std::string& name, const std::string& place, const std::string& what) {
    return {ErrorKind::BadInput,
            printable(place.empty() ? fmt::format("{}: {}", name, what)
                                    : fmt::format("{}: {}: {}", name, place, what))};
}

/// What `step` makes, or why not.
template <typename Step>
Expected<LoadedScene> as_expected(const std::string& name, Step step) {
    try {
        return step();
    } catch (const Refusal& refusal) {
        return std::unexpected(error_of(name, refusal.place(), refusal.what()));
    } catch (const std::bad_alloc&) {
        return std::unexpected(
            error_of(name, "", "does not fit into this machine's memory; make the scene smaller"));
    }
}

}  // namespace

Expected<LoadedScene> load_gltf(std::span<const std::byte> file, const std::string& name,
                                const ReadFile& read_file, const LoadOptions& options) {
    return as_expected(name, [&] { return Loader(read_file, options).load(file); });
}

Expected<LoadedScene> load_gltf(const std::filesystem::path& file, const LoadOptions& options) {
    return as_expected(file.string(), [&] {
        const ReadFile read_file = files_of(file.parent_path());
        Bytes bytes;
        read_file(file.filename(), options.limits.most_bytes, "", bytes);
        return Loader(read_file, options).load(bytes);
    });
}

std::string note_text(const Note& note) {
    std::string text =
        note.place.empty() ? note.text : fmt::format("{}: {}", note.place, note.text);
    if (note.times > 1) {
        text += fmt::format(" (and {} more)", note.times - 1);
    }
    return printable(std::move(text));
}

}  // namespace gazeloop::scene::gltf
