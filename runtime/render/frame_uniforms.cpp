#include "runtime/render/frame_uniforms.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace gazeloop::render {
namespace {

double radical_inverse_base_2(std::uint32_t n) {
    double value = 0.0;
    for (double digit = 0.5; n != 0; n >>= 1U, digit *= 0.5) {
        if ((n & 1U) != 0) {
            value += digit;
        }
    }
    return value;
}

std::array<glm::vec4, 3> axes_of(const gaze::Pose& pose) {
    std::array<glm::vec4, 3> columns{};
    const glm::dmat3 axes = glm::mat3_cast(pose.orientation);
    for (int column = 0; column < 3; ++column) {
        columns[static_cast<std::size_t>(column)] = {glm::vec3(axes[column]), 0.0F};
    }
    return columns;
}

glm::vec4 tangents_of(const gaze::FieldOfView& fov) {
    return glm::vec4(glm::dvec4(std::tan(fov.left_rad), std::tan(fov.right_rad),
                                std::tan(fov.up_rad), std::tan(fov.down_rad)));
}

}  // namespace

std::array<glm::dvec2, kMaxSamples> sample_offsets(std::uint32_t samples) {
    std::array<glm::dvec2, kMaxSamples> offsets{};
    glm::dvec2 mean{0.0};
    for (std::uint32_t s = 0; s < samples; ++s) {
        offsets[s] = {(s + 0.5) / samples, radical_inverse_base_2(s)};
        mean += offsets[s] / static_cast<double>(samples);
    }
    for (std::uint32_t s = 0; s < samples; ++s) {
        offsets[s] -= mean;
    }
    return offsets;
}

FrameUniforms frame_uniforms(const gaze::EyeView& view, double scene_time_s, std::uint32_t samples,
                             const gaze::EyeView* last, const glm::dvec2& aside) {
    FrameUniforms uniforms;
    uniforms.camera_and_time = {glm::vec3(view.pose.position_m), static_cast<float>(scene_time_s)};
    uniforms.view_axes = axes_of(view.pose);
    uniforms.tangents = tangents_of(view.fov);
    uniforms.image = glm::vec4(glm::dvec4(view.width_px, view.height_px, aside.x, aside.y));
    if (last != nullptr) {
        uniforms.last_camera = {glm::vec3(last->pose.position_m), 1.0F};
        uniforms.last_view_axes = axes_of(last->pose);
        uniforms.last_tangents = tangents_of(last->fov);
    }
    const auto offsets = sample_offsets(samples);
    for (std::size_t s = 0; s < samples; ++s) {
        uniforms.offsets[s] = glm::vec4(glm::dvec4(offsets[s], 0.0, 0.0));
    }
    return uniforms;
}

}  // namespace gazeloop::render
