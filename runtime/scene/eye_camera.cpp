#include "runtime/scene/eye_camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace gazeloop::scene {
namespace {

struct Tangents {
    explicit Tangents(const gaze::FieldOfView& fov)
        : left(std::tan(fov.left_rad)),
          right(std::tan(fov.right_rad)),
          up(std::tan(fov.up_rad)),
          down(std::tan(fov.down_rad)) {}
    double left, right, up, down;
};

}  // namespace

ViewUniforms view_uniforms(const gaze::EyeView& view) {
    const Tangents t(view.fov);
    const glm::dmat3 axes = glm::mat3_cast(view.pose.orientation);
    const glm::dvec3& eye_m = view.pose.position_m;
    const auto row = [&](const glm::dvec3& axis) {
        return glm::dvec4(axis, -glm::dot(axis, eye_m));
    };
    const glm::dvec4 ahead = row(-axes[2]);
    const glm::dvec4 x = (2.0 * (row(axes[0]) - t.left * ahead)) / (t.right - t.left) - ahead;
    const glm::dvec4 y = (2.0 * (row(axes[1]) - t.up * ahead)) / (t.down - t.up) - ahead;
    const glm::dvec4 z(0.0, 0.0, 0.0, static_cast<double>(kNear_m));
    ViewUniforms uniforms;
    uniforms.clip_from_world = glm::mat4(glm::transpose(glm::dmat4(x, y, z, ahead)));
    uniforms.camera = glm::vec4(glm::vec3(eye_m), 0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        uniforms.axes.at(static_cast<std::size_t>(axis)) = glm::vec4(glm::vec3(axes[axis]), 0.0F);
    }
    uniforms.tangents = glm::vec4(glm::dvec4(t.left, t.right, t.up, t.down));
    uniforms.size = {view.width_px, view.height_px, 0.0F, 0.0F};
    return uniforms;
}

mesh::Frustum frustum_of(const gaze::EyeView& view) {
    const Tangents t(view.fov);
    const glm::dmat3 axes = glm::mat3_cast(view.pose.orientation);
    const auto plane = [&](const glm::dvec3& inwards) {
        const glm::dvec3 unit = glm::normalize(inwards);
        return glm::vec4(glm::dvec4(unit, -glm::dot(unit, view.pose.position_m)));
    };
    mesh::Frustum frustum;
    frustum.planes = {plane(axes[0] + t.left * axes[2]), plane(-axes[0] - t.right * axes[2]),
                      plane(axes[1] + t.down * axes[2]), plane(-axes[1] - t.up * axes[2]),
                      plane(-axes[2])};
    frustum.eye_m = glm::vec3(view.pose.position_m);
    const double pixels_per_tangent = view.width_px / (t.right - t.left);
    frustum.error_per_m = static_cast<float>(kDetailError_px / pixels_per_tangent);
    return frustum;
}

}  // namespace gazeloop::scene
