#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/scene/gltf/geometry.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

/// A scene's shapes, put one after the other into its lists of vertices and indices.
class ShapeList {
  public:
    /// `shapes`: how many there will be. `data` gets them and must outlive this.
    ShapeList(std::size_t shapes, mesh::MeshData& data) : shapes_(shapes), data_(data) {}

    /// Puts shape `number` into the lists once those before it are there: until then it waits. Each
    /// number once; several threads may put. Throws Refusal where a GPU could not address it.
    void put(std::size_t number, Geometry geometry);

    /// Adds the primitives and detail levels that a shape makes under a material: the first of the
    /// levels, and how many. Precondition: all shapes are put.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> add_levels(std::uint32_t number,
                                                                     std::uint32_t material);

  private:
    /// Where a shape lies in the lists: its forms from the finest on.
    struct Form {
        std::uint32_t first_index = 0;
        std::uint32_t index_count = 0;
        float error_m = 0.0F;
    };
    struct Shape {
        Geometry waiting;
        bool is_put = false;
        std::uint32_t first_vertex = 0;
        std::uint32_t vertex_count = 0;
        mesh::Bounds bounds;
        std::vector<Form> forms;
    };
    void append(Shape& shape);
    [[nodiscard]] Form appended(const std::vector<std::uint32_t>& indices, float error_m);

    std::mutex mutex_;
    std::vector<Shape> shapes_;
    std::size_t next_ = 0;
    mesh::MeshData& data_;
};

}  // namespace gazeloop::scene::gltf
