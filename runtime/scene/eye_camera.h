#pragma once

#include "runtime/gaze/view.h"
#include "runtime/scene/mesh/draw_list.h"
#include "runtime/scene/mesh_uniforms.h"

namespace gazeloop::scene {

/// How far the form of a thing may lie from its true surface in a picture, px.
inline constexpr double kDetailError_px = 0.65;

/// What an eye's picture is drawn from, without the sun.
[[nodiscard]] ViewUniforms view_uniforms(const gaze::EyeView& view);

/// What it shows of the world.
[[nodiscard]] mesh::Frustum frustum_of(const gaze::EyeView& view);

}  // namespace gazeloop::scene
