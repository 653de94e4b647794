#include "runtime/render/eye_uniforms.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

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

EyeUniforms eye_uniforms(const gaze::EyeView& view, double scene_time_s, std::uint32_t samples,
                         const foveation::SamplingPlan* plan) {
    EyeUniforms uniforms;
    uniforms.camera_and_time = {glm::vec3(view.pose.position_m), static_cast<float>(scene_time_s)};
    const glm::dmat3 axes = glm::mat3_cast(view.pose.orientation);
    for (int column = 0; column < 3; ++column) {
        uniforms.view_axes[static_cast<std::size_t>(column)] = {glm::vec3(axes[column]), 0.0F};
    }
    uniforms.tangents =
        glm::vec4(glm::dvec4(std::tan(view.fov.left_rad), std::tan(view.fov.right_rad),
                             std::tan(view.fov.up_rad), std::tan(view.fov.down_rad)));
    uniforms.image_and_bands = {view.width_px, view.height_px,
                                plan != nullptr ? plan->lp_bands.size() : 0, 0.0F};
    const auto offsets = sample_offsets(samples);
    double row_angle = 0.0;
    if (plan != nullptr) {
        row_angle = 2.0 * std::numbers::pi / plan->lp.height;
        if (plan->in_gaze_frame) {
            uniforms.gaze_frame = plan->in_gaze_frame->uniforms;
        } else {
            const auto in_picture =
                foveation::picture_frame_uniforms(plan->fovea, plan->log2_max_radius);
            uniforms.fovea_and_log2 = in_picture.fovea_and_log2;
            uniforms.radius = in_picture.radius;
        }
        uniforms.lp_and_disc = glm::vec4(glm::dvec4(
            plan->lp.width, plan->lp.height,
            plan->in_gaze_frame ? plan->in_gaze_frame->disc_half_sine : plan->disc_radius_px,
            plan->in_gaze_frame ? plan->in_gaze_frame->border_half_sine : plan->disc_border_px));
    }
    for (std::size_t s = 0; s < samples; ++s) {
        const double angle = offsets[s].y * row_angle;
        uniforms.offsets[s] =
            glm::vec4(glm::dvec4(offsets[s].x, offsets[s].y, std::cos(angle), std::sin(angle)));
    }
    return uniforms;
}

}  // namespace gazeloop::render
