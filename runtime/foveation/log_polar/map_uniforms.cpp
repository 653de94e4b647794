#include "runtime/foveation/log_polar/map_uniforms.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::foveation {

PictureFrameUniforms picture_frame_uniforms(const gaze::PixelPosition& fovea,
                                            double log2_max_radius) {
    return {glm::vec4(glm::dvec4(fovea.x_px, fovea.y_px, log2_max_radius, 0.5 / log2_max_radius)),
            glm::vec4(glm::dvec4(std::exp2(log2_max_radius), std::exp2(-2.0 * log2_max_radius), 0.0,
                                 0.0))};
}

GazeFrameUniforms gaze_frame_uniforms(const GazeFrame& frame) {
    GazeFrameUniforms uniforms;
    for (int column = 0; column < 3; ++column) {
        const auto i = static_cast<std::size_t>(column);
        uniforms.gaze_from_picture[i] = {glm::vec3(frame.gaze_from_picture()[column]), 0.0F};
        uniforms.view_from_gaze[i] = {glm::vec3(frame.view_from_gaze()[column]), 0.0F};
    }
    return uniforms;
}

}  // namespace gazeloop::foveation
