#include "runtime/scene/eye_camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "runtime/scene/mesh_needs.h"
#include "tests/unit/scene/scene_samples.h"

namespace gazeloop::scene {
namespace {

gaze::EyeView canted() {
    return {.pose = {.orientation = glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0)) *
                                    glm::angleAxis(-0.2, glm::dvec3(1.0, 0.0, 0.0)),
                     .position_m = {0.4, -0.2, 1.5}},
            .fov = {-0.9, 0.6, 0.55, -0.75},
            .width_px = 1440,
            .height_px = 1600};
}

TEST(EyeCamera, PutsPointsWhereTheViewSeesThem) {
    const gaze::EyeView view = canted();
    const ViewUniforms uniforms = view_uniforms(view);
    for (const glm::dvec3& local :
         {glm::dvec3(0, 0, -1), glm::dvec3(0.3, -0.4, -2), glm::dvec3(-4, 2, -7),
          glm::dvec3(0.001, 0.001, -0.06), glm::dvec3(30, -20, -90)}) {
        const glm::vec4 clip = uniforms.clip_from_world *
                               glm::vec4(glm::vec3(transform_point(view.pose, local)), 1.0F);
        const gaze::PixelPosition right = gaze::project(local, view);
        EXPECT_NEAR((clip.x / clip.w + 1.0) / 2.0 * view.width_px, right.x_px, 5e-3);
        EXPECT_NEAR((clip.y / clip.w + 1.0) / 2.0 * view.height_px, right.y_px, 5e-3);
        EXPECT_NEAR(clip.z / clip.w, static_cast<double>(kNear_m) / -local.z, 1e-5);
    }
}

TEST(EyeCamera, SeesWhatThePictureShowsAndNothingFarBesideIt) {
    const gaze::EyeView view = canted();
    const mesh::Frustum frustum = frustum_of(view);
    const auto inside = [&](const glm::dvec3& local) {
        const glm::vec3 point(transform_point(view.pose, local));
        return std::ranges::all_of(frustum.planes, [&](const glm::vec4& plane) {
            return glm::dot(glm::vec3(plane), point) + plane.w >= 0.0F;
        });
    };
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, {1439.0, 1.0}, {1.0, 1599.0}, {720.0, 800.0}}) {
        EXPECT_TRUE(inside(3.0 * gaze::unproject({x, y}, view))) << x << " " << y;
    }
    for (const auto& [x, y] :
         {std::pair{-2.0, 800.0}, {1442.0, 800.0}, {700.0, -2.0}, {700.0, 1602.0}}) {
        EXPECT_FALSE(inside(3.0 * gaze::unproject({x, y}, view))) << x << " " << y;
    }
    EXPECT_FALSE(inside({0.0, 0.0, 1.0})) << "behind";
}

TEST(MeshNeeds, AreThoseOfTheScene) {
    mesh::Material matt;
    matt.metallic = 0.0F;
    mesh::MeshData plain = mesh::square(1.0F, mesh::moved({}), matt);
    plain.lights.push_back({.casts_shadow = false});
    const MeshNeeds least = needs_of(plain, false);
    EXPECT_FALSE(least.shadows || least.glass || least.reflections || least.depth_first);
    EXPECT_EQ(least.skipped.size(), 4U);

    plain.lights.push_back({.kind = mesh::LightKind::Point});
    EXPECT_FALSE(needs_of(plain, false).shadows) << "point lights cast none";
    plain.lights.push_back({.kind = mesh::LightKind::Spot});
    EXPECT_TRUE(needs_of(plain, false).shadows);
    plain.lights.clear();
    EXPECT_TRUE(needs_of(plain, false).shadows) << "the sun that is added";

    plain.materials[0].roughness = 0.1F;
    EXPECT_TRUE(needs_of(plain, false).reflections);
    plain.materials[0].alpha_mode = mesh::AlphaMode::Blend;
    EXPECT_TRUE(needs_of(plain, false).glass);

    const MeshNeeds all = needs_of(mesh::MeshData{}, true);
    EXPECT_TRUE(all.shadows && all.shadows_each_frame && all.glass && all.reflections &&
                all.depth_first);
    EXPECT_TRUE(all.skipped.empty());
}

}  // namespace
}  // namespace gazeloop::scene
