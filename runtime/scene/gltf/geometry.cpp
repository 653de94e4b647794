#include "runtime/scene/gltf/geometry.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "runtime/scene/gltf/detail_levels.h"
#include "runtime/scene/gltf/triangles.h"
#include "runtime/scene/gltf/vertex_frames.h"

namespace gazeloop::scene::gltf {
namespace {

/// The vertices that a primitive's triangles lie among: [first, first + count) of its accessors.
struct VertexRange {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

class GeometryReader {
  public:
    GeometryReader(const Source& source, const GeometryKey& key, const std::string& place,
                   Budget& budget, Notes& notes)
        : source_(source), key_(key), place_(place), budget_(budget), notes_(notes) {}

    Geometry read() {
        if (!key_.attributes.contains("POSITION")) {
            return {};  // check_document() has noted it
        }
        auto triangles = read_triangles();
        if (!triangles) {
            notes_.add("points and lines", place_ + "/mode", "points and lines are not shown");
            return {};
        }
        if (triangles->empty()) {
            notes_.add("no triangle", place_, "has no triangle: not shown");
            return {};
        }
        geometry_.indices = std::move(*triangles);
        const VertexRange range = used_vertices();
        read_vertices(range);
        make_normals();
        make_all_tangents();
        order_for_gpu(geometry_);
        return std::move(geometry_);
    }

  private:
    std::uint64_t vertex_count() const {
        return source_.document.accessors.at(key_.attributes.at("POSITION")).count;
    }

    std::optional<std::vector<std::uint32_t>> read_triangles() {
        const std::uint64_t vertices = vertex_count();
        const std::uint64_t count =
            key_.indices ? source_.document.accessors.at(*key_.indices).count : vertices;
        // Strips make three of one; each is kept and ordered once more.
        budget_.take(count * 3 * sizeof(std::uint32_t), place_, "its indices");
        if (vertices > std::numeric_limits<std::uint32_t>::max() - 1) {
            refuse(place_, fmt::format("has {} vertices, more than 32 bits can count", vertices));
        }
        std::vector<std::uint32_t> indices;
        if (key_.indices) {
            indices = read_indices(source_, *key_.indices);
            const auto past = std::ranges::find_if(
                indices, [&](std::uint32_t index) { return index >= vertices; });
            if (past != indices.end()) {
                refuse(fmt::format("/accessors/{}", *key_.indices),
                       fmt::format("index {} is {}, of {} vertices of {}; there is no primitive "
                                   "restart in glTF",
                                   past - indices.begin(), *past, vertices, place_));
            }
        } else {
            indices.resize(vertices);
            std::iota(indices.begin(), indices.end(), 0U);
        }
        const bool is_list = key_.mode == Mode::Triangles;
        if ((is_list && count % 3 != 0) || count < 3) {
            notes_.add("incomplete triangle", place_,
                       fmt::format("has {} indices, {}: the rest is left out", count,
                                   is_list ? "no multiple of 3" : "fewer than 3"));
        }
        return triangles_of(key_.mode, std::move(indices));
    }

    /// Makes the indices relative to the first vertex that is used.
    VertexRange used_vertices() {
        const auto [low, high] = std::ranges::minmax(geometry_.indices);
        for (std::uint32_t& index : geometry_.indices) {
            index -= low;
        }
        return {low, std::uint64_t{high} - low + 1};
    }

    void read_vertices(const VertexRange& range) {
        std::uint64_t bytes = range.count * sizeof(mesh::Vertex);
        for (const auto& [semantic, accessor] : key_.attributes) {
            const auto& sparse = source_.document.accessors.at(accessor).sparse;
            bytes += sparse ? sparse->count * sizeof(std::uint32_t) : 0;
        }
        budget_.take(bytes, place_, "its vertices");
        geometry_.vertices.resize(range.count);
        const auto read = [&](const std::string& semantic, auto put) {
            const auto found = key_.attributes.find(semantic);
            if (found == key_.attributes.end()) {
                return false;
            }
            read_elements(source_, found->second, range.first, range.count,
                          [&](std::uint64_t i, const std::array<float, 4>& element) {
                              put(geometry_.vertices[i - range.first], element);
                          });
            return true;
        };
        read("POSITION", [](mesh::Vertex& vertex, const std::array<float, 4>& e) {
            vertex.position_m = {e[0], e[1], e[2]};
        });
        has_normals_ = read("NORMAL", [](mesh::Vertex& vertex, const std::array<float, 4>& e) {
            vertex.normal = {e[0], e[1], e[2]};
        });
        has_tangents_ = read("TANGENT", [](mesh::Vertex& vertex, const std::array<float, 4>& e) {
            vertex.tangent = {e[0], e[1], e[2], e[3]};
        });
        for (std::size_t slot = 0; slot < key_.uv_sets.size(); ++slot) {
            if (key_.uv_sets[slot] == mesh::kNone) {
                continue;
            }
            const std::string semantic = fmt::format("TEXCOORD_{}", key_.uv_sets[slot]);
            if (!read(semantic, [&](mesh::Vertex& vertex, const std::array<float, 4>& e) {
                    vertex.uv[slot] = {e[0], e[1]};
                })) {
                notes_.add("no texture coordinates", place_,
                           fmt::format("its material uses {}, which it lacks: all 0", semantic));
            }
        }
        read_colors(read);
        check_position(range);
    }

    template <typename Read>
    void read_colors(Read read) {
        const auto found = key_.attributes.find("COLOR_0");
        if (found == key_.attributes.end()) {
            return;
        }
        const bool has_alpha =
            source_.document.accessors.at(found->second).type == ElementType::Vec4;
        bool is_outside = false;
        read("COLOR_0", [&](mesh::Vertex& vertex, const std::array<float, 4>& e) {
            for (std::size_t c = 0; c < 4; ++c) {
                const float level = c == 3 && !has_alpha ? 1.0F : e[c];
                is_outside = is_outside || level < 0.0F || level > 1.0F;
                vertex.color[c] =
                    static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(level, 0.0F, 1.0F)));
            }
        });
        if (is_outside) {
            notes_.add("color", place_ + "/attributes/COLOR_0",
                       "has colours outside 0 to 1: taken as 0 or 1");
        }
    }

    /// The bounds that the file states, and how finely integers divide them. Both only where the
    /// whole accessor is used here, and without replacements.
    void check_position(const VertexRange& range) {
        const std::uint32_t index = key_.attributes.at("POSITION");
        const Accessor& accessor = source_.document.accessors.at(index);
        if (range.count != accessor.count || accessor.min.empty() || accessor.max.empty()) {
            return;
        }
        mesh::Bounds bounds;
        for (const mesh::Vertex& vertex : geometry_.vertices) {
            bounds.low_m = glm::min(bounds.low_m, vertex.position_m);
            bounds.high_m = glm::max(bounds.high_m, vertex.position_m);
        }
        double steps = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            steps = std::max(steps, accessor.max[at] - accessor.min[at]);
            if (!accessor.normalized &&
                (static_cast<float>(accessor.min[at]) != bounds.low_m[axis] ||
                 static_cast<float>(accessor.max[at]) != bounds.high_m[axis])) {
                notes_.add("bounds", fmt::format("/accessors/{}", index),
                           "its min and max are not those of its elements");
            }
        }
        constexpr double kFewestSteps = 64.0;
        if (accessor.component != Component::Float && steps < kFewestSteps) {
            notes_.add(
                "coarse positions", place_,
                fmt::format("its positions have {:.0f} steps from end to end, so that it may "
                            "look crumpled; export with more bits (gltfpack -vp 16) or "
                            "without quantization",
                            steps));
        }
    }

    /// Flat ones make every corner a vertex of its own.
    void make_normals() {
        if (has_normals_) {
            if (const std::size_t without =
                    make_unit_normals(geometry_.vertices, geometry_.indices);
                without > 0) {
                notes_.add(
                    "zero normals", place_ + "/attributes/NORMAL",
                    fmt::format("{} normals have no direction: made from the triangles", without));
            }
            return;
        }
        has_tangents_ = false;  // the standard: they count only with normals
        budget_.take(geometry_.indices.size() * sizeof(mesh::Vertex), place_, "its flat normals");
        std::vector<mesh::Vertex> corners(geometry_.indices.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = geometry_.vertices[geometry_.indices[i]];
            geometry_.indices[i] = static_cast<std::uint32_t>(i);
        }
        geometry_.vertices = std::move(corners);
        make_flat_normals(geometry_.vertices, geometry_.indices);
    }

    void make_all_tangents() {
        if (!has_tangents_ && key_.tangent_slot != mesh::kNone) {
            make_tangents(geometry_.vertices, geometry_.indices, key_.tangent_slot);
            return;
        }
        std::size_t changed = 0;
        for (mesh::Vertex& vertex : geometry_.vertices) {
            const glm::dvec3 along(vertex.tangent);
            const double length = has_tangents_ ? glm::length(along) : 0.0;
            const bool has_sign = vertex.tangent.w == 1.0F || vertex.tangent.w == -1.0F;
            changed += has_tangents_ && (!(length > 0.0) || !has_sign) ? 1 : 0;
            vertex.tangent = glm::vec4(
                length > 0.0 ? glm::vec3(along / length) : perpendicular_to(vertex.normal),
                vertex.tangent.w < 0.0F ? -1.0F : 1.0F);
        }
        if (changed > 0) {
            notes_.add(
                "tangents", place_ + "/attributes/TANGENT",
                fmt::format("{} tangents have no direction, or a w that is not 1 or -1: made "
                            "so",
                            changed));
        }
    }

    const Source& source_;
    const GeometryKey& key_;
    const std::string& place_;
    Budget& budget_;
    Notes& notes_;
    Geometry geometry_;
    bool has_normals_ = false;
    bool has_tangents_ = false;
};

}  // namespace

Geometry read_geometry(const Source& source, const GeometryKey& key, const std::string& place,
                       Budget& budget, Notes& notes) {
    return GeometryReader(source, key, place, budget, notes).read();
}

}  // namespace gazeloop::scene::gltf
