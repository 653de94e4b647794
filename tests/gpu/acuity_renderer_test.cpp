// The acuity-derived map in the renderer: views that are canted and not symmetrical, the gaze
// anywhere.
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "runtime/foveation/picture/gaze_frame.h"
#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

struct Situation {
    const char* name;
    gaze::FieldOfView fov;
    double cant_deg;
    double azimuth_deg;
    double elevation_deg;
};

void PrintTo(const Situation& at, std::ostream* out) { *out << at.name; }

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 240;

class AcuityRenderer : public FrameRendererTest, public testing::WithParamInterface<Situation> {
  protected:
    static FrameRequest frame(const Situation& at, const MethodConfig& config) {
        FrameRequest frame = request(config, {kWidth / 2.0, kHeight / 2.0});
        const double turn = std::numbers::pi / 180.0;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            frame.views[e].fov = at.fov;
            frame.views[e].pose.orientation =
                glm::angleAxis(at.cant_deg * turn, glm::dvec3(0.0, 1.0, 0.0));
            frame.gaze_directions[e] = {
                std::sin(at.azimuth_deg * turn) * std::cos(at.elevation_deg * turn),
                std::sin(at.elevation_deg * turn),
                -std::cos(at.azimuth_deg * turn) * std::cos(at.elevation_deg * turn)};
            frame.foveae[e] = gaze::project(frame.gaze_directions[e], frame.views[e]);
        }
        return frame;
    }
};

TEST_P(AcuityRenderer, IsFullResolutionInTheDiscAndTheSameSceneOutside) {
    const MethodConfig acuity = config(Method::Acuity, kWidth, kHeight);
    const FrameRequest at = frame(GetParam(), acuity);
    const Rendered foveated = render(acuity, at);
    const Rendered full = render(config(Method::Full, kWidth, kHeight), at);
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const foveation::GazeFrame gaze_frame(at.views[e], at.gaze_directions[e]);
        ASSERT_TRUE(foveated.plans[e].in_gaze_frame.has_value());
        const auto& plan = *foveated.plans[e].in_gaze_frame;
        double outside_error = 0.0;
        double mirrored_error = 0.0;
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                const std::size_t i = std::size_t{y} * kWidth + x;
                const double half_sine =
                    std::sin(0.5 * gaze_frame.eccentricity_rad({x + 0.5, y + 0.5}));
                const auto& seen = foveated.pictures[e].pixels[i];
                const auto& truth = full.pictures[e].pixels[i];
                if (half_sine < plan.disc_half_sine - plan.border_half_sine - 1e-6) {
                    for (std::size_t c = 0; c < 3; ++c) {
                        ASSERT_NEAR(seen[c], truth[c], 1) << x << ' ' << y;
                    }
                } else {
                    const std::size_t mirrored = std::size_t{y} * kWidth + kWidth - 1 - x;
                    outside_error += std::abs(seen[1] - truth[1]);
                    mirrored_error += std::abs(seen[1] - full.pictures[e].pixels[mirrored][1]);
                }
            }
        }
        // A filtered picture of this view, not of another one.
        EXPECT_LT(outside_error, 0.6 * mirrored_error);
    }
    EXPECT_LT(foveated.counts.shaded(), foveated.counts.pixels_output);
}

TEST_P(AcuityRenderer, ReadsNoTexelThatWasLeftOut) {
    MethodConfig acuity = config(Method::Acuity, kWidth, kHeight);
    for (const bool disc : {true, false}) {
        acuity.acuity.disc = disc;
        const FrameRequest at = frame(GetParam(), acuity);
        constexpr float kPoison = std::numeric_limits<float>::infinity();
        acuity.unshaded = {0.0F, 0.0F, 0.0F, 1.0F};
        const Rendered dark = render(acuity, at);
        acuity.unshaded = {kPoison, kPoison, kPoison, 1.0F};
        const Rendered poisoned = render(acuity, at);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            EXPECT_EQ(largest_difference(dark.pictures[e], poisoned.pictures[e]), 0);
        }
    }
}

constexpr gaze::FieldOfView kSymmetric{-0.8, 0.8, 0.7, -0.7};
constexpr gaze::FieldOfView kAsymmetric{-0.95, 0.7, 0.65, -0.8};
constexpr gaze::FieldOfView kWide{-1.2, 1.2, 1.1, -1.1};

INSTANTIATE_TEST_SUITE_P(Views, AcuityRenderer,
                         testing::Values(Situation{"centre", kSymmetric, 0, 0, 0},
                                         Situation{"off_axis", kSymmetric, 0, 30, 0},
                                         Situation{"corner", kSymmetric, 0, -45.8, 40.1},
                                         Situation{"off_screen", kSymmetric, 0, 80, 10},
                                         Situation{"behind", kSymmetric, 0, 170, 0},
                                         Situation{"asymmetric", kAsymmetric, 0, -20, -15},
                                         Situation{"canted", kAsymmetric, 10, 15, 5},
                                         Situation{"wide", kWide, -5, 40, -30}),
                         [](const auto& instance) { return instance.param.name; });

using AcuityRendererOnce = FrameRendererTest;

/// The LP-buffer of the left eye; null: the last frame read none.
vk::Image lp_buffer(const OffScreen& drawing) {
    const auto buffers = drawing.renderer().buffers(gaze::Eye::Left);
    return buffers.empty() ? vk::Image{} : buffers.front().image->image();
}

TEST_F(AcuityRendererOnce, FollowsAFieldOfViewThatChanges) {
    const MethodConfig acuity = config(Method::Acuity, kWidth, kHeight);
    FrameRequest at = request(acuity, {100.0, 120.0});
    OffScreen drawing(context(), scene(), passes_of(acuity), acuity);
    drawing.render(at.frame_view(), at.fovea());
    const vk::Image first = lp_buffer(drawing);
    at.views[0].fov.right_rad = 0.5;
    at.gaze_directions[0] = gaze::unproject(at.foveae[0], at.views[0]);
    drawing.render(at.frame_view(), at.fovea());
    EXPECT_NE(lp_buffer(drawing), first);
    EXPECT_EQ(largest_difference(drawing.picture(gaze::Eye::Left), render(acuity, at).pictures[0]),
              0);
}

// A late latch costs a plan and a few uniforms: what is built for an eye, tables, buffers, stays.
TEST_F(AcuityRendererOnce, ANewGazeBuildsNothing) {
    for (const Method method : {Method::Acuity, Method::Kfr}) {
        const MethodConfig log_polar = config(method, kWidth, kHeight);
        OffScreen drawing(context(), scene(), passes_of(log_polar), log_polar);
        const FrameRequest middle = request(log_polar, {160.0, 120.0});
        drawing.render(middle.frame_view(), middle.fovea());
        const vk::Image buffer = lp_buffer(drawing);
        ASSERT_TRUE(buffer);
        int compared = 0;
        for (const gaze::PixelPosition& gaze :
             {gaze::PixelPosition{0, 0}, {320, 7}, {-200, 500}, {160.25, 120}, {1e6, 0}}) {
            const FrameRequest moved = request(log_polar, gaze);
            drawing.render(moved.frame_view(), moved.fovea());
            if (const vk::Image now = lp_buffer(drawing)) {
                EXPECT_EQ(now, buffer);
                ++compared;
            }
        }
        EXPECT_GE(compared, 4);
    }
}

}  // namespace
}  // namespace gazeloop::render
