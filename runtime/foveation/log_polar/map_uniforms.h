#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "runtime/foveation/picture/gaze_frame.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// The part of a map that depends on the gaze, as the shaders take it (shaders/lib/log_polar.glsl).
/// Everything else lies in MapTables, so that a new gaze costs only these few numbers.
///
/// Picture frame, with rmax the farthest radius:
struct PictureFrameUniforms {
    glm::vec4 fovea_and_log2{0.0F};  ///< fovea, px; log2 rmax; .5 / log2 rmax
    glm::vec4 radius{0.0F};          ///< rmax, px; 1 / rmax^2; unused
};
PictureFrameUniforms picture_frame_uniforms(const gaze::PixelPosition& fovea,
                                            double log2_max_radius);

/// Gaze frame.
struct GazeFrameUniforms {
    std::array<glm::vec4, 3> gaze_from_picture{};  ///< columns: (x_px, y_px, 1) to the gaze's ray
    std::array<glm::vec4, 3> view_from_gaze{};     ///< columns of a rotation
};
GazeFrameUniforms gaze_frame_uniforms(const GazeFrame& frame);

/// Both, with the part of the plan that the shaders read; std140.
struct MapUniforms {
    glm::vec4 fovea_and_log2{0.0F};
    glm::vec4 lp_and_disc{0.0F};       ///< LP-buffer's width, height; disc radius and its border
    glm::vec4 radius_and_bands{0.0F};  ///< rmax, px; 1 / rmax^2; bands of the LP-buffer; unused
    GazeFrameUniforms gaze_frame{};
};
static_assert(sizeof(MapUniforms) == std::size_t{16} * 9);

}  // namespace gazeloop::foveation
