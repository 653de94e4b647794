// Four views of an application, composited by the layer for Monado, which has two.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/trigonometric.hpp>

#include "runtime/openxr_layer/quad_views/inset.h"
#include "runtime/quality/foveated_contrast.h"
#include "runtime/session/session_file.h"
#include "tests/openxr/layered_application.h"
#include "tests/openxr/quad_program.h"
#include "tests/support/openxr_validation.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint32_t kSide_px = 960;
constexpr double kAzimuth_deg = 9.0;
constexpr double kElevation_deg = -6.0;

/// The layer's files in a folder of the test's; the loader loads no layer unless it is told to.
struct QuadHome : LayeredHome {
    explicit QuadHome(std::vector<std::string> more = {}, const std::string& loaded = "")
        : LayeredHome([&more] {
              more.insert(more.begin(), "layer.gaze=fixed:9,-6");
              return more;
          }()) {
        setenv("XR_ENABLE_API_LAYERS", loaded.c_str(), 1);
        setenv("GAZELOOP_HEAD_STILL", "1", 1);
        // What an earlier test of this process has set would stay.
        unsetenv("GAZELOOP_DISPLAY_WIDTH_PX");
        unsetenv("GAZELOOP_DISPLAY_HEIGHT_PX");
    }
};

/// Stripes and rings at every scale that the full picture holds: up to a third of a cycle a pixel
/// in its middle. Their contrast is that of most pictures.
glm::vec3 pattern(double x, double y) {
    const double radius = std::hypot(x - 0.1, y + 0.2);
    const double fine = 0.18 * std::sin(6.2832 * 0.3 * kSide_px / 2.0 * (0.8 * x + 0.6 * y));
    const double middle = 0.15 * std::sin(6.2832 * 0.1 * kSide_px / 2.0 * (0.6 * x - 0.8 * y));
    const double rings = 0.15 * std::sin(6.2832 * 20.0 * radius * radius);
    const double level = 0.4 + fine + middle + rings;
    return {static_cast<float>(level), static_cast<float>(0.9 * level),
            static_cast<float>(0.5 + 0.3 * std::sin(9.0 * x))};
}

glm::dvec3 gaze_direction() {
    const double azimuth = glm::radians(kAzimuth_deg);
    const double elevation = glm::radians(kElevation_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

double difference(const render::LinearPicture& reference, const render::LinearPicture& test,
                  const XrFovf& fov) {
    const gaze::EyeView view{.pose = {},
                             .fov = {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown},
                             .width_px = reference.width,
                             .height_px = reference.height};
    auto metric = value_or_throw(
        quality::FoveatedContrast::create(view, gaze::Eye::Left, {.light = {}, .threads = 2}));
    return value_or_throw(metric.still(reference, test, gaze_direction())).value;
}

/// Twice as large, as the layer's sampler does it: linear, clamped.
render::LinearPicture enlarged(const render::LinearPicture& half, std::uint32_t side) {
    render::LinearPicture full{side, side, {}};
    const auto at = [&](std::int64_t x, std::int64_t y) {
        x = std::clamp<std::int64_t>(x, 0, half.width - 1);
        y = std::clamp<std::int64_t>(y, 0, half.height - 1);
        return half.pixels[static_cast<std::size_t>(y) * half.width + static_cast<std::size_t>(x)];
    };
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const double x = (column + 0.5) * half.width / side - 0.5;
            const double y = (row + 0.5) * half.height / side - 0.5;
            const auto x0 = static_cast<std::int64_t>(std::floor(x));
            const auto y0 = static_cast<std::int64_t>(std::floor(y));
            const auto fx = static_cast<float>(x - static_cast<double>(x0));
            const auto fy = static_cast<float>(y - static_cast<double>(y0));
            full.pixels.push_back((1.0F - fy) * ((1.0F - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
                                  fy * ((1.0F - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1)));
        }
    }
    return full;
}

TEST(QuadViews, LookLikeTheFullPictureToWhoLooksThere) {
    const QuadHome home;
    QuadProgram program(pattern, kSide_px);
    const QuadProgram::Frame frame = program.run(5);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const XrFovf& fov = frame.views[eye].fov;
        const render::LinearPicture& shown = frame.shown[eye];
        ASSERT_EQ(shown.width, kSide_px);
        const render::LinearPicture full = QuadProgram::seen(pattern, fov, kSide_px, kSide_px);
        const XrFovf& inner = frame.views[eye + 2].fov;
        const openxr_layer::PicturePart part = openxr_layer::part_of(
            {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown},
            {inner.angleLeft, inner.angleRight, inner.angleUp, inner.angleDown});
        // Inside the band, the inset's pixels are the full picture's; in the band there is no step.
        const double band = 0.5 * 0.2;
        std::size_t inside = 0;
        double worst_inside = 0.0;
        double sum_band = 0.0;
        double sum_outside = 0.0;
        std::size_t in_band = 0;
        std::size_t outside = 0;
        for (std::uint32_t row = 0; row < kSide_px; ++row) {
            for (std::uint32_t column = 0; column < kSide_px; ++column) {
                const double x = ((column + 0.5) / kSide_px - part.x) / part.width;
                const double y = ((row + 0.5) / kSide_px - part.y) / part.height;
                const std::size_t at = std::size_t{row} * kSide_px + column;
                const double off = std::abs(shown.pixels[at].x - full.pixels[at].x);
                const double edge = std::min(std::min(x, 1.0 - x), std::min(y, 1.0 - y));
                if (edge > band) {
                    ++inside;
                    worst_inside = std::max(worst_inside, off);
                } else if (edge > 0.0) {
                    ++in_band;
                    sum_band += off * off;
                } else {
                    ++outside;
                    sum_outside += off * off;
                }
            }
        }
        ASSERT_GT(inside, 1000U);
        ASSERT_GT(outside, 1000U);
        EXPECT_LT(worst_inside, 0.02) << "two codes of sRGB at most";
        EXPECT_GT(sum_outside / static_cast<double>(outside), 1e-4) << "it is coarser there";
        EXPECT_LT(sum_band / static_cast<double>(in_band),
                  sum_outside / static_cast<double>(outside));
        if (eye == 0) {
            const XrViewConfigurationView& outer = program.sizes()[0];
            const render::LinearPicture coarse =
                enlarged(QuadProgram::seen(pattern, fov, outer.recommendedImageRectWidth,
                                           outer.recommendedImageRectHeight),
                         kSide_px);
            const double with_inset = difference(full, shown, fov);
            const double without = difference(full, coarse, fov);
            RecordProperty("thresholds_with_inset", std::to_string(with_inset));
            RecordProperty("thresholds_without", std::to_string(without));
            EXPECT_LT(with_inset, 0.5 * without) << "without an inset: " << without;
        }
    }
    EXPECT_EQ(program.validation_messages(), 0U);
}

/// A picture of one colour is one colour: no edge of an inset shows.
TEST(QuadViews, HideTheirInsets) {
    const QuadHome home;
    QuadProgram program([](double, double) { return glm::vec3(0.2F, 0.5F, 0.8F); }, 320);
    const QuadProgram::Frame frame = program.run(3);
    for (const render::LinearPicture& shown : frame.shown) {
        for (const glm::vec3& pixel : shown.pixels) {
            ASSERT_NEAR(pixel.x, shown.pixels[0].x, 0.006);
            ASSERT_NEAR(pixel.z, shown.pixels[0].z, 0.009);
        }
        EXPECT_NEAR(shown.pixels[0].y, 0.5, 0.01);
    }
    EXPECT_EQ(program.validation_messages(), 0U);
}

/// Frames of which the GPU was timed while it composited them.
std::size_t composited(const session::SessionFile& session) {
    return static_cast<std::size_t>(std::ranges::count_if(session.frames, [](const auto& frame) {
        return frame.gpu_known && frame.gpu.passes[0].value_or(0) > 0;
    }));
}

/// What the composite costs the GPU is in the recording, frame by frame.
TEST(QuadViews, RecordWhatTheirCompositeCosts) {
    ScratchFolder folder;
    const std::string file = folder.file("quad.gaze");
    const QuadHome home({"layer.record=" + file});
    {
        QuadProgram program([](double x, double) { return glm::vec3(0.5F + 0.3F * float(x)); },
                            320);
        program.run(20);
        program.end();
    }
    const session::SessionFile session = value_or_throw(session::read_session(file));
    ASSERT_GE(session.frames.size(), 15U);
    EXPECT_GE(composited(session), session.frames.size() / 2);
    const std::string json = folder.file("report.json");
    const ProgramResult report = run_gazeloop({"report", file, "--json", json});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_THAT(report.out, testing::HasSubstr("composite"));
}

/// In OpenXR 1.1 it is a view configuration of the core, and asks for no extension.
TEST(QuadViews, NeedNoExtensionInTheCore) {
    const QuadHome home;
    QuadProgram program([](double, double) { return glm::vec3(0.2F, 0.5F, 0.8F); }, 320,
                        QuadWay::InProcessCore);
    const QuadProgram::Frame frame = program.run(3);
    EXPECT_EQ(frame.shown[0].width, 320U);
    EXPECT_NEAR(frame.shown[1].pixels[0].y, 0.5, 0.01);
    EXPECT_EQ(program.validation_messages(), 0U);
}

/// The loader, the layer's library and Monado, as an application has them; OpenXR's validation
/// layer listens between application and layer, then between layer and runtime.
TEST(QuadViews, GoThroughTheLoader) {
    const std::string ours = "XR_APILAYER_GAZELOOP_gaze";
    const std::string validation = "XR_APILAYER_LUNARG_core_validation";
    for (const std::string& loaded :
         {fmt::format("{}:{}", validation, ours), fmt::format("{}:{}", ours, validation)}) {
        SCOPED_TRACE(loaded);
        const ScratchFolder folder;
        const std::string recorded = folder.file("quad.gaze");
        const std::string said = folder.file("validation.txt");
        const QuadHome home({"layer.record=" + recorded}, loaded);
        for (const auto& [name, value] : openxr_validation_to(said)) {
            setenv(name.c_str(), value.c_str(), 1);
        }
        {
            QuadProgram program([](double x, double) { return glm::vec3(0.5F + 0.3F * float(x)); },
                                kSide_px, QuadWay::Loader);
            ASSERT_EQ(program.sizes().size(), 4U);
            const QuadProgram::Frame frame = program.run(12);
            for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
                const XrFovf& outer = frame.views[eye].fov;
                const XrFovf& inset = frame.views[eye + gaze::kEyeCount].fov;
                EXPECT_LT(outer.angleLeft, inset.angleLeft);
                EXPECT_GT(outer.angleRight, inset.angleRight);
                // An inset lies on the pixels of the full picture.
                EXPECT_NEAR(0.5 * (std::tan(inset.angleLeft) + std::tan(inset.angleRight)),
                            std::tan(glm::radians(kAzimuth_deg)), 2.0 / kSide_px);
            }
            EXPECT_EQ(program.validation_messages(), 0U);
        }
        EXPECT_EQ(openxr_validation_messages(said), "");
        const session::SessionFile session = value_or_throw(session::read_session(recorded));
        EXPECT_GE(session.frames.size(), 10U);
        EXPECT_GE(composited(session), session.frames.size() / 2);
        EXPECT_TRUE(std::ranges::any_of(session.events, [](const session::RecordedEvent& event) {
            return event.kind == "foveation-read";
        }));
        for (const session::RecordedFrame& frame : session.frames) {
            EXPECT_EQ(frame.frame.stamps.display.kind, time::StampKind::Predicted)
                << "the runtime's times are the host's, whoever stands between";
        }
        EXPECT_THAT(home.log(), testing::Not(testing::HasSubstr("warning")));
    }
}

}  // namespace
}  // namespace gazeloop::tests
