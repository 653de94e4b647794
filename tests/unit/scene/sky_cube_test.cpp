#include "runtime/scene/sky/sky_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gazeloop::scene::sky {
namespace {

TEST(SkyCube, OfAnEvenSkyIsEven) {
    mesh::Sky even;
    even.zenith = even.horizon = even.ground = {0.25F, 0.5F, 1.0F};
    const SkyCube cube = bake(even);
    for (std::uint32_t level = 0; level < SkyCube::kLevels; ++level) {
        const std::uint32_t face = SkyCube::face_of(level);
        ASSERT_EQ(cube.levels.at(level).size(), std::size_t{6} * face * face);
        for (const glm::vec3& texel : cube.levels.at(level)) {
            ASSERT_NEAR(texel.y, 0.5F, 1e-4F);
        }
    }
    for (const glm::vec3& normal :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.6, 0, 0.8)}) {
        const glm::vec3 sent = diffuse_at(cube.diffuse, normal);
        EXPECT_NEAR(sent.x, 0.25F, 1e-4F);
        EXPECT_NEAR(sent.z, 1.0F, 1e-4F);
    }
}

/// What white sends back, by the integral itself.
glm::dvec3 integrated(const mesh::Sky& sky, const glm::dvec3& normal) {
    constexpr int kSteps = 400;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i) {
        const double y = 2.0 * (i + 0.5) / kSteps - 1.0;
        for (int j = 0; j < kSteps; ++j) {
            const double around = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
            const double flat = std::sqrt(1.0 - y * y);
            const glm::dvec3 d(flat * std::cos(around), y, flat * std::sin(around));
            sum += glm::dvec3(radiance(sky, glm::vec3(d))) * std::max(0.0, glm::dot(d, normal));
        }
    }
    return sum * (4.0 / (double{kSteps} * kSteps));
}

TEST(SkyCube, LightsDiffuseSurfacesAsTheIntegralSays) {
    mesh::Sky sky;
    const SkyCube cube = bake(sky);
    for (const glm::dvec3& normal : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0),
                                     glm::dvec3(0.8, 0.6, 0), glm::dvec3(0, 0, 1)}) {
        const glm::dvec3 right = integrated(sky, normal);
        const glm::vec3 sent = diffuse_at(cube.diffuse, glm::vec3(normal));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sent[c], right[c], 0.012) << "order 2 leaves that much";
        }
    }
}

TEST(SkyCube, HasSixFacesThatMeet) {
    // Top right corner of each side face, seen from inside, is the next one's top left.
    for (const auto& [face, next] : {std::pair{4U, 0U}, {0U, 5U}, {5U, 1U}, {1U, 4U}}) {
        for (const float t : {0.0F, 0.3F, 1.0F}) {
            const glm::vec3 here = cube_direction(face, 1.0F, t);
            const glm::vec3 there = cube_direction(next, 0.0F, t);
            EXPECT_LT(glm::length(here - there), 1e-6F) << face;
        }
    }
    EXPECT_GT(cube_direction(2, 0.5F, 0.5F).y, 0.9F);
    EXPECT_LT(cube_direction(3, 0.5F, 0.5F).y, -0.9F);
}

TEST(SkyCube, IsFiniteAndNotNegativeEverywhere) {
    mesh::Sky sky;
    sky.clouds = 1.0F;
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (float s = 0.0F; s <= 1.0F; s += 0.05F) {
            for (float t = 0.0F; t <= 1.0F; t += 0.05F) {
                const glm::vec3 seen = radiance(sky, glm::normalize(cube_direction(face, s, t)));
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(seen[c]));
                    ASSERT_GE(seen[c], 0.0F);
                }
            }
        }
    }
}

}  // namespace
}  // namespace gazeloop::scene::sky
