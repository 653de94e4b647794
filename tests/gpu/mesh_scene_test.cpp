// Scenes of meshes, drawn and lit: known places, known light.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "runtime/methods/registry.h"
#include "runtime/scene/mesh_scene.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/method_by_settings.h"
#include "tests/unit/scene/scene_samples.h"

namespace gazeloop::render {
namespace {

using scene::mesh::MeshData;
using scene::mesh::moved;
using scene::mesh::square;

class MeshSceneTest : public FrameRendererTest {
  protected:
    static scene::mesh::Material glowing(const glm::vec3& radiance) {
        scene::mesh::Material material;
        material.emissive = radiance;
        material.unlit = true;
        return material;
    }

    /// A matt white, lit by nothing but its lights: under a black sky.
    static MeshData dark(MeshData data) {
        data.sky = {.zenith = {}, .horizon = {}, .ground = {}};
        return data;
    }

    static Picture picture(const MeshData& data, Method method = Method::Full,
                           std::uint32_t width = 96, std::uint32_t height = 72,
                           bool require_all = false) {
        const auto made = scene::make_mesh_scene(context(), data, {.require_all = require_all});
        const MethodConfig of = config(method, width, height);
        OffScreen off_screen(context(), *made, passes_of(of), of);
        const FrameRequest asked = request(of, {width / 2.0, height / 2.0});
        off_screen.render(asked.frame_view(), asked.fovea());
        return off_screen.picture(gaze::Eye::Left);
    }

    static std::array<std::uint8_t, 3> at(const Picture& picture, std::size_t x, std::size_t y) {
        return picture.pixels[y * picture.width + x];
    }
};

/// sRGB code of a linear value.
int code(double light) {
    const double c = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * c));
}

TEST_F(MeshSceneTest, DrawsThingsWhereTheViewSeesThem) {
    const MeshData data =
        dark(square(0.5F, moved({0.3F, -0.2F, -2.0F}), glowing({0.5F, 0.25F, 1.0F})));
    const Picture seen = picture(data);
    const FrameRequest asked = request(config(Method::Full, 96, 72), {});
    const gaze::EyeView& view = asked.views[0];
    const auto corner = [&](double x, double y) {
        return gaze::project(glm::dvec3(x, y, -2.0) - view.pose.position_m, view);
    };
    const gaze::PixelPosition top_left = corner(-0.2, 0.3);
    const gaze::PixelPosition bottom_right = corner(0.8, -0.7);
    for (std::size_t y = 0; y < seen.height; ++y) {
        for (std::size_t x = 0; x < seen.width; ++x) {
            const double px = static_cast<double>(x) + 0.5;
            const double py = static_cast<double>(y) + 0.5;
            const bool inside = px > top_left.x_px && px < bottom_right.x_px &&
                                py > top_left.y_px && py < bottom_right.y_px;
            const auto is = at(seen, x, y);
            EXPECT_NEAR(is[0], inside ? code(0.5) : 0, 1) << x << " " << y;
            EXPECT_NEAR(is[1], inside ? code(0.25) : 0, 1) << x << " " << y;
            EXPECT_NEAR(is[2], inside ? 255 : 0, 1) << x << " " << y;
        }
    }
}

TEST_F(MeshSceneTest, KeepsTheNearestAndDropsBacksUnlessBothSidesShow) {
    const glm::mat4x3 turned(glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1),
                             glm::vec3(0, 0, -1));
    MeshData data = dark(square(9.0F, turned, glowing({1.0F, 0.0F, 0.0F})));
    data.instances.push_back({.world_from_local = moved({0.0F, 0.0F, -2.0F})});
    data.materials.push_back(glowing({0.0F, 1.0F, 0.0F}));
    data.primitives.push_back(data.primitives[0]);
    data.primitives[1].material = 1;
    data.levels.push_back({1, 0.0F});
    data.instances[1].first_level = 1;
    EXPECT_EQ(at(picture(data), 48, 36)[0], 0) << "its back faces the eye";
    EXPECT_EQ(at(picture(data), 48, 36)[1], 255);
    data.materials[0].double_sided = true;
    EXPECT_EQ(at(picture(data), 48, 36)[0], 255);
    // A frame that mirrors turns the winding round, and a turned front is a front again.
    data.materials[0].double_sided = false;
    data.instances[0].world_from_local[0] *= -1.0F;
    EXPECT_EQ(at(picture(data), 48, 36)[0], 0) << "mirrored in x: still the back";
    data.instances[0].world_from_local[2] *= -1.0F;
    EXPECT_EQ(at(picture(data), 48, 36)[0], 255) << "mirrored twice";
}

scene::mesh::Material matt() {
    scene::mesh::Material material;
    material.metallic = 0.0F;
    return material;
}

scene::mesh::Light sun(const glm::vec3& direction, float intensity) {
    scene::mesh::Light light;
    light.direction = glm::normalize(direction);
    light.intensity = intensity;
    return light;
}

TEST_F(MeshSceneTest, LightsMattWhiteByLambertsLaw) {
    MeshData data = dark(square(9.0F, moved({0.0F, 0.0F, -2.0F}), matt()));
    // At this angle GGX of roughness 1 adds little; white sends back about 0.96 of the light.
    data.lights = {sun({0.0F, -1.0F, -1.0F}, 1.5F)};
    const double lambert = 1.5 * std::sqrt(0.5) / 3.14159265;
    const auto lit = at(picture(data), 48, 36);
    EXPECT_NEAR(lit[1], code(lambert), 6);
    data.lights[0].direction *= -1.0F;
    EXPECT_EQ(at(picture(data), 48, 36)[1], 0) << "from behind";
    // A normal map's flat blue and an unbent normal are the same.
    data.lights[0].direction *= -1.0F;
    data.images.push_back({.width = 1, .height = 1, .texels = {}});
    for (const int texel : {128, 128, 255, 255}) {
        data.images[0].texels.push_back(static_cast<std::byte>(texel));
    }
    data.materials[0].normal_texture.image = 0;
    EXPECT_NEAR(at(picture(data), 48, 36)[1], lit[1], 1);
    // One that leans to the right by 45 degrees, and up: towards the light.
    data.images[0].texels[1] = static_cast<std::byte>(218);
    data.images[0].texels[2] = static_cast<std::byte>(218);
    EXPECT_GT(at(picture(data), 48, 36)[1], lit[1] + 15) << "green is up";
}

TEST_F(MeshSceneTest, FallsOffWithTheSquareOfDistanceAndEndsAtItsRange) {
    MeshData data = dark(square(9.0F, moved({0.0F, 0.0F, -2.0F}), matt()));
    scene::mesh::Light lamp;
    lamp.kind = scene::mesh::LightKind::Point;
    lamp.position_m = {0.0F, 0.0F, 0.0F};
    lamp.intensity = 4.0F;
    data.lights = {lamp};
    const double facing = 4.0 / 4.0 / 3.14159265;  // candela over square metres
    EXPECT_NEAR(at(picture(data), 48, 36)[1], code(facing), 8);
    data.lights[0].range_m = 1.9F;
    EXPECT_EQ(at(picture(data), 48, 36)[1], 0);
}

TEST_F(MeshSceneTest, CastsShadows) {
    MeshData data = dark(square(4.0F, moved({0.0F, 0.0F, -4.0F}), matt()));
    // Above the picture, in the way of the light to the middle.
    const MeshData blocker = square(0.5F, moved({0.0F, 2.0F, -2.0F}), matt());
    data.instances.push_back({.world_from_local = blocker.instances[0].world_from_local});
    data.instances[1].world_from_local[0] *= 0.125F;
    data.instances[1].world_from_local[1] *= 0.125F;
    data.lights = {sun({0.0F, -1.0F, -1.0F}, 2.0F)};
    for (const auto kind : {scene::mesh::LightKind::Directional, scene::mesh::LightKind::Spot}) {
        data.lights[0].kind = kind;
        data.lights[0].position_m = {0.0F, 4.0F, 0.0F};
        data.lights[0].intensity = kind == scene::mesh::LightKind::Spot ? 64.0F : 2.0F;
        data.lights[0].casts_shadow = true;
        const Picture shadowed = picture(data);
        EXPECT_LE(at(shadowed, 48, 36)[1], 2) << static_cast<int>(kind);
        EXPECT_GT(at(shadowed, 48, 58)[1], 60) << "beside it" << static_cast<int>(kind);
        data.lights[0].casts_shadow = false;
        EXPECT_GT(at(picture(data), 48, 36)[1], 60) << static_cast<int>(kind);
    }
}

TEST_F(MeshSceneTest, CutsHolesAndMixesVeils) {
    scene::mesh::Material behind = glowing({0.8F, 0.8F, 0.8F});
    MeshData data = dark(square(9.0F, moved({0.0F, 0.0F, -3.0F}), behind));
    scene::mesh::Material front = matt();
    front.base_color = {0.0F, 0.0F, 0.0F, 0.25F};
    front.alpha_mode = scene::mesh::AlphaMode::Mask;
    data.materials.push_back(front);
    data.primitives.push_back(data.primitives[0]);
    data.primitives[1].material = 1;
    data.levels.push_back({1, 0.0F});
    data.instances.push_back({.first_level = 1, .world_from_local = moved({0.0F, 0.0F, -1.0F})});
    data.lights = {sun({0.0F, 0.0F, 1.0F}, 0.0F)};
    EXPECT_EQ(at(picture(data), 48, 36)[1], code(0.8)) << "below its cutoff";
    data.materials[1].base_color.w = 0.75F;
    EXPECT_EQ(at(picture(data), 48, 36)[1], 0);
    data.materials[1].alpha_mode = scene::mesh::AlphaMode::Blend;
    data.materials[1].base_color.w = 0.5F;
    EXPECT_NEAR(at(picture(data), 48, 36)[1], code(0.8 * 0.96 * 0.5), 2) << "4 % is mirrored";
}

TEST_F(MeshSceneTest, IsTheSameByEveryMethodWherePixelsAreShadedDirectly) {
    const auto made = scene::make_scene(context(), "gallery");
    gaze::PerEye<Picture> full;
    for (const Method method : {Method::Full, Method::Kfr, Method::Acuity}) {
        MethodConfig of = config(method, 160, 120);
        of.depth_format = vk::Format::eD32Sfloat;
        OffScreen off_screen(context(), *made, passes_of(of), of);
        const FrameRequest asked = request(of, {70.5, 80.5});
        off_screen.render(asked.frame_view(), asked.fovea());
        for (const gaze::Eye eye : gaze::kEyes) {
            const Picture seen = off_screen.picture(eye);
            if (method == Method::Full) {
                full[gaze::index(eye)] = seen;
                continue;
            }
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const auto x = static_cast<std::size_t>(70 + dx);
                    const auto y = static_cast<std::size_t>(80 + dy);
                    for (std::size_t c = 0; c < 3; ++c) {
                        // 16-bit floats in between may round the other way.
                        EXPECT_NEAR(at(seen, x, y)[c], at(full[gaze::index(eye)], x, y)[c], 1);
                    }
                }
            }
        }
    }
}

// Lights and shadows are constants of the scene's shader, which every method must pass on.
TEST_F(MeshSceneTest, IsLitAlikeByEveryMethod) {
    MeshData data = dark(square(9.0F, moved({0.0F, 0.0F, -2.0F}), matt()));
    data.lights = {sun({0.0F, -1.0F, -1.0F}, 1.5F)};
    const auto made = scene::make_mesh_scene(context(), data, {});
    const MethodConfig of = config(Method::Full, 96, 72);
    const FrameRequest asked = request(of, {48.0, 36.0});
    const auto shown = [&](const std::string& method) {
        OffScreen off_screen(context(), *made, tests::passes_by(method), of);
        off_screen.render(asked.frame_view(), asked.fovea());
        return off_screen.picture(gaze::Eye::Left);
    };
    const Picture full = shown("full");
    ASSERT_GT(at(full, 48, 36)[1], 100);
    for (const std::string& method : methods::rendered_methods()) {
        const Picture picture = shown(method);
        for (const auto& [x, y] : {std::pair{48U, 36U}, {10U, 36U}, {70U, 60U}}) {
            EXPECT_NEAR(at(picture, x, y)[1], at(full, x, y)[1], 2) << method << ' ' << x;
        }
    }
}

TEST_F(MeshSceneTest, LeavesOutOnlyWhatIsNotSeen) {
    MeshData data = square(2.0F, moved({0.0F, -0.5F, -3.0F}), matt());
    data.lights = {sun({0.3F, -0.5F, -1.0F}, 2.0F)};
    data.lights[0].casts_shadow = false;
    EXPECT_LE(largest_difference(picture(data), picture(data, Method::Full, 96, 72, true)), 1);
}

/// The left eye's picture with the head turned by so much, by KFR with a coarse LP-buffer.
class FilterTest : public MeshSceneTest {
  protected:
    static MethodConfig coarse(FilterUse filter, Method method = Method::Kfr) {
        MethodConfig of = config(method, 160, 120);
        of.kfr.sigma = 3.0;
        of.lp_gaussian = filter;
        return of;
    }
    static FrameRequest turned(const MethodConfig& of, double yaw_rad) {
        FrameRequest asked = request(of, {80.0, 60.0});
        for (gaze::EyeView& view : asked.views) {
            view.pose.orientation = glm::angleAxis(yaw_rad, glm::dvec3(0.0, 1.0, 0.0));
        }
        return asked;
    }

    /// A mirror-like surface that is bent finely, under one sun: highlights of a few pixels and
    /// less.
    static MeshData rippled() {
        scene::mesh::Material glossy;
        glossy.metallic = 1.0F;
        glossy.roughness = 0.15F;
        MeshData data = dark(square(4.0F, moved({0.0F, 0.0F, -5.0F}), glossy));
        constexpr std::uint32_t kSide = 256;
        data.images.push_back({.width = kSide, .height = kSide, .texels = {}});
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                for (const double lean : {std::sin(0.7 * x), std::sin(0.7 * y)}) {
                    data.images[0].texels.push_back(
                        static_cast<std::byte>(std::lround(128 + 40 * lean)));
                }
                data.images[0].texels.push_back(std::byte{240});
                data.images[0].texels.push_back(std::byte{255});
            }
        }
        data.materials[0].normal_texture.image = 0;
        data.lights = {sun({0.1F, -0.2F, -1.0F}, 1.0F)};
        return data;
    }
};

TEST_F(FilterTest, ReadsNoCellThatWasNotShaded) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{80.0, 60.0}, {0.0, 0.0}, {-60.0, 40.0}}) {
            MethodConfig of = coarse(FilterUse::On, method);
            of.hash = true;
            const auto hash = [&](const std::array<float, 4>& unshaded) {
                of.unshaded = unshaded;
                OffScreen off_screen(context(), scene(), passes_of(of), of);
                const FrameRequest asked = request(of, fovea);
                return off_screen.render(asked.frame_view(), asked.fovea()).gpu.pixel_hash;
            };
            EXPECT_EQ(hash({0.0F, 0.0F, 0.0F, 1.0F}), hash({5e4F, 0.0F, 5e4F, 1.0F}));
        }
    }
}

TEST_F(FilterTest, IsOnlyWhereItIsAskedForOrNeeded) {
    const auto made =
        scene::make_mesh_scene(context(), square(1.0F, moved({0.0F, 0.0F, -2.0F}), matt()), {});
    const auto filters = [&](scene::Scene& of_scene, FilterUse use) {
        const MethodConfig of = coarse(use);
        return OffScreen(context(), of_scene, passes_of(of), of)
            .renderer()
            .passes()
            .find("lp_gaussian")
            .has_value();
    };
    EXPECT_TRUE(filters(*made, FilterUse::AsSceneNeeds));
    EXPECT_FALSE(filters(*made, FilterUse::Off));
    EXPECT_FALSE(filters(scene(), FilterUse::AsSceneNeeds)) << "rays are not sampled by pixels";
    EXPECT_TRUE(filters(scene(), FilterUse::On));
}

TEST_F(FilterTest, KeepsAnEvenPictureAndCalmsTheGallery) {
    const MeshData even =
        dark(square(50.0F, moved({0.0F, 0.0F, -9.0F}), glowing({0.2F, 0.4F, 0.8F})));
    for (const auto& pixel : picture(even, Method::Kfr).pixels) {
        ASSERT_NEAR(pixel[0], code(0.2), 1);
        ASSERT_NEAR(pixel[2], code(0.8), 1);
    }
    // How much pixels change while the head turns by a quarter of a pixel, root mean square: less
    // with the filter, which spreads what jumps.
    const auto gallery = scene::make_scene(context(), "gallery");
    const auto change = [&](FilterUse filter) {
        const MethodConfig of = coarse(filter);
        OffScreen off_screen(context(), *gallery, passes_of(of), of);
        std::array<Picture, 2> seen;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const FrameRequest asked = turned(of, 0.3 + 0.0025 * static_cast<double>(i));
            off_screen.render(asked.frame_view(), asked.fovea());
            seen.at(i) = off_screen.picture(gaze::Eye::Left);
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < seen[0].pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double jump = seen[0].pixels[i][c] - seen[1].pixels[i][c];
                sum += jump * jump;
            }
        }
        return std::sqrt(sum / static_cast<double>(3 * seen[0].pixels.size()));
    };
    const double without = change(FilterUse::Off);
    const double with = change(FilterUse::On);
    RecordProperty("without", std::to_string(without));
    RecordProperty("with", std::to_string(with));
    EXPECT_LT(with, 0.85 * without) << "codes of 255";
}

// The flicker of Meng et al. 2018, Fig. 13: what foveation makes of small highlights.
TEST_F(FilterTest, CalmsHighlights) {
    const MeshData data = rippled();
    // How much the picture changes while the head turns by a quarter of a pixel, over how bright it
    // is: wider highlights are more pixels, each dimmer.
    const auto change = [&](const scene::SceneOptions& options, Method method) {
        const auto made = scene::make_mesh_scene(context(), data, options);
        const MethodConfig of = coarse(FilterUse::Off, method);
        OffScreen off_screen(context(), *made, passes_of(of), of);
        std::array<Picture, 2> seen;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const FrameRequest asked = turned(of, 0.0025 * static_cast<double>(i));
            off_screen.render(asked.frame_view(), asked.fovea());
            seen.at(i) = off_screen.picture(gaze::Eye::Left);
        }
        double changes = 0.0;
        double codes = 0.0;
        for (std::size_t i = 0; i < seen[0].pixels.size(); ++i) {
            changes += std::abs(seen[0].pixels[i][1] - seen[1].pixels[i][1]);
            codes += seen[0].pixels[i][1];
        }
        return changes / codes;
    };
    const double bare = change({.specular_filter = false}, Method::Full);
    const double by_pixel = change({}, Method::Full);
    EXPECT_LT(by_pixel, 0.8 * bare) << "full resolution";
    const double amplified = change({}, Method::Kfr);
    const double by_sample = change({.footprint = true}, Method::Kfr);
    EXPECT_LT(by_sample, 0.7 * amplified) << "KFR";
    RecordProperty("changes", std::to_string(bare) + " " + std::to_string(by_pixel) + " " +
                                  std::to_string(amplified) + " " + std::to_string(by_sample));
}

TEST_F(FilterTest, HighlightsOfAFlatSurfaceStayAsTheyAre) {
    MeshData data = rippled();
    data.materials[0].normal_texture = {};
    for (const Method method : {Method::Full, Method::Kfr, Method::Acuity}) {
        const auto seen = [&](const scene::SceneOptions& options) {
            const auto made = scene::make_mesh_scene(context(), data, options);
            const MethodConfig of = coarse(FilterUse::Off, method);
            OffScreen off_screen(context(), *made, passes_of(of), of);
            const FrameRequest asked = turned(of, 0.0);
            off_screen.render(asked.frame_view(), asked.fovea());
            return off_screen.picture(gaze::Eye::Left);
        };
        const Picture plain = seen({});
        EXPECT_LE(largest_difference(seen({.footprint = true}), plain), 1);
        EXPECT_LE(largest_difference(seen({.specular_filter = false}), plain), 1);
    }
}

TEST_F(MeshSceneTest, RefusesBrokenData) {
    MeshData data = square(1.0F, moved({}), matt());
    data.indices[0] = 77;
    EXPECT_THROW(scene::make_mesh_scene(context(), data, {}), SetupError);
}

}  // namespace
}  // namespace gazeloop::render
