#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "runtime/gaze/eye.h"

namespace gazeloop::gaze {

/// A triangle in a view's plane of z = -1: x to the right, y up, both tangents of angles from the
/// view's axis. Any winding.
struct HiddenTriangle {
    std::array<glm::dvec2, 3> corners{};

    friend bool operator==(const HiddenTriangle&, const HiddenTriangle&) = default;
};

/// The part of a view that no eye can see, because lens or housing are in the way. Triangles may
/// overlap, reach beyond the view, or be none.
using HiddenMesh = std::vector<HiddenTriangle>;

/// Both eyes' meshes, immutable: another pointer is a change. Null: nothing is hidden.
using HiddenMeshes = std::shared_ptr<const PerEye<HiddenMesh>>;

/// From this frame on, these.
struct HiddenChange {
    std::uint64_t frame = 0;
    HiddenMeshes meshes;
};

}  // namespace gazeloop::gaze
