#include "runtime/scene/gallery/gallery_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/eye_camera.h"
#include "runtime/scene/gallery/gallery_materials.h"
#include "runtime/scene/gallery/gallery_textures.h"
#include "runtime/scene/gallery/parametric_surface.h"
#include "runtime/scene/mesh/check_mesh_data.h"
#include "runtime/scene/mesh/clusters.h"

namespace gazeloop::scene::gallery {
namespace {

const mesh::MeshData& gallery() {
    static const mesh::MeshData kMade = gallery_scene();
    return kMade;
}

gaze::EyeView eye_view() {
    const double half_height_rad = std::atan(std::tan(0.8) * 1080.0 / 1920.0);
    return {
        .fov = {-0.8, 0.8, half_height_rad, -half_height_rad}, .width_px = 1920, .height_px = 1080};
}

TEST(Gallery, IsSound) {
    const auto checked = mesh::check_mesh_data(gallery());
    EXPECT_TRUE(checked.has_value()) << checked.error().message;
}

TEST(Gallery, HasFourHundredObjectsOnATerrainOfTwentyThousandTriangles) {
    std::size_t objects = 0;
    std::size_t terrain = 0;
    for (const mesh::Instance& instance : gallery().instances) {
        const auto& primitive =
            gallery().primitives[gallery().levels[instance.first_level].primitive];
        if (primitive.material == ground_material()) {
            terrain += primitive.index_count / 3;
        } else {
            ++objects;
            EXPECT_LE(primitive.index_count / 3, kFinestTriangles);
            EXPECT_GT(primitive.index_count / 3, kFinestTriangles * 95 / 100);
        }
    }
    EXPECT_EQ(objects, 400U);
    EXPECT_EQ(terrain, 20000U);
}

TEST(Gallery, ShowsAQuarterOfAMillionTriangles) {
    const gaze::EyeView view = eye_view();
    std::vector<mesh::Draw> draws;
    mesh::DrawList(gallery()).choose(frustum_of(view), [](std::uint32_t) { return true; }, draws);
    // Triangles that face the eye and have a corner in the picture.
    const glm::mat4 clip_from_world = view_uniforms(view).clip_from_world;
    std::size_t visible = 0;
    for (const mesh::Draw& draw : draws) {
        const mesh::Primitive& primitive = gallery().primitives[draw.primitive];
        for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
            std::array<glm::vec3, 3> corners{};
            bool inside = false;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t index = gallery().indices[primitive.first_index + i + k];
                corners.at(k) =
                    gallery().instances[draw.instance].world_from_local *
                    glm::vec4(gallery().vertices[primitive.first_vertex + index].position_m, 1.0F);
                const glm::vec4 clip = clip_from_world * glm::vec4(corners.at(k), 1.0F);
                inside = inside ||
                         (clip.w > 0.0F && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w);
            }
            const glm::vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            visible += inside && glm::dot(across, corners[0]) < 0.0F ? 1U : 0U;
        }
    }
    EXPECT_GE(visible, 250000U);
    EXPECT_LE(visible, 500000U) << "more only costs";
}

TEST(Clusters, LeaveOutOnlyWhatTurnsItsBack) {
    const mesh::Clusters clusters(gallery());
    std::vector<std::uint32_t> kept(3 * std::size_t{kFinestTriangles});
    std::size_t all = 0;
    std::size_t left = 0;
    for (std::uint32_t number = 0; number < gallery().primitives.size(); number += 8) {
        const mesh::Primitive& primitive = gallery().primitives[number];
        for (const glm::vec3& eye_m :
             {glm::vec3(3, 0, 0), glm::vec3(-0.4, 2, 7), glm::vec3(0), glm::vec3(0, -0.9, 0.1)}) {
            const auto count = clusters.facing(number, {.eye_m = eye_m}, kept);
            ASSERT_TRUE(count.has_value());
            const auto faces = [&](const std::uint32_t* triangle) {
                const auto at = [&](int k) {
                    return glm::dvec3(
                        gallery().vertices[primitive.first_vertex + triangle[k]].position_m);
                };
                return glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)),
                                at(0) - glm::dvec3(eye_m)) < -1e-12;
            };
            std::size_t should = 0;
            std::size_t does = 0;
            for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
                should += faces(&gallery().indices[primitive.first_index + i]) ? 1U : 0U;
            }
            for (std::uint32_t i = 0; i < *count; i += 3) {
                does += faces(&kept[i]) ? 1U : 0U;
            }
            EXPECT_EQ(does, should) << "primitive " << number;
            all += primitive.index_count;
            left += *count;
        }
    }
    EXPECT_LT(left, all * 8 / 10) << "it is of use";
    EXPECT_FALSE(
        clusters.facing(0, {.eye_m = {3.0F, 0.0F, 0.0F}}, std::span(kept).first(30)).has_value());
}

TEST(Clusters, LeaveOutOnlyWhatLiesBesideThePicture) {
    const mesh::Clusters clusters(gallery());
    std::vector<std::uint32_t> kept(3 * std::size_t{kFinestTriangles});
    // Turned, mirrored, unevenly scaled and moved, so that a plane of the wrong frame shows.
    const glm::mat4x3 frame(glm::vec3(0.0F, 0.0F, -2.0F), glm::vec3(0.0F, -0.5F, 0.0F),
                            glm::vec3(0.7F, 0.0F, 0.0F), glm::vec3(3.0F, -1.0F, 0.5F));
    std::size_t left = 0;
    std::size_t all = 0;
    for (std::uint32_t number = 0; number < gallery().primitives.size(); number += 8) {
        const mesh::Primitive& primitive = gallery().primitives[number];
        const glm::vec3 middle =
            frame * glm::vec4(0.5F * (primitive.bounds.low_m + primitive.bounds.high_m), 1.0F);
        for (const glm::vec3& inwards :
             {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0.6F, 0.8F)}) {
            // Everything on one side of its middle; from an eye inside, which sees fronts or backs.
            mesh::Frustum frustum{.eye_m = middle};
            frustum.planes[3] = glm::vec4(inwards, -glm::dot(inwards, middle));
            mesh::Clusters::View view = mesh::Clusters::view_of(frustum, frame);
            const mesh::Clusters::View everywhere{.eye_m = view.eye_m};
            const auto of_all = clusters.facing(number, everywhere, kept);
            const std::vector<std::uint32_t> whole(kept.begin(), kept.begin() + of_all.value_or(0));
            const auto count = clusters.facing(number, view, kept);
            ASSERT_TRUE(count.has_value());
            const auto reaches_in = [&](const std::uint32_t* triangle) {
                return std::any_of(triangle, triangle + 3, [&](std::uint32_t index) {
                    const glm::vec3 at =
                        frame *
                        glm::vec4(gallery().vertices[primitive.first_vertex + index].position_m,
                                  1.0F);
                    return glm::dot(inwards, at - middle) > 1e-4F;
                });
            };
            const auto inside = [&](std::span<const std::uint32_t> indices) {
                std::size_t sum = 0;
                for (std::size_t i = 0; i < indices.size(); i += 3) {
                    sum += reaches_in(&indices[i]) ? 1U : 0U;
                }
                return sum;
            };
            EXPECT_EQ(inside(std::span(kept).first(*count)), inside(whole)) << number;
            left += *count;
            all += whole.size();
        }
    }
    EXPECT_LT(left, all * 8 / 10) << "it is of use";
}

TEST(Gallery, GoesFromDiffuseToMirrorAndGlass) {
    const auto any = [](auto holds) { return std::ranges::any_of(gallery().materials, holds); };
    EXPECT_TRUE(any([](const auto& m) { return m.metallic == 0.0F && m.roughness == 1.0F; }));
    EXPECT_TRUE(any([](const auto& m) { return m.metallic == 1.0F && m.roughness < 0.05F; }));
    EXPECT_TRUE(any([](const auto& m) { return m.transmission == 1.0F; }));
    EXPECT_TRUE(any([](const auto& m) { return m.emissive.x > 0.0F; }));
    EXPECT_TRUE(any([](const auto& m) { return m.normal_texture.image != mesh::kNone; }));
    // Every one of them is somewhere to be seen.
    std::vector<bool> used(gallery().materials.size());
    for (const mesh::Instance& instance : gallery().instances) {
        used[gallery().primitives[gallery().levels[instance.first_level].primitive].material] =
            true;
    }
    EXPECT_TRUE(std::ranges::all_of(used, [](bool is) { return is; }));
}

TEST(ParametricSurface, IsTessellatedFromOutsideAndClosed) {
    for (const ParametricSurface& surface : parametric_surfaces()) {
        for (const std::uint32_t triangles : {20000U, 5000U, 600U}) {
            const Tessellation made = tessellate(surface, triangles);
            EXPECT_LE(made.indices.size() / 3, triangles) << surface.name;
            EXPECT_GT(made.indices.size() / 3, triangles * 8 / 10) << surface.name;
            double volume = 0.0;
            glm::dvec3 area(0.0);
            std::size_t with_normal = 0;
            for (std::size_t i = 0; i < made.indices.size(); i += 3) {
                std::array<glm::dvec3, 3> p{};
                glm::dvec3 normals(0.0);
                for (std::size_t k = 0; k < 3; ++k) {
                    const mesh::Vertex& vertex = made.vertices[made.indices[i + k]];
                    p.at(k) = vertex.position_m;
                    normals += vertex.normal;
                }
                const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
                volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6.0;
                area += across;
                with_normal += glm::dot(across, normals) > 0.0 ? 1U : 0U;
            }
            EXPECT_GT(volume, 0.05) << surface.name << ": inside out";
            EXPECT_LT(glm::length(area), 1e-3) << surface.name << ": open";
            EXPECT_GT(with_normal, made.indices.size() / 3 * 97 / 100) << surface.name;
        }
        EXPECT_GT(tessellate(surface, 300).error_m, tessellate(surface, 20000).error_m);
    }
}

TEST(GalleryTextures, AreSeamless) {
    for (const Pattern pattern :
         {Pattern::Plaster, Pattern::Stone, Pattern::Brick, Pattern::Wood, Pattern::Tile,
          Pattern::Hammered, Pattern::Brushed, Pattern::Ground}) {
        constexpr std::uint32_t kSize = 128;
        const PatternImages images = paint(pattern, kSize);
        // Steps across the seam are like those inside, in the mean.
        const auto step = [&](std::uint32_t column, std::uint32_t next) {
            double sum = 0.0;
            for (std::uint32_t y = 0; y < kSize; ++y) {
                const auto at = [&](std::uint32_t x) {
                    return std::to_integer<int>(
                        images.color.texels[4 * (std::size_t{y} * kSize + x) + 1]);
                };
                sum += std::abs(at(column) - at(next));
            }
            return sum / kSize;
        };
        double most_inside = 0.0;
        for (std::uint32_t x = 0; x + 1 < kSize; ++x) {
            most_inside = std::max(most_inside, step(x, x + 1));
        }
        EXPECT_LE(step(kSize - 1, 0), most_inside + 1.0) << static_cast<int>(pattern);
    }
}

}  // namespace
}  // namespace gazeloop::scene::gallery
