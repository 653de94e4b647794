#include "runtime/foveation/log_polar/float_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gazeloop::foveation {
namespace {

float turns(float x, float y) {
    const float across = std::abs(x);
    const float down = std::abs(y);
    const float greater = std::max(across, down);
    const float q = greater > 0.0F ? std::min(across, down) / greater : 0.0F;
    const float z = q * q;
    float p = 0.00039099999997F;
    for (const float coefficient :
         {-0.00229204795323F, 0.00633137952536F, -0.01151463389397F, 0.01670959219337F,
          -0.02253829687834F, 0.03180855885148F, -0.05305047705770F, 0.15915492177010F}) {
        p = p * z + coefficient;
    }
    p *= q;
    p = down > across ? 0.25F - p : p;
    p = x < 0.0F ? 0.5F - p : p;
    return y < 0.0F ? 1.0F - p : p;
}

glm::vec3 transformed(const std::array<glm::vec4, 3>& columns, const glm::vec3& by) {
    return glm::vec3(columns[0]) * by.x + glm::vec3(columns[1]) * by.y +
           glm::vec3(columns[2]) * by.z;
}

}  // namespace

FloatMap::FloatMap(const MapTables& tables, LpSize lp, const PictureFrameUniforms& uniforms)
    : tables_(&tables), lp_(lp), in_gaze_frame_(false), picture_(uniforms) {}

FloatMap::FloatMap(const MapTables& tables, LpSize lp, const GazeFrameUniforms& uniforms)
    : tables_(&tables), lp_(lp), in_gaze_frame_(true), gaze_(uniforms) {}

float FloatMap::log2_by_table(float y) const {
    const auto bits = std::bit_cast<std::uint32_t>(y);
    const std::size_t i = (bits >> 14U) & 511U;
    const float t = static_cast<float>(bits & 16383U) / 16384.0F;
    const float low = tables_->log2_mantissa[i];
    const float high = tables_->log2_mantissa[i + 1];
    return static_cast<float>(static_cast<int>(bits >> 23U) - 127) + (low + t * (high - low));
}

float FloatMap::exp2_by_table(float x) const {
    const float whole = std::floor(x);
    const float scaled = (x - whole) * static_cast<float>(MapTables::kMantissaSteps);
    const std::size_t i = std::min(static_cast<std::size_t>(scaled), MapTables::kMantissaSteps - 1);
    const float low = tables_->exp2_fraction[i];
    const float high = tables_->exp2_fraction[i + 1];
    const float fraction = low + (scaled - static_cast<float>(i)) * (high - low);
    return std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<int>(whole) + 127) << 23U) *
           fraction;
}

float FloatMap::forward(float q, float scale) const {
    const float s = std::clamp(-log2_by_table(std::max(q, 1e-30F)) * scale, 0.0F, 1.0F);
    const float scaled = std::sqrt(s) * static_cast<float>(MapTables::kForwardSteps);
    const std::size_t i = std::min(static_cast<std::size_t>(scaled), MapTables::kForwardSteps - 1);
    const float low = tables_->forward[i];
    const float high = tables_->forward[i + 1];
    return low + (scaled - static_cast<float>(i)) * (high - low);
}

FloatMap::Share FloatMap::share(const glm::vec2& position_px) const {
    if (in_gaze_frame_) {
        const glm::vec3 ray =
            transformed(gaze_.gaze_from_picture, {position_px.x, position_px.y, 1.0F});
        const float across2 = ray.x * ray.x + ray.y * ray.y;
        const float length = std::sqrt(across2 + ray.z * ray.z);
        const float along = std::abs(ray.z);
        const float nearer = 0.5F * across2 / (length * (length + along));
        return {forward(ray.z >= 0.0F ? nearer : 1.0F - nearer,
                        static_cast<float>(MapTables::kGazeScale)),
                turns(ray.x, ray.y)};
    }
    const float dx = position_px.x - picture_.fovea_and_log2.x;
    const float dy = position_px.y - picture_.fovea_and_log2.y;
    return {forward((dx * dx + dy * dy) * picture_.radius.y, picture_.fovea_and_log2.w),
            turns(dx, dy)};
}

float FloatMap::column_value(std::uint32_t column) const {
    return tables_->column[std::min(2 * std::size_t{column} + 1, 2 * std::size_t{lp_.width})];
}

glm::vec2 FloatMap::position(std::uint32_t column, std::uint32_t row) const {
    const float radius =
        picture_.radius.x * exp2_by_table(-column_value(column) * picture_.fovea_and_log2.z);
    const MapTables::Direction& direction = tables_->row[row];
    return {picture_.fovea_and_log2.x + radius * direction.cosine,
            picture_.fovea_and_log2.y + radius * direction.sine};
}

glm::vec3 FloatMap::view_ray(std::uint32_t column, std::uint32_t row) const {
    const float rho = column_value(column);
    const MapTables::Direction& direction = tables_->row[row];
    return transformed(gaze_.view_from_gaze, {2.0F * rho * direction.cosine,
                                              2.0F * rho * direction.sine, 1.0F - rho * rho});
}

}  // namespace gazeloop::foveation
