#pragma once

#include "runtime/scene/gltf/geometry.h"

namespace gazeloop::scene::gltf {

/// Orders triangles for the GPU's vertex cache, then vertices by their first use; vertices that no
/// triangle uses go. The picture stays the same but for the order in which equal depths are drawn.
void order_for_gpu(Geometry& geometry);

/// Adds coarser forms of a quarter of the triangles each, down to 256 triangles or until the error
/// would exceed a fiftieth of the shape's extent. Shapes of under 1024 triangles stay alone.
void add_coarser_forms(Geometry& geometry);

}  // namespace gazeloop::scene::gltf
