#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

/// The parts of a file: JSON, and of a .glb its binary chunk. They point into the file's bytes.
struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
};

/// Takes a .gltf or .glb apart; the first bytes tell which it is. Throws Refusal; notes what the
/// standard forbids and does no harm.
[[nodiscard]] Container open_container(std::span<const std::byte> file, Notes& notes);

}  // namespace gazeloop::scene::gltf
