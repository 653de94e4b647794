// What works on a method's picture: the post filter, the resolve's footprint, antialiasing over
// frames.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/frame_renderer_fixture.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::render {
namespace {

class AntialiasingTest : public FrameRendererTest {
  protected:
    static constexpr std::array kMethods{Method::Full, Method::Kfr, Method::Acuity};

    static MethodConfig with(const Antialiasing& antialiasing, Method method = Method::Kfr,
                             std::uint32_t width = 160, std::uint32_t height = 120) {
        MethodConfig of = config(method, width, height);
        of.antialiasing = antialiasing;
        of.hash = true;
        return of;
    }
    static constexpr Antialiasing kOverFrames{.over_frames = true};

    /// Renders frames 0 .. `count` - 1 of the same request by one renderer, which is returned.
    template <typename Move>
    static std::unique_ptr<OffScreen> run(const MethodConfig& of, FrameRequest asked,
                                          std::uint64_t count, const Move& move) {
        auto off_screen = std::make_unique<OffScreen>(context(), scene(), passes_of(of), of);
        for (std::uint64_t i = 0; i < count; ++i) {
            asked.index = i;
            move(i, asked);
            last_hash() = off_screen->render(asked.frame_view(), asked.fovea()).gpu.pixel_hash;
        }
        return off_screen;
    }
    static std::unique_ptr<OffScreen> run(const MethodConfig& of, const FrameRequest& asked,
                                          std::uint64_t count) {
        return run(of, asked, count, [](std::uint64_t, FrameRequest&) {});
    }
    static std::optional<std::uint64_t>& last_hash() {
        static std::optional<std::uint64_t> hash;
        return hash;
    }

    /// Mean absolute difference, codes of 255, over the pixels that `counts` takes.
    template <typename Counts>
    static double mean_difference(const Picture& a, const Picture& b, const Counts& counts) {
        double sum = 0.0;
        double pixels = 0.0;
        for (std::uint32_t y = 0; y < a.height; ++y) {
            for (std::uint32_t x = 0; x < a.width; ++x) {
                if (counts(x + 0.5, y + 0.5)) {
                    const std::size_t i = std::size_t{y} * a.width + x;
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum += std::abs(a.pixels[i][c] - b.pixels[i][c]);
                    }
                    pixels += 3.0;
                }
            }
        }
        return sum / pixels;
    }
    static double mean_difference(const Picture& a, const Picture& b) {
        return mean_difference(a, b, [](double, double) { return true; });
    }
    static bool lists(const OffScreen& off_screen, std::string_view pass) {
        return off_screen.renderer().passes().find(pass).has_value();
    }
};

TEST_F(AntialiasingTest, IsNothingWhereNothingIsAskedFor) {
    for (const Method method : kMethods) {
        const FrameRequest asked = request(config(method), {80, 60});
        run(with({}, method), asked, 1);
        const auto plain = last_hash();
        // Sizes below 3 filter nothing, and full resolution has no periphery.
        for (const std::uint32_t px : {1U, 2U}) {
            const auto done = run(with({.post_filter_px = px}, method), asked, 1);
            EXPECT_EQ(last_hash(), plain);
            EXPECT_FALSE(lists(*done, "post_filter"));
        }
        const auto done = run(with({.post_filter_px = 39}, method), asked, 1);
        EXPECT_EQ(lists(*done, "post_filter"), method != Method::Full);
        if (method == Method::Full) {
            EXPECT_EQ(last_hash(), plain);
        } else if (method == Method::Kfr) {
            EXPECT_NE(last_hash(), plain);
        }
    }
}

TEST_F(AntialiasingTest, PostFilterWidensWithTheDistanceFromTheFovea) {
    const gaze::PixelPosition fovea{60, 50};
    const FrameRequest asked = request(config(Method::Kfr), fovea);
    const Picture plain = run(with({}), asked, 1)->picture(gaze::Eye::Left);
    const Picture filtered = run(with({.post_filter_px = 11}), asked, 1)->picture(gaze::Eye::Left);
    const double farthest_px = std::hypot(100, 70);
    // How much neighbours differ, over the same of the plain picture.
    const auto roughness = [&](const Picture& picture, double from, double to) {
        double sum = 0.0;
        for (std::uint32_t y = 0; y < picture.height; ++y) {
            for (std::uint32_t x = 1; x < picture.width; ++x) {
                const double share =
                    std::hypot(x + 0.5 - fovea.x_px, y + 0.5 - fovea.y_px) / farthest_px;
                if (share >= from && share < to) {
                    const std::size_t i = std::size_t{y} * picture.width + x;
                    sum += std::abs(picture.pixels[i][1] - picture.pixels[i - 1][1]);
                }
            }
        }
        return sum;
    };
    const auto left = [&](double from, double to) {
        return roughness(filtered, from, to) / roughness(plain, from, to);
    };
    // 16-bit floats in between may round the other way.
    EXPECT_NEAR(left(0.0, 0.08), 1.0, 0.01) << "none in the fovea";
    EXPECT_LT(left(0.11, 0.2), 1.0);
    EXPECT_LT(left(0.4, 0.7), left(0.11, 0.2));
}

// What no eye sees is black, and must not darken what is beside it.
TEST_F(AntialiasingTest, LeavesOutWhatNoEyeSees) {
    constexpr double kEdge = 0.7853981633974483;
    FrameRequest asked = request(config(Method::Kfr), {80, 60});
    for (gaze::EyeView& view : asked.views) {
        view.pose.orientation = glm::angleAxis(1.5, glm::dvec3(1, 0, 0));
        view.fov = {-kEdge, kEdge, kEdge, -kEdge};
    }
    const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
    (*meshes)[0] = tests::cut_corners(0.5);
    (*meshes)[1] = tests::cut_corners(0.5);
    asked.hidden = foveation::hidden_areas(meshes, asked.views);
    ASSERT_NE(asked.hidden[0], nullptr);
    for (const Antialiasing& one :
         {Antialiasing{.post_filter_px = 39},
          Antialiasing{.post_filter_px = 39, .over_frames = true}, kOverFrames}) {
        const Picture plain = run(with({}), asked, 1)->picture(gaze::Eye::Left);
        const Picture done = run(with(one), asked, 3)->picture(gaze::Eye::Left);
        // Overhead is nothing but sky, which is nowhere dark.
        int darkest = 255;
        for (const auto& pixel : plain.pixels) {
            darkest = pixel[2] > 0 ? std::min<int>(darkest, pixel[2]) : darkest;
        }
        ASSERT_GT(darkest, 100);
        std::size_t hidden = 0;
        for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
            if (plain.pixels[i][2] == 0) {
                ++hidden;
                ASSERT_EQ(done.pixels[i][2], 0) << i;
            } else {
                ASSERT_GE(done.pixels[i][2], darkest - 4) << i;
            }
        }
        EXPECT_GT(hidden, 100U);
    }
}

TEST_F(AntialiasingTest, ReadsNoTexelThatWasLeftOut) {
    for (const Antialiasing& one : {Antialiasing{.footprint_taps = 4}, kOverFrames,
                                    Antialiasing{.footprint_taps = 3, .over_frames = true}}) {
        for (const Method method : {Method::Kfr, Method::Acuity}) {
            for (const gaze::PixelPosition fovea :
                 {gaze::PixelPosition{48, 36}, gaze::PixelPosition{96, 72},
                  gaze::PixelPosition{-30, 20}}) {
                for (const bool disc : {true, false}) {
                    MethodConfig of = with(one, method, 96, 72);
                    of.kfr.disc = disc;
                    of.acuity.disc = disc;
                    const FrameRequest asked = request(of, fovea);
                    of.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
                    run(of, asked, 3);
                    const auto on_black = last_hash();
                    of.unshaded = {5e4F, 0.0F, 5e4F, 1.0F};
                    run(of, asked, 3);
                    EXPECT_EQ(last_hash(), on_black) << fovea.x_px << " disc " << disc;
                }
            }
        }
    }
}

TEST_F(AntialiasingTest, KeepsColoursAndDepthOfTheTarget) {
    for (const Method method : kMethods) {
        const FrameRequest asked = request(config(method), {80, 60});
        MethodConfig plain = with({}, method);
        plain.depth_format = vk::Format::eD32Sfloat;
        const std::vector<float> depth = run(plain, asked, 1)->depth(gaze::Eye::Left);
        for (const Antialiasing& one : {kOverFrames, Antialiasing{.post_filter_px = 9},
                                        Antialiasing{.post_filter_px = 9, .over_frames = true}}) {
            MethodConfig of = with(one, method);
            run(of, asked, 1);
            const auto without = last_hash();
            of.depth_format = vk::Format::eD32Sfloat;
            const auto done = run(of, asked, 1);
            EXPECT_EQ(last_hash(), without);
            of.profile = false;
            run(of, asked, 1);
            EXPECT_EQ(last_hash(), without);
            if (one.over_frames) {
                continue;  // its samples lie elsewhere
            }
            const std::vector<float> kept = done->depth(gaze::Eye::Left);
            EXPECT_EQ(kept, depth) << static_cast<int>(method);
        }
    }
}

TEST_F(AntialiasingTest, OverFramesIsTheSameEveryTime) {
    for (const Method method : kMethods) {
        const MethodConfig of = with({.post_filter_px = 5, .over_frames = true}, method);
        const FrameRequest asked = request(of, {80, 60});
        const auto turning = [](std::uint64_t i, FrameRequest& frame) {
            for (gaze::EyeView& view : frame.views) {
                view.pose.orientation =
                    glm::angleAxis(0.01 * static_cast<double>(i), glm::dvec3(0, 1, 0));
            }
        };
        run(of, asked, 5, turning);
        const auto first = last_hash();
        run(of, asked, 5, turning);
        EXPECT_EQ(last_hash(), first);
        // A frame that was left out begins anew: the rest is as if there had been nothing before.
        const auto skipping = run(of, asked, 3, [&](std::uint64_t i, FrameRequest& frame) {
            turning(i, frame);
            frame.index = i + (i > 1 ? 5 : 0);
        });
        const auto after_gap = last_hash();
        const auto alone =
            run(of, asked, 1, [&](std::uint64_t, FrameRequest& frame) { turning(2, frame); });
        EXPECT_EQ(last_hash(), after_gap);
    }
}

// Full resolution with one sample per pixel becomes what it is with sixteen.
TEST_F(AntialiasingTest, OverFramesApproachesManySamples) {
    for (const Method method : kMethods) {
        const FrameRequest asked = request(config(method), {80, 60});
        MethodConfig many = config(method);
        many.samples = 16;
        many.hash = true;
        const Picture clean = run(many, asked, 1)->picture(gaze::Eye::Left);
        const Picture plain = run(with({}, method), asked, 1)->picture(gaze::Eye::Left);
        const Picture mixed = run(with(kOverFrames, method), asked, 17)->picture(gaze::Eye::Left);
        const double before = mean_difference(plain, clean);
        const double after = mean_difference(mixed, clean);
        RecordProperty("before", std::to_string(before));
        RecordProperty("after", std::to_string(after));
        EXPECT_LT(after, 0.75 * before) << static_cast<int>(method);
    }
}

// Where nothing differs from frame to frame, nothing drifts.
TEST_F(AntialiasingTest, OverFramesKeepsAnEvenPicture) {
    FrameRequest asked = request(config(Method::Kfr), {80, 60});
    for (gaze::EyeView& view : asked.views) {
        view.pose.orientation = glm::angleAxis(1.3, glm::dvec3(1, 0, 0));
        view.fov = {-0.1, 0.1, 0.1, -0.1};
    }
    for (const Method method : kMethods) {
        const Picture plain = run(with({}, method), asked, 1)->picture(gaze::Eye::Left);
        const Picture mixed = run(with(kOverFrames, method), asked, 40)->picture(gaze::Eye::Left);
        EXPECT_LE(largest_difference(mixed, plain), 1);
    }
}

TEST_F(AntialiasingTest, OverFramesForgetsWhereASaccadeLands) {
    const FrameRequest asked = request(config(Method::Kfr), {40, 60});
    // The eye jumps in frame 6 and rests from then on: it lands in frame 7.
    const auto jump = [](std::uint64_t i, FrameRequest& frame) {
        const gaze::PixelPosition fovea =
            i < 6 ? gaze::PixelPosition{40, 60} : gaze::PixelPosition{110, 70};
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            frame.foveae[e] = fovea;
            frame.gaze_directions[e] = gaze::unproject(fovea, frame.views[e]);
        }
    };
    Antialiasing keeps = kOverFrames;
    keeps.forget_at_landings = false;
    for (const std::uint64_t frames : {7U, 8U}) {
        run(with(kOverFrames), asked, frames, jump);
        const auto forgot = last_hash();
        run(with(keeps), asked, frames, jump);
        EXPECT_EQ(last_hash() == forgot, frames == 7) << frames;
    }
    // The past follows the fovea: a few frames later the disc is as if it had always been there.
    const Picture kept = run(with(keeps), asked, 16, jump)->picture(gaze::Eye::Left);
    FrameRequest there = asked;
    jump(6, there);
    const Picture rested = run(with(kOverFrames), there, 16)->picture(gaze::Eye::Left);
    EXPECT_LT(mean_difference(kept, rested,
                              [](double x, double y) { return std::hypot(x - 110, y - 70) < 8; }),
              1.0);
}

TEST_F(AntialiasingTest, RefusesWhatItCannotDo) {
    for (const Antialiasing& bad :
         {Antialiasing{.footprint_taps = 0}, Antialiasing{.footprint_taps = 17},
          Antialiasing{.post_filter_px = 40}}) {
        const MethodConfig of = with(bad);
        EXPECT_THROW(FrameRenderer(context(), scene(), passes_of(of), of), SetupError);
    }
}

}  // namespace
}  // namespace gazeloop::render
