// Light fields: what a lens shows of one whose content is known, one that was baked, and 3D-KFR of
// both.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>

#include "runtime/error.h"
#include "runtime/render/srgb.h"
#include "runtime/scene/light_field_scene.h"
#include "runtime/scene/view_stream.h"
#include "sim/baked_light_field.h"
#include "sim/light_field_baker.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/method_by_settings.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::render {
namespace {

using Settings = std::vector<NamedValue>;

constexpr double kPlane_m = 2.0;  ///< distance of the known content
constexpr std::uint32_t kViewSize = 64;

/// Linear radiance of a point of the plane: smooth over a texel, which is 1/16 m there.
double content(const glm::dvec2& point_m) {
    return 0.4 + 0.2 * std::sin(4.0 * point_m.x) + 0.15 * std::cos(3.0 * point_m.y + 1.0);
}

/// Views of the plane from 5 x 5 cameras.
scene::LightFieldSource known_views() {
    scene::LightFieldSource field{.name = "the plane",
                                  .cameras = {.columns = 5, .rows = 5, .spacing_m = 0.05},
                                  .width_px = kViewSize,
                                  .height_px = kViewSize,
                                  .read = {}};
    std::vector<scene::LightFieldSource::Texels> views;
    for (std::uint32_t view = 0; view < field.cameras.count(); ++view) {
        const glm::dvec2 camera_m = field.cameras.camera_m(view % 5, view / 5);
        scene::LightFieldSource::Texels& texels = views.emplace_back();
        for (std::uint32_t y = 0; y < kViewSize; ++y) {
            for (std::uint32_t x = 0; x < kViewSize; ++x) {
                const glm::dvec2 tangents{(x + 0.5) / kViewSize * 2.0 - 1.0,
                                          1.0 - (y + 0.5) / kViewSize * 2.0};
                const double light = content(camera_m + kPlane_m * tangents);
                const auto code = static_cast<std::byte>(std::lround(255.0 * srgb_encoded(light)));
                texels.insert(texels.end(), {code, code, code, std::byte{255}});
            }
        }
    }
    field.read = [views](const scene::LightFieldSource::Prepare& prepare,
                         const scene::LightFieldSource::Take& take) -> Expected<void> {
        for (std::uint32_t view = 0; view < views.size(); ++view) {
            if (auto taken = take(view, prepare ? prepare(views[view]) : views[view]); !taken) {
                return taken;
            }
        }
        return {};
    };
    return field;
}

class LightField : public FrameRendererTest {
  protected:
    static RendererConfig pictures(std::uint32_t width, std::uint32_t height) {
        RendererConfig config;
        config.extents = {vk::Extent2D(width, height), vk::Extent2D(width, height)};
        config.hash = true;
        return config;
    }

    /// Both eyes near `eye_m`, looking straight ahead.
    static FrameRequest look(const RendererConfig& config, const glm::dvec3& eye_m,
                             gaze::PixelPosition fovea, double half_rad = 0.6) {
        FrameRequest request;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            request.views[e] = {.pose = {.position_m = eye_m},
                                .fov = {-half_rad, half_rad, half_rad, -half_rad},
                                .width_px = config.extents[e].width,
                                .height_px = config.extents[e].height};
            request.foveae[e] = fovea;
            request.gaze_directions[e] = gaze::unproject(fovea, request.views[e]);
        }
        return request;
    }

    struct Shown {
        LinearPicture linear;
        Picture picture;
        std::uint64_t hash = 0;
        frame::SampleCounts counts;
    };
    static Shown show(scene::Scene& scene, std::string_view method, const Settings& set,
                      const RendererConfig& config, const FrameRequest& request) {
        OffScreen off_screen(context(), scene, tests::passes_by(method, set), config);
        const auto done = off_screen.render(request.frame_view(), request.fovea());
        return {off_screen.linear_picture(gaze::Eye::Left), off_screen.picture(gaze::Eye::Left),
                done.gpu.pixel_hash.value_or(0), done.counts};
    }

    static std::unique_ptr<scene::Scene> known(const light_field::Lens& lens,
                                               const scene::LightFieldMemory& memory = {}) {
        return scene::make_light_field_scene(context(), known_views(), lens, memory);
    }

    /// The greatest difference from the plane itself.
    static double error(const LinearPicture& shown, const FrameRequest& request) {
        double most = 0.0;
        const gaze::EyeView& view = request.views[0];
        for (std::uint32_t y = 0; y < shown.height; ++y) {
            for (std::uint32_t x = 0; x < shown.width; ++x) {
                const glm::dvec3 ray = gaze::unproject({x + 0.5, y + 0.5}, view);
                const glm::dvec3 from = view.pose.position_m;
                const glm::dvec3 hit = from + (kPlane_m + from.z) / -ray.z * ray;
                const double light = shown.pixels[std::size_t{y} * shown.width + x].y;
                most = std::max(most, std::abs(light - content(glm::dvec2(hit))));
            }
        }
        return most;
    }
};

constexpr double kCodes = 0.012;  ///< two 8-bit codes, of light up to .75

// Focused on what is there, the picture is that of the plane, through any lens and from anywhere.
TEST_F(LightField, IsSharpOnItsFocalPlane) {
    const RendererConfig config = pictures(48, 40);
    for (const double aperture_m : {0.0, 0.03, 1.0}) {
        const auto scene = known({.focus_m = kPlane_m, .aperture_m = aperture_m});
        for (const glm::dvec3& eye_m :
             {glm::dvec3{0.0}, glm::dvec3{0.013, -0.021, 0.0}, glm::dvec3{-0.05, 0.04, 0.3},
              glm::dvec3{0.02, 0.0, -0.4}}) {
            const FrameRequest at = look(config, eye_m, {24, 20});
            EXPECT_LT(error(show(*scene, "full", {}, config, at).linear, at), kCodes)
                << aperture_m << ' ' << eye_m.x;
        }
    }
}

TEST_F(LightField, IsBlurredElsewhereByAWideLens) {
    const RendererConfig config = pictures(48, 40);
    const FrameRequest at = look(config, {}, {24, 20});
    const auto blurred = known({.focus_m = 0.3, .aperture_m = 1.0});
    const auto sharp = known({.focus_m = 0.3, .aperture_m = 0.0});
    EXPECT_GT(error(show(*blurred, "full", {}, config, at).linear, at), 3.0 * kCodes);
    EXPECT_LT(error(show(*sharp, "full", {}, config, at).linear, at), kCodes);
}

TEST_F(LightField, IsBlackBeyondItsViewsAndBehind) {
    const RendererConfig config = pictures(32, 32);
    const auto scene = known({.focus_m = kPlane_m, .aperture_m = 0.0});
    const FrameRequest wide = look(config, {}, {16, 16}, 1.2);
    const Picture shown = show(*scene, "full", {}, config, wide).picture;
    EXPECT_EQ(shown.pixels[0], (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_GT(shown.pixels[16 * 32 + 16][1], 100);
    FrameRequest behind = look(config, {}, {16, 16});
    for (gaze::EyeView& view : behind.views) {
        view.pose.orientation = {0.0, 0.0, 1.0, 0.0};  // half a turn about y
    }
    for (const auto& pixel : show(*scene, "full", {}, config, behind).picture.pixels) {
        ASSERT_EQ(pixel, (std::array<std::uint8_t, 3>{0, 0, 0}));
    }
}

TEST_F(LightField, OfNoWeightIsLeftOutWithoutATrace) {
    const RendererConfig config = pictures(48, 40);
    const FrameRequest at = look(config, {0.02, 0.01, 0.0}, {30, 20});
    light_field::Lens lens{.focus_m = 1.0, .aperture_m = 0.04};
    const auto needed = known(lens);
    lens.every_view = true;
    const auto all = known(lens);
    for (const char* const method : {"full", "kfr", "kfr3d"}) {
        EXPECT_EQ(largest_difference(show(*needed, method, {}, config, at).picture,
                                     show(*all, method, {}, config, at).picture),
                  0)
            << method;
    }
}

TEST_F(LightField, IsShownByEveryMethodOnASmoothPlane) {
    const RendererConfig config = pictures(96, 80);
    const auto scene = known({.focus_m = kPlane_m, .aperture_m = 1.0});
    const FrameRequest at = look(config, {0.01, 0.0, 0.0}, {60, 30});
    const Picture full = show(*scene, "full", {}, config, at).picture;
    for (const char* const method : {"acuity", "layers", "quad"}) {
        EXPECT_LE(largest_difference(show(*scene, method, {}, config, at).picture, full), 6)
            << method;
    }
    // Periphery this small is blurred by both; IsThePictureOfAllViewsWhateverTheRegions is exact.
    for (const auto& [method, mean] : {std::pair{"kfr", 3.0}, {"kfr3d", 7.0}}) {
        const Picture shown = show(*scene, method, {}, config, at).picture;
        double sum = 0.0;
        for (std::size_t i = 0; i < full.pixels.size(); ++i) {
            sum += std::abs(shown.pixels[i][1] - full.pixels[i][1]);
        }
        EXPECT_LE(sum / static_cast<double>(full.pixels.size()), mean) << method;
    }
}

// Where all regions have the same sigma, none may be forgotten or summed twice.
TEST_F(LightField, IsThePictureOfAllViewsWhateverTheRegions) {
    const RendererConfig config = pictures(96, 80);
    const auto scene = known({.focus_m = kPlane_m, .aperture_m = 1.0});
    for (const gaze::PixelPosition fovea : {gaze::PixelPosition{60, 30}, {90, 5}, {-20, 40}}) {
        const FrameRequest at = look(config, {0.01, 0.0, 0.0}, fovea);
        const auto of_regions = [&](const char* regions) {
            return show(*scene, "kfr3d",
                        {{"kfr.sigma", "0.5"}, {"kfr3d.growth", "1"}, {"kfr3d.regions", regions}},
                        config, at)
                .picture;
        };
        const Picture one = of_regions("1");
        for (const char* const regions : {"2", "3", "4"}) {
            EXPECT_LE(largest_difference(of_regions(regions), one), 1) << regions << fovea.x_px;
        }
        if (fovea.x_px == 60) {
            EXPECT_LE(largest_difference(one, show(*scene, "full", {}, config, at).picture), 2);
        }
    }
}

// With one region, 3D-KFR is KFR on every view.
TEST_F(LightField, ByOneRegionIsKfr) {
    const RendererConfig config = pictures(96, 80);
    const auto scene = known({.focus_m = 1.0, .aperture_m = 1.0});
    for (const gaze::PixelPosition fovea : {gaze::PixelPosition{48, 40}, {90, 5}, {-20, 40}}) {
        const FrameRequest at = look(config, {}, fovea);
        const Shown one = show(*scene, "kfr3d", {{"kfr3d.regions", "1"}}, config, at);
        const Shown kfr = show(*scene, "kfr", {}, config, at);
        // Sums in another order may round the other way.
        EXPECT_LE(largest_difference(one.picture, kfr.picture), 1);
        EXPECT_EQ(one.counts.shaded(), kfr.counts.shaded());
    }
}

TEST_F(LightField, By3dKfrReadsNothingThatWasNotShadedAndIsExactInTheDisc) {
    RendererConfig config = pictures(96, 80);
    const auto scene = known({.focus_m = 0.7, .aperture_m = 0.08});
    for (const char* const regions : {"2", "3", "4"}) {
        const Settings set{{"kfr3d.regions", regions}, {"kfr3d.inner", "0.2"}};
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{48, 40}, {95, 79}, {0, 40}, {300, 10}}) {
            const FrameRequest at = look(config, {0.03, -0.03, 0.0}, fovea);
            config.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
            const Shown on_black = show(*scene, "kfr3d", set, config, at);
            config.unshaded = {5e4F, 0.0F, 5e4F, 1.0F};
            EXPECT_EQ(show(*scene, "kfr3d", set, config, at).hash, on_black.hash);
            if (fovea.x_px < 96) {
                const auto pixel = static_cast<std::size_t>(std::min(fovea.y_px, 79.0)) * 96 +
                                   static_cast<std::size_t>(std::min(fovea.x_px, 95.0));
                const Picture full = show(*scene, "full", {}, config, at).picture;
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(on_black.picture.pixels[pixel][c], full.pixels[pixel][c], 1);
                }
            }
        }
    }
}

/// What so many views of the plane take, with the four that they are loaded through.
constexpr std::uint64_t room_for(std::uint32_t views) {
    return (views + 4) * std::uint64_t{4} * kViewSize * kViewSize;
}

/// Eyes that wander over the cameras, and jump back.
std::vector<glm::dvec3> wandering() {
    std::vector<glm::dvec3> eyes;
    for (int i = 0; i < 24; ++i) {
        eyes.emplace_back(0.11 * std::sin(0.7 * i), 0.11 * std::cos(0.5 * i), 0.0);
        if (i % 6 == 5) {
            eyes.emplace_back(-0.1, 0.1, 0.0);
        }
    }
    return eyes;
}

// Views that come and go change no pixel, whoever draws; and what was promised of memory holds.
TEST_F(LightField, ThatDoesNotFitIsShownTheSame) {
    const RendererConfig config = pictures(48, 40);
    const light_field::Lens lens{.focus_m = 1.0, .aperture_m = 0.02};
    const std::uint32_t needed =
        light_field::most_views({.cameras = known_views().cameras, .lens = lens});
    ASSERT_LT(2 * needed, 25U) << "or nothing would have to go";
    const scene::LightFieldMemory memory{.most_bytes = room_for(2 * needed), .fetch_ahead = false};
    for (const char* const method : {"full", "kfr", "kfr3d"}) {
        const auto whole = known(lens);
        const auto part = known(lens, memory);
        EXPECT_FALSE(whole->account().has_value());
        OffScreen of_whole(context(), *whole, tests::passes_by(method), config);
        OffScreen of_part(context(), *part, tests::passes_by(method), config);
        for (const glm::dvec3& eye_m : wandering()) {
            FrameRequest at = look(config, eye_m, {30, 20});
            at.views[1].pose.position_m = -eye_m;
            const auto hash_of = [&](OffScreen& renderer) {
                return renderer.render(at.frame_view(), at.fovea()).gpu.pixel_hash.value();
            };
            ASSERT_EQ(hash_of(of_part), hash_of(of_whole)) << method << ' ' << eye_m.x;
        }
        const std::string account = part->account().value();
        EXPECT_THAT(account, testing::HasSubstr(fmt::format("{} of 25 views", 2 * needed)));
        unsigned frames = 0;
        unsigned loaded = 0;
        ASSERT_EQ(std::sscanf(account.substr(account.find(": ")).c_str(),
                              ": %u frames waited for %u views", &frames, &loaded),
                  2)
            << account;
        EXPECT_GT(loaded, 2 * needed) << "some must have come again";
        EXPECT_GT(frames, 1U);
    }
}

/// Eyes that go round over the cameras twice, an eighth of their spacing a frame.
std::vector<glm::dvec3> passing() {
    std::vector<glm::dvec3> eyes;
    for (int i = 0; i <= 160; ++i) {
        eyes.emplace_back(0.08 * std::cos(0.08 * i), 0.08 * std::sin(0.08 * i), 0.0);
    }
    return eyes;
}

// What is fetched ahead spares frames waits, and changes no pixel: neither while they pass the
// cameras, nor where the eyes jump and it was all for nothing.
TEST_F(LightField, ThatIsFetchedAheadIsShownTheSameAndWaitsLess) {
    const RendererConfig config = pictures(48, 40);
    const light_field::Lens lens{.focus_m = 1.0, .aperture_m = 0.0};
    const std::uint64_t room = room_for(8 + 2 * 3);
    for (const auto& eyes : {passing(), wandering()}) {
        const auto whole = known(lens);
        const auto waiting = known(lens, {.most_bytes = room, .fetch_ahead = false});
        const auto ahead = known(lens, {.most_bytes = room});
        const auto again = known(lens, {.most_bytes = room});
        const auto shown = [&](scene::Scene& scene) {
            OffScreen renderer(context(), scene, tests::passes_by("full"), config);
            std::vector<std::uint64_t> hashes;
            for (const glm::dvec3& eye_m : eyes) {
                FrameRequest at = look(config, eye_m, {30, 20});
                at.views[1].pose.position_m = eye_m + glm::dvec3{0.03, 0.0, 0.0};
                hashes.push_back(
                    renderer.render(at.frame_view(), at.fovea()).gpu.pixel_hash.value());
            }
            return hashes;
        };
        const auto expected = shown(*whole);
        EXPECT_EQ(shown(*waiting), expected);
        EXPECT_EQ(shown(*ahead), expected);
        EXPECT_EQ(shown(*again), expected);
        EXPECT_THAT(waiting->account().value(), testing::HasSubstr("14 of 25 views"));
        EXPECT_THAT(waiting->account().value(), testing::Not(testing::HasSubstr("ahead")));
        const std::string account = ahead->account().value();
        EXPECT_THAT(account, testing::HasSubstr("11 of 25 views"));
        unsigned fetched = 0;
        unsigned wanted = 0;
        const std::size_t at = account.find("; ");
        ASSERT_NE(at, std::string::npos) << account;
        ASSERT_EQ(
            std::sscanf(account.c_str() + at, "; %u views were fetched ahead, %u of them asked for",
                        &fetched, &wanted),
            2)
            << account;
        EXPECT_GE(fetched, wanted);
        // Who waited for what nobody fetched follows from the eyes' way alone, not from the time.
        EXPECT_EQ(ahead->view_waits().views, again->view_waits().views);
        EXPECT_EQ(ahead->view_waits().frames, again->view_waits().frames);
        if (eyes.size() == passing().size()) {
            EXPECT_GT(wanted, 20U) << account;
            EXPECT_LT(4 * ahead->view_waits().views, waiting->view_waits().views)
                << account << " / " << waiting->account().value();
            EXPECT_GT(waiting->view_waits().frames, 8U);
        }
    }
}

// A view that the thread cannot read is no failure until a frame asks for it.
TEST_F(LightField, ThatCannotBeFetchedAheadFailsOnlyWhenAskedFor) {
    constexpr std::uint64_t kBytes = std::uint64_t{4} * 8 * 8;
    const vulkan::LayeredImage image(context(), {.extent = vk::Extent2D(8, 8),
                                                 .format = vk::Format::eR8G8B8A8Srgb,
                                                 .usage = vk::ImageUsageFlagBits::eSampled |
                                                          vk::ImageUsageFlagBits::eTransferDst,
                                                 .layers = 4,
                                                 .view = vk::ImageViewType::e2DArray});
    vulkan::make_readable(context(), image);
    auto file = memory::ScratchFile::make();
    ASSERT_TRUE(file.has_value());
    ASSERT_TRUE(file->reserve(5 * kBytes).has_value());
    scene::ViewStream stream(context(), image, *std::move(file), 9, kBytes,
                             {.layers = 4, .staged = 1, .ahead = 2, .streamed = true});
    const auto bring = [&](std::vector<std::uint32_t> views) { stream.bring(views); };
    const auto fetch_ahead = [&](std::vector<std::uint32_t> views) { stream.fetch_ahead(views); };
    bring({0});
    fetch_ahead({7, 1});  // 7 is beyond the file's end
    for (int frame = 0; frame < 20; ++frame) {
        bring({0, 1});
        fetch_ahead({7, 2});
    }
    EXPECT_EQ(stream.waits().views, 1U) << "1 was there";
    EXPECT_THROW(bring({7}), SetupError);
}

// Frames in flight still see the views that they were recorded with, though later ones replace
// them.
TEST_F(LightField, ReplacesNoViewsThatFramesInFlightRead) {
    RendererConfig config = pictures(48, 40);
    config.frames_in_flight = 3;
    const light_field::Lens lens{.focus_m = 1.0, .aperture_m = 0.0};
    const auto whole = known(lens);
    const auto part = known(lens, {.most_bytes = room_for(10), .fetch_ahead = false});
    const auto ahead = known(lens, {.most_bytes = room_for(12)});
    const auto hashes = [&](scene::Scene& scene) {
        const OffScreenTargets targets(context(), config.extents, config.format);
        FrameRenderer renderer(context(), scene, tests::passes_by("full"), config);
        std::vector<std::uint64_t> all;
        const auto collect = [&] {
            while (const auto done = renderer.next_finished()) {
                all.push_back(done->pixel_hash.value());
            }
        };
        std::uint64_t index = 0;
        for (const glm::dvec3& eye_m : wandering()) {
            FrameRequest at = look(config, eye_m, {30, 20});
            FrameView view = at.frame_view();
            view.index = index++;
            view.targets = targets.targets();
            renderer.wait_for_slot();
            collect();
            renderer.begin(view);
            renderer.finish(at.fovea());
        }
        renderer.wait_idle();
        collect();
        return all;
    };
    const auto of_whole = hashes(*whole);
    EXPECT_EQ(of_whole.size(), wandering().size());
    EXPECT_EQ(hashes(*part), of_whole);
    EXPECT_EQ(hashes(*ahead), of_whole);
    EXPECT_THAT(ahead->account().value(), testing::HasSubstr("fetched ahead"));
}

TEST_F(LightField, ThatCannotFitIsRefusedWithWhatWould) {
    const light_field::Lens lens{.focus_m = 1.0, .aperture_m = 0.02};
    try {
        (void)known(lens, {.most_bytes = room_for(12)});
        FAIL() << "twelve views are not enough for two lenses";
    } catch (const SetupError& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        EXPECT_THAT(error.what(), testing::HasSubstr("the plane: two eyes' pictures"));
        EXPECT_THAT(error.what(), testing::HasSubstr("lightfield.compression = bc1"));
        EXPECT_THAT(error.what(), testing::HasSubstr("a lens of lightfield.aperture_m = 0"));
    }
}

// Of BC1, a picture loses at most half a step between the colours of a block of 4 x 4 texels, a
// sixth of what light changes across one, and a quantisation; through a lens of many views less.
TEST_F(LightField, AsBc1LosesLittle) {
    const RendererConfig config = pictures(48, 40);
    const FrameRequest at = look(config, {}, {24, 20});
    constexpr double kAcrossBlock = (0.2 * 4.0 + 0.15 * 3.0) * 3.0 / 16.0;  ///< of content()
    const std::uint64_t eighth = room_for(25 - 4) / 8;
    const auto loss = [&](double aperture_m) {
        const light_field::Lens lens{.focus_m = kPlane_m, .aperture_m = aperture_m};
        const auto packed = known(lens, {.most_bytes = eighth, .compressed = true});
        EXPECT_FALSE(packed->account().has_value()) << "an eighth holds them all";
        return error(show(*packed, "full", {}, config, at).linear, at);
    };
    const double of_few = loss(0.0);
    EXPECT_LT(of_few, kAcrossBlock / 6.0 + 2.0 * kCodes);
    EXPECT_LT(loss(1.0), of_few);
}

// From where a camera stood, a baked light field shows the scene as it is.
TEST_F(LightField, ThatWasBakedShowsItsScene) {
    const tests::TemporaryFolder folder;
    const auto file = sim::bake_light_field(
        context(), scene(),
        {.views = 3, .size_px = 48, .spacing_m = 0.02, .field_deg = 90.0, .scene_time_s = 2.5},
        folder / "field", [](std::uint32_t, std::uint32_t) { return true; });
    ASSERT_TRUE(file.has_value()) << file.error().message;
    scene::SceneOptions options;
    options.light_field.aperture_m = 0.0;
    const auto baked = scene::make_scene(context(), file->string(), options);
    const RendererConfig config = pictures(48, 48);
    for (const glm::dvec3& camera_m : {glm::dvec3{0.0}, glm::dvec3{-0.02, 0.02, 0.0}}) {
        FrameRequest at = look(config, camera_m, {24, 24}, std::atan(1.0));
        at.scene_time_s = 2.5;
        // Filtered in 256 steps of a texel.
        EXPECT_LE(largest_difference(show(*baked, "full", {}, config, at).picture,
                                     show(scene(), "full", {}, config, at).picture),
                  3);
    }
    const auto again =
        sim::bake_light_field(context(), scene(), {.views = 3, .size_px = 48}, folder / "field",
                              [](std::uint32_t, std::uint32_t) { return true; });
    ASSERT_FALSE(again.has_value());
    EXPECT_THAT(again.error().message, testing::HasSubstr("it holds something already"));
}

// The cache holds whole light fields, each made once, and another one for another bake.
TEST_F(LightField, OfTheBuildIsBakedOnceIntoACache) {
    const tests::TemporaryFolder cache;
    sim::LightFieldBake bake{.views = 3, .size_px = 16};
    const auto always = [] { return true; };
    const auto stopped =
        sim::baked_light_field(context(), bake, cache.path(), [] { return false; });
    ASSERT_FALSE(stopped.has_value());
    EXPECT_EQ(stopped.error().kind, ErrorKind::Interrupted);
    EXPECT_TRUE(std::filesystem::is_empty(cache.path())) << "nothing of it is left";
    const auto made = sim::baked_light_field(context(), bake, cache.path(), always);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const auto field = scene::open_light_field(*made);
    ASSERT_TRUE(field.has_value()) << field.error().message;
    EXPECT_EQ(field->cameras.count(), 9U);
    EXPECT_EQ(sim::baked_light_field(context(), bake, cache.path(), [] { return false; }).value(),
              *made)
        << "it is there";
    bake.scene_time_s = 1.0;
    EXPECT_NE(sim::baked_light_field(context(), bake, cache.path(), always).value(), *made);
    const std::filesystem::path taken = cache / "taken";
    std::ofstream(taken) << "no folder";
    const auto nowhere = sim::baked_light_field(context(), bake, taken, always);
    ASSERT_FALSE(nowhere.has_value());
    EXPECT_EQ(nowhere.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(nowhere.error().message, testing::HasSubstr("GAZELOOP_CACHE"));
}

TEST_F(LightField, GoesOnWithTheViewsThatAreMissing) {
    const tests::TemporaryFolder folder;
    const auto bake = [&](const sim::LightFieldBake& asked, const char* name, std::uint32_t most) {
        std::vector<std::uint32_t> told;
        const auto baked = sim::bake_light_field(context(), scene(), asked, folder / name,
                                                 [&](std::uint32_t done, std::uint32_t) {
                                                     told.push_back(done);
                                                     return done < most;
                                                 });
        return std::pair{baked, told};
    };
    const sim::LightFieldBake asked{.views = 3, .size_px = 16, .of = {{"scene", "a"}}};
    const auto stopped = bake(asked, "field", 4).first;
    ASSERT_FALSE(stopped.has_value());
    EXPECT_THAT(stopped.error().message, testing::HasSubstr("5 of 9 views are missing"));
    const auto refused = [&](const sim::LightFieldBake& other, const char* why) {
        const auto baked = bake(other, "field", 9).first;
        ASSERT_FALSE(baked.has_value());
        EXPECT_EQ(baked.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(baked.error().message, testing::HasSubstr(why));
    };
    refused({.views = 3, .size_px = 8, .of = asked.of}, "has 'size_px = 16', not 'size_px = 8'");
    refused({.views = 3, .size_px = 16, .of = {{"scene", "b"}}},
            "has 'scene = a', not 'scene = b'");
    refused({.views = 3, .size_px = 16}, "it holds something already");
    const auto [whole, told] = bake(asked, "field", 100);
    ASSERT_TRUE(whole.has_value()) << whole.error().message;
    EXPECT_THAT(told, testing::ElementsAre(6, 8, 9)) << "four were there";
    ASSERT_TRUE(bake(asked, "at-once", 100).first.has_value());
    const auto bytes = [&](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    std::size_t files = 0;
    for (const auto& one : std::filesystem::directory_iterator(folder / "field")) {
        EXPECT_EQ(bytes(one.path()), bytes(folder / "at-once" / one.path().filename()));
        ++files;
    }
    EXPECT_EQ(files, 10U) << "nine views and the file that names them";
    refused(asked, "it holds something already");
}

TEST_F(LightField, IsBakedUntilItIsInterrupted) {
    const tests::TemporaryFolder folder;
    const auto bake = [&](const sim::LightFieldBake& asked) {
        return sim::bake_light_field(context(), scene(), asked, folder / "field",
                                     [](std::uint32_t done, std::uint32_t) { return done < 2; });
    };
    EXPECT_EQ(bake({.views = 2, .size_px = 8}).error().kind, ErrorKind::Interrupted);
    for (const sim::LightFieldBake& bad :
         {sim::LightFieldBake{.views = 0}, sim::LightFieldBake{.views = 65},
          sim::LightFieldBake{.size_px = 1}, sim::LightFieldBake{.field_deg = 180.0},
          sim::LightFieldBake{.spacing_m = 0.0}}) {
        EXPECT_EQ(bake(bad).error().kind, ErrorKind::Usage);
    }
}

}  // namespace
}  // namespace gazeloop::render
