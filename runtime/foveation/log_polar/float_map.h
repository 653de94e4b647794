#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/foveation/log_polar/map_uniforms.h"

namespace gazeloop::foveation {

/// The shaders' arithmetic on a map, operation by operation in float, so that its exactness can be
/// tested and measured without a device. Keep it the same as shaders/lib/log_polar.glsl and
/// gaze_frame.glsl.
class FloatMap {
  public:
    /// The tables must outlive the map.
    FloatMap(const MapTables& tables, LpSize lp, const PictureFrameUniforms& uniforms);
    FloatMap(const MapTables& tables, LpSize lp, const GazeFrameUniforms& uniforms);

    struct Share {
        float u;  ///< [0, 1]
        float v;  ///< [0, 1]; 1 is 0
    };
    [[nodiscard]] Share share(const glm::vec2& position_px) const;

    /// The centre of an LP texel in the picture, px. Precondition: a map in the picture's frame.
    [[nodiscard]] glm::vec2 position(std::uint32_t column, std::uint32_t row) const;
    /// The ray through the centre of an LP texel, in the view frame, of any length. Precondition: a
    /// map in the gaze's frame.
    [[nodiscard]] glm::vec3 view_ray(std::uint32_t column, std::uint32_t row) const;

  private:
    [[nodiscard]] float forward(float q, float scale) const;
    [[nodiscard]] float log2_by_table(float y) const;
    [[nodiscard]] float exp2_by_table(float x) const;
    [[nodiscard]] float column_value(std::uint32_t column) const;

    const MapTables* tables_;
    LpSize lp_;
    bool in_gaze_frame_;
    PictureFrameUniforms picture_{};
    GazeFrameUniforms gaze_{};
};

}  // namespace gazeloop::foveation
