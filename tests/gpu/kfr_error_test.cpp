// How far KFR's picture is from full resolution, on lavapipe: by sigma, around the fovea, and where
// the gaze moves or lies at the picture's seams and borders.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

class KfrErrorTest : public FrameRendererTest {
  protected:
    /// The map alone: direct pixels only where it has a hole.
    static MethodConfig map_alone(std::uint32_t width, std::uint32_t height, double sigma) {
        MethodConfig of = config(Method::Kfr, width, height);
        of.kfr.disc = false;
        of.kfr.close_hole = true;
        of.kfr.border_px = 1.0;
        of.kfr.lp_width = static_cast<std::uint32_t>(std::lround(width / sigma));
        of.kfr.lp_height = static_cast<std::uint32_t>(std::lround(height / sigma));
        return of;
    }

    /// Mean absolute difference, codes of 255.
    template <typename Counts>
    static double error(const Picture& a, const Picture& b, const Counts& counts) {
        double sum = 0.0;
        double channels = 0.0;
        for (std::uint32_t y = 0; y < a.height; ++y) {
            for (std::uint32_t x = 0; x < a.width; ++x) {
                if (!counts(x + 0.5, y + 0.5)) {
                    continue;
                }
                const std::size_t i = std::size_t{y} * a.width + x;
                for (std::size_t c = 0; c < 3; ++c) {
                    sum += std::abs(a.pixels[i][c] - b.pixels[i][c]);
                }
                channels += 3.0;
            }
        }
        return sum / channels;
    }
    static double error(const Picture& a, const Picture& b) {
        return error(a, b, [](double, double) { return true; });
    }

    static FrameRequest looking_up(const MethodConfig& of, gaze::PixelPosition fovea) {
        FrameRequest at = request(of, fovea);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            at.views[e].pose.orientation = glm::angleAxis(1.3, glm::dvec3(1, 0, 0));
            at.views[e].fov = {-0.1, 0.1, 0.1, -0.1};
            at.gaze_directions[e] = gaze::unproject(fovea, at.views[e]);
        }
        return at;
    }
};

// Down to sigma .15, at which rows lie a pixel apart at the farthest corner, and beyond. What is
// left there is detail of less than a pixel, which two pictures sample in different places; the sky
// has none.
TEST_F(KfrErrorTest, FallsWithSigmaAndVanishes) {
    constexpr std::uint32_t kWidth = 64;
    constexpr std::uint32_t kHeight = 36;
    const MethodConfig full = config(Method::Full, kWidth, kHeight);
    FrameRequest at = request(full, {32, 18});
    const auto errors = [&](const FrameRequest& asked) {
        const Picture truth = render(full, asked).pictures[0];
        std::vector<double> made;
        for (const double sigma : {4.0, 2.4, 1.8, 1.2, 0.8, 0.5, 0.3, 0.15, 0.05}) {
            made.push_back(
                error(render(map_alone(kWidth, kHeight, sigma), asked).pictures[0], truth));
        }
        return made;
    };
    const std::vector<double> detailed = errors(at);
    for (std::size_t i = 1; i < detailed.size(); ++i) {
        EXPECT_LT(detailed[i], detailed[i - 1]) << i;
    }
    EXPECT_LT(detailed[7], 0.5 * detailed[2]) << "sigma .15 over sigma 1.8";
    for (gaze::EyeView& view : at.views) {
        view.pose.orientation = glm::angleAxis(1.3, glm::dvec3(1, 0, 0));
    }
    const std::vector<double> sky = errors(at);
    for (std::size_t i = 1; i < sky.size(); ++i) {
        EXPECT_LT(sky[i], sky[i - 1] + 0.02) << i;
    }
    EXPECT_LT(sky[7], 0.2) << "codes of 255, at sigma .15";
}

TEST_F(KfrErrorTest, IsSmallWithinFiveDegreesOfTheFovea) {
    for (const gaze::PixelPosition fovea :
         {gaze::PixelPosition{320, 240}, gaze::PixelPosition{200.3, 310.8}}) {
        const MethodConfig kfr = config(Method::Kfr, 640, 480);
        const FrameRequest at = request(kfr, fovea);
        const Picture foveated = render(kfr, at).pictures[0];
        const Picture full = render(config(Method::Full, 640, 480), at).pictures[0];
        const double five_deg = std::cos(5.0 * std::numbers::pi / 180.0);
        const double within = error(foveated, full, [&](double x, double y) {
            return glm::dot(gaze::unproject({x, y}, at.views[0]), at.gaze_directions[0]) > five_deg;
        });
        EXPECT_LT(within, 0.05) << "codes of 255";
        EXPECT_GT(error(foveated, full), 10 * within) << "elsewhere it is coarser";
    }
}

// A fovea that moves by less than a pixel, as a resting eye's does. Around it nothing moves. Far
// from it samples lie elsewhere then, and show other detail that is finer than they lie apart: how
// much is measured, and is less than what foveation loses.
TEST_F(KfrErrorTest, MovingTheFoveaByPartOfAPixelShowsNothing) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        MethodConfig of = config(method, 320, 240);
        of.samples = 16;
        const auto at = [&](double x, double y) {
            return render(of, request(of, {160 + x, 120 + y})).pictures[0];
        };
        const Picture here = at(0, 0);
        const MethodConfig all = [&] {
            MethodConfig full = config(Method::Full, 320, 240);
            full.samples = 16;
            return full;
        }();
        const double lost = error(here, render(all, request(all, {160, 120})).pictures[0]);
        for (const auto& [x, y] : {std::pair{0.25, 0.0}, {0.0, -0.4}}) {
            const Picture moved = at(x, y);
            const double core = error(moved, here, [](double px, double py) {
                return std::hypot(px - 160, py - 120) < 15;
            });
            EXPECT_LT(error(moved, here), 0.5 * lost) << x << ' ' << y;
            EXPECT_LT(core, 0.05) << x << ' ' << y;
        }
        // In a smooth picture not one code.
        const Picture smooth = render(of, looking_up(of, {160, 120})).pictures[0];
        EXPECT_LE(
            largest_difference(render(of, looking_up(of, {160.3, 119.8})).pictures[0], smooth), 1);
    }
}

// Where the picture is smooth, no gaze must show: neither a seam where the angle wraps, nor the
// borders that the LP-buffer ends at, nor the disc's.
TEST_F(KfrErrorTest, ShowsNoSeamForAnyFovea) {
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        MethodConfig of = config(method, 256, 256);
        const Picture full =
            render(config(Method::Full, 256, 256), looking_up(of, {128, 128})).pictures[0];
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{0, 0}, gaze::PixelPosition{256, 0}, gaze::PixelPosition{0, 256},
              gaze::PixelPosition{256, 256}, gaze::PixelPosition{0, 128},
              gaze::PixelPosition{128.0, 256}, gaze::PixelPosition{-60, 128},
              gaze::PixelPosition{-100, -80}, gaze::PixelPosition{300, 400}}) {
            for (const bool disc : {true, false}) {
                of.kfr.disc = disc;
                of.acuity.disc = disc;
                const Picture foveated = render(of, looking_up(of, fovea)).pictures[0];
                EXPECT_LE(largest_difference(foveated, full), 1)
                    << static_cast<int>(method) << ' ' << fovea.x_px << ' ' << fovea.y_px << ' '
                    << disc;
            }
        }
    }
}

}  // namespace
}  // namespace gazeloop::render
