#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/scene/gltf/document.h"

namespace gazeloop::scene::gltf {

/// The triangles of a primitive's vertices in the order that its mode gives them (glTF 2.0 section
/// 3.7.2.1), three indices each, front sides as the mode says. Of strips and fans, triangles with
/// an index twice are left out: they only turn the strip. An incomplete last triangle is left out
/// too. None: its mode draws points or lines.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_of(
    Mode mode, std::vector<std::uint32_t> indices);

}  // namespace gazeloop::scene::gltf
