// Depth images against the floor's plane, against the other eye, and against full resolution.
#include "runtime/render/depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

constexpr double kFloor_m = -1.4;  // of the scene, below the world's origin
constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 280;

class Depth : public FrameRendererTest {
  protected:
    static MethodConfig with_depth(Method method) {
        MethodConfig made = config(method, kWidth, kHeight);
        made.depth_format = vk::Format::eD32Sfloat;
        return made;
    }

    /// Direction of a pixel's centre in the view's frame, with z = -1.
    static glm::dvec3 direction(const gaze::EyeView& view, std::size_t pixel) {
        const double x = (static_cast<double>(pixel % kWidth) + 0.5) / kWidth;
        const std::size_t row = pixel / kWidth;
        const double y = (static_cast<double>(row) + 0.5) / kHeight;
        return {std::lerp(std::tan(view.fov.left_rad), std::tan(view.fov.right_rad), x),
                std::lerp(std::tan(view.fov.up_rad), std::tan(view.fov.down_rad), y), -1.0};
    }

    /// Medians tell a rule from what silhouettes do.
    static double median(std::vector<double> values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }
};

// The floor's distance is known exactly; whatever stands on it is nearer.
TEST_F(Depth, IsTheFloorsDistanceWhereTheFloorIsSeen) {
    const MethodConfig full = with_depth(Method::Full);
    const FrameRequest request = Depth::request(full, {});
    const Rendered rendered = render(full, request);
    std::size_t below = 0;
    std::size_t on_floor = 0;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        for (std::size_t i = 0; i < rendered.depths[e].size(); ++i) {
            const glm::dvec3 towards = direction(request.views[e], i);
            const double depth = rendered.depths[e][i];
            ASSERT_GE(depth, 0.0);
            ASSERT_LE(depth, 1.0);
            if (towards.y >= -0.1) {
                continue;
            }
            ++below;
            const double floor = kDepthNear_m * towards.y / kFloor_m;
            ASSERT_GE(depth, floor * 0.999) << "pixel " << i;
            on_floor += depth <= floor * 1.001 ? 1 : 0;
        }
    }
    EXPECT_GT(static_cast<double>(on_floor), 0.3 * static_cast<double>(below));
    EXPECT_LT(on_floor, below) << "nothing stands on the floor: the test says less than it should";
}

// A point that the left eye sees lies, for the right eye, where the depths say.
TEST_F(Depth, OfBothEyesAgrees) {
    const MethodConfig full = with_depth(Method::Full);
    const FrameRequest request = Depth::request(full, {});
    const Rendered rendered = render(full, request);
    const gaze::EyeView& left = request.views[0];
    const gaze::EyeView& right = request.views[1];
    std::size_t seen = 0;
    std::size_t agreeing = 0;
    double largest_shift_px = 0.0;
    for (std::size_t i = 0; i < rendered.depths[0].size(); ++i) {
        const double depth = rendered.depths[0][i];
        if (depth < 1e-3) {
            continue;  // over 100 m: parallax under a pixel says nothing
        }
        const glm::dvec3 point = left.pose.position_m + direction(left, i) * (kDepthNear_m / depth);
        const gaze::PixelPosition at = gaze::project(point - right.pose.position_m, right);
        if (at.x_px < 0.0 || at.x_px >= kWidth || at.y_px < 0.0 || at.y_px >= kHeight) {
            continue;
        }
        ++seen;
        largest_shift_px =
            std::max(largest_shift_px, std::abs(at.x_px - static_cast<double>(i % kWidth) - 0.5));
        const std::size_t there =
            static_cast<std::size_t>(at.y_px) * kWidth + static_cast<std::size_t>(at.x_px);
        agreeing += std::abs(rendered.depths[1][there] - depth) <= 0.03 * depth ? 1 : 0;
    }
    EXPECT_GT(seen, kWidth * kHeight / 3);
    EXPECT_GT(largest_shift_px, 3.0);
    EXPECT_GT(static_cast<double>(agreeing), 0.9 * static_cast<double>(seen));
}

TEST_F(Depth, OfALogPolarPictureIsThatOfFullResolution) {
    const MethodConfig full = with_depth(Method::Full);
    const Rendered exact = render(full, request(full, {150.0, 160.0}));
    for (const Method method : {Method::Kfr, Method::Acuity}) {
        const MethodConfig foveated = with_depth(method);
        const Rendered rendered = render(foveated, request(foveated, {150.0, 160.0}));
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            std::vector<double> errors;
            std::vector<double> errors_in_disc;
            for (std::size_t i = 0; i < exact.depths[e].size(); ++i) {
                const double wanted = exact.depths[e][i];
                const double error = std::abs(rendered.depths[e][i] - wanted) / (wanted + 1e-3);
                errors.push_back(error);
                const std::size_t row = i / kWidth;
                if (std::hypot(static_cast<double>(i % kWidth) + 0.5 - 150.0,
                               static_cast<double>(row) + 0.5 - 160.0) < 4.0) {
                    errors_in_disc.push_back(error);
                }
            }
            EXPECT_LT(median(errors), 0.02);
            if (rendered.counts.grids.at(1).shaded > 0) {
                EXPECT_LT(median(errors_in_disc), 1.0 / 2048.0) << "half floats hold 11 bits";
            }
        }
    }
}

TEST_F(Depth, LeavesTheColoursAlone) {
    for (const Method method : {Method::Full, Method::Kfr, Method::Acuity}) {
        const MethodConfig with = with_depth(method);
        MethodConfig without = with;
        without.depth_format = vk::Format::eUndefined;
        const FrameRequest frame = request(with, {100.0, 90.0});
        const Rendered a = render(with, frame);
        const Rendered b = render(without, frame);
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            EXPECT_EQ(a.pictures[e].pixels, b.pictures[e].pixels);
        }
    }
}

TEST_F(Depth, IsEndlessWhereNoEyeSeesIt) {
    for (const Method method : {Method::Full, Method::Kfr, Method::Acuity}) {
        const MethodConfig with = with_depth(method);
        FrameRequest frame = request(with, {150.0, 160.0});
        // The lower left corner, floor otherwise.
        const double left = std::tan(frame.views[0].fov.left_rad);
        const double down = std::tan(frame.views[0].fov.down_rad);
        const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
        (*meshes)[0].push_back(
            {{glm::dvec2{left, down}, glm::dvec2{0.0, down}, glm::dvec2{left, 0.0}}});
        frame.hidden = foveation::hidden_areas(meshes, frame.views);
        const Rendered rendered = render(with, frame);
        EXPECT_EQ(rendered.depths[0][std::size_t{kHeight - 8} * kWidth + 8], 0.0F);
        EXPECT_GT(rendered.depths[1][std::size_t{kHeight - 8} * kWidth + 8], 0.0F);
    }
}

}  // namespace
}  // namespace gazeloop::render
