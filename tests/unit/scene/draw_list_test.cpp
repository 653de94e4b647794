#include "runtime/scene/mesh/draw_list.h"

#include <gtest/gtest.h>

#include "runtime/scene/mesh/shadow_view.h"
#include "tests/unit/scene/scene_samples.h"

namespace gazeloop::scene::mesh {
namespace {

/// Everything before the plane z = 0, seen from the origin.
Frustum ahead() {
    Frustum frustum;
    frustum.planes.fill({0.0F, 0.0F, -1.0F, 0.0F});
    return frustum;
}

std::vector<Draw> chosen(const MeshData& data, const Frustum& frustum) {
    std::vector<Draw> draws;
    DrawList(data).choose(frustum, [](std::uint32_t) { return true; }, draws);
    return draws;
}

TEST(DrawList, LeavesOutWhatCannotBeSeenAndBeginsWithTheNearest) {
    MeshData data = square(1.0F, moved({0.0F, 0.0F, -9.0F}));
    for (const float z_m : {5.0F, -3.0F, 1.2F}) {  // a radius of 1.41 m reaches over from 1.2 m
        data.instances.push_back({.world_from_local = moved({0.0F, 0.0F, z_m})});
    }
    const auto draws = chosen(data, ahead());
    ASSERT_EQ(draws.size(), 3U);
    EXPECT_EQ(draws[0].instance, 3U);
    EXPECT_EQ(draws[1].instance, 2U);
    EXPECT_EQ(draws[2].instance, 0U);
}

TEST(DrawList, TakesTheCoarsestFormThatIsExactEnough) {
    MeshData data = square(1.0F, moved({0.0F, 0.0F, -11.4142F}));  // its nearest point 10 m away
    data.primitives.resize(3, data.primitives[0]);
    data.levels = {{0, 0.5F}, {1, 1.0F}, {2, 2.0F}};
    data.instances[0].level_count = 3;
    const auto form = [&](float error_m, float error_per_m, float scale = 1.0F) {
        MeshData scaled = data;
        for (int axis = 0; axis < 3; ++axis) {
            scaled.instances[0].world_from_local[axis] *= scale;
        }
        Frustum frustum = ahead();
        frustum.error_m = error_m;
        frustum.error_per_m = error_per_m;
        return chosen(scaled, frustum)[0].primitive;
    };
    EXPECT_EQ(form(0.0F, 0.0F), 0U) << "the finest there is, however inexact";
    EXPECT_EQ(form(0.99F, 0.0F), 0U);
    EXPECT_EQ(form(1.01F, 0.0F), 1U);
    EXPECT_EQ(form(0.0F, 0.101F), 1U);
    EXPECT_EQ(form(0.0F, 0.201F), 2U);
    EXPECT_EQ(form(1.01F, 0.0F, 2.0F), 0U) << "errors grow with the thing";
}

TEST(DrawList, MeasuresWhatIsNotOutOfScale) {
    MeshData data = square(0.5F, moved({1.0F, 0.0F, 0.0F}));
    for (int i = 1; i < 20; ++i) {
        data.instances.push_back({.world_from_local = moved({1.0F, 0.0F, 0.0F})});
    }
    data.instances[0].world_from_local[0] *= 1e4F;
    const glm::vec4 sphere = DrawList(data).main_sphere();
    EXPECT_NEAR(sphere.x, 1.0F, 1e-4F);
    EXPECT_NEAR(sphere.w, 0.7071F, 1e-3F);
    EXPECT_EQ(DrawList(MeshData{}).main_sphere().w, 0.0F);
}

glm::vec3 seen(const ShadowView& view, const glm::vec3& point_m) {
    const glm::vec4 clip = view.clip_from_world * glm::vec4(point_m, 1.0F);
    return glm::vec3(clip) / clip.w;
}

TEST(ShadowView, OfTheSunHoldsItsSphere) {
    Light sun;
    sun.direction = glm::normalize(glm::vec3(-0.3F, -0.8F, 0.2F));
    const auto views = shadow_views(sun, {1.0F, 2.0F, 3.0F, 5.0F}, {1.0F, 0.0F, 0.0F, 20.0F}, 1000);
    ASSERT_EQ(views.size(), 2U);
    EXPECT_FLOAT_EQ(views[0].texel_m, 0.01F);
    EXPECT_FLOAT_EQ(views[1].texel_m, 0.04F);
    const glm::vec3 centre(1.0F, 2.0F, 3.0F);
    EXPECT_NEAR(seen(views[0], centre).x, 0.0F, 1e-5F);
    EXPECT_NEAR(seen(views[0], centre).y, 0.0F, 1e-5F);
    const float before = seen(views[0], centre - 4.9F * sun.direction).z;
    const float behind = seen(views[0], centre + 4.9F * sun.direction).z;
    EXPECT_GT(before, behind) << "nearer the light is greater";
    EXPECT_GT(behind, 0.0F);
    EXPECT_LT(before, 1.0F);
    const glm::vec3 aside = glm::normalize(glm::cross(sun.direction, glm::vec3(0.0F, 1.0F, 0.0F)));
    EXPECT_NEAR(seen(views[0], centre + 5.0F * aside).x, 1.0F, 1e-5F);
}

TEST(ShadowView, OfASpotHoldsItsCone) {
    Light spot;
    spot.kind = LightKind::Spot;
    spot.position_m = {2.0F, 3.0F, 4.0F};
    spot.direction = {0.0F, -1.0F, 0.0F};
    spot.range_m = 10.0F;
    spot.outer_cone_rad = 0.5F;
    const auto views = shadow_views(spot, {}, {}, 2048);
    ASSERT_EQ(views.size(), 1U);
    EXPECT_NEAR(seen(views[0], {2.0F, 2.9F, 4.0F}).z, 1.0F, 1e-4F);
    EXPECT_NEAR(seen(views[0], {2.0F, -7.0F, 4.0F}).z, 0.0F, 1e-4F);
    const glm::vec3 rim = seen(views[0], {2.0F + 5.0F * std::tan(0.5F), -2.0F, 4.0F});
    EXPECT_NEAR(std::max(std::abs(rim.x), std::abs(rim.y)), 1.0F, 1e-4F);
    const glm::vec3 behind = spot.position_m + glm::vec3(0.0F, 1.0F, 0.0F);
    bool outside = false;
    for (const glm::vec4& plane : views[0].frustum.planes) {
        outside = outside || glm::dot(glm::vec3(plane), behind) + plane.w < 0.0F;
    }
    EXPECT_TRUE(outside);
}

TEST(ShadowView, OfAPointThereIsNone) {
    Light point;
    point.kind = LightKind::Point;
    EXPECT_TRUE(shadow_views(point, {}, {}, 2048).empty());
}

}  // namespace
}  // namespace gazeloop::scene::mesh
