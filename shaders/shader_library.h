#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gazeloop::shaders {

/// The SPIR-V of a shader, by file name ("full_screen.vert") or, for scene x method,
/// "SCENE.PASS.frag" ("raymarch.full.frag"). Throws SetupError for an unknown name.
std::span<const std::uint32_t> spirv(std::string_view name);

/// The scenes that there are: the files of shaders/scenes whose names have no underscore, sorted.
std::span<const std::string_view> scenes();

}  // namespace gazeloop::shaders
