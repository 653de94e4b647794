// The map as the shaders compute it, on the device, against double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/numerics/map_probe.h"
#include "runtime/render/frame_uniforms.h"
#include "runtime/render/map_buffers.h"

namespace gazeloop::render {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

using Input = numerics::ProbeInput;
using Output = numerics::ProbeOutput;

class Probe {
  public:
    Probe() : context_({.validation = true, .device = ""}, nullptr), probe_(context_) {}

    std::vector<Output> run(const MapBuffers& tables, const numerics::ProbeUniforms& uniforms,
                            const std::vector<Input>& inputs) {
        return probe_.run(tables, uniforms, false, inputs);
    }

    [[nodiscard]] const vulkan::Context& context() const { return context_; }

  private:
    vulkan::Context context_;
    numerics::MapProbe probe_;
};

struct Worst {
    double forward_px = 0.0;
    double inverse_px = 0.0;
    int not_finite = 0;
};

/// Largest errors on the device, in pixels of the picture: of the position that lp_position's
/// result stands for, and of picture_position.
Worst worst_errors(Probe& probe, const foveation::KfrParameters& parameters,
                   foveation::ImageSize image, const gaze::PixelPosition& fovea) {
    const foveation::LpSize lp = value_or_throw(foveation::lp_buffer_size(parameters, image));
    const MapBuffers eye(probe.context(), foveation::build_map_tables(parameters.kernel, lp), 1,
                         lp.height);
    foveation::LogPolarPlan plan;
    foveation::plan_kfr(parameters, lp, image, fovea, plan);
    gaze::EyeView view{
        .fov = {-0.8, 0.8, 0.8, -0.8}, .width_px = image.width_px, .height_px = image.height_px};
    const numerics::ProbeUniforms uniforms{frame_uniforms(view, 0.0, 1, nullptr),
                                           foveation::map_uniforms(plan)};

    std::mt19937 random(11);
    std::uniform_int_distribution<std::uint32_t> x(0, image.width_px - 1);
    std::uniform_int_distribution<std::uint32_t> y(0, image.height_px - 1);
    std::uniform_int_distribution<std::uint32_t> column(0, lp.width - 1);
    std::uniform_int_distribution<std::uint32_t> row(0, lp.height - 1);
    std::vector<Input> inputs;
    inputs.reserve(20004);
    for (int i = 0; i < 20000; ++i) {
        inputs.push_back({glm::vec2(glm::uvec2(x(random), y(random))) + 0.5F,
                          glm::vec2(glm::uvec2(column(random), row(random)))});
    }
    // The corners and the pixels around the fovea.
    for (const float px : {0.5F, static_cast<float>(image.width_px) - 0.5F}) {
        for (const float py : {0.5F, static_cast<float>(image.height_px) - 0.5F}) {
            inputs.push_back({{px, py}, {0, 0}});
        }
    }
    const foveation::LogPolarMap map(parameters.kernel, image, fovea);
    Worst worst;
    const std::vector<Output> outputs = probe.run(eye, uniforms, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Output& out = outputs[i];
        if (!std::isfinite(out.share.x + out.share.y + out.place.x + out.place.y)) {
            ++worst.not_finite;
            continue;
        }
        const glm::dvec2 d = glm::dvec2(inputs[i].position_px) - glm::dvec2(fovea.x_px, fovea.y_px);
        const double r = glm::length(d);
        if (r >= 2.0) {
            const double radius = map.radius_px(out.share.x);
            const double angle = out.share.y * kTurn;
            const glm::dvec2 back = radius * glm::dvec2(std::cos(angle), std::sin(angle));
            worst.forward_px = std::max(worst.forward_px, glm::length(back - d));
        }
        const double true_radius = map.radius_px((inputs[i].cell.x + 0.5) / lp.width);
        const double true_angle = (inputs[i].cell.y + 0.5) / lp.height * kTurn;
        const glm::dvec2 true_position =
            glm::dvec2(fovea.x_px, fovea.y_px) +
            true_radius * glm::dvec2(std::cos(true_angle), std::sin(true_angle));
        worst.inverse_px =
            std::max(worst.inverse_px, glm::length(glm::dvec2(out.place) - true_position));
    }
    return worst;
}

struct Size {
    const char* name;
    foveation::ImageSize image;
    double bound_px;
};

void PrintTo(const Size& at, std::ostream* out) { *out << at.name; }

class MapOnDevice : public testing::TestWithParam<Size> {
  protected:
    static Probe& probe() {
        static Probe probe;
        return probe;
    }
};

TEST_P(MapOnDevice, StaysWithinItsBoundWhereverTheFoveaIs) {
    const double w = GetParam().image.width_px;
    const double h = GetParam().image.height_px;
    for (const double alpha : {0.5, 1.0, 4.0, 8.0}) {
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{w / 2, h / 2}, gaze::PixelPosition{w / 3 + 0.3, h / 5},
              gaze::PixelPosition{0, h / 2}, gaze::PixelPosition{w, h}}) {
            const Worst worst =
                worst_errors(probe(), {.sigma = 2.0, .kernel = {alpha}}, GetParam().image, fovea);
            EXPECT_LE(worst.forward_px, GetParam().bound_px)
                << "alpha " << alpha << " fovea " << fovea.x_px << ' ' << fovea.y_px;
            EXPECT_LE(worst.inverse_px, GetParam().bound_px)
                << "alpha " << alpha << " fovea " << fovea.x_px << ' ' << fovea.y_px;
            EXPECT_EQ(worst.not_finite, 0);
        }
    }
    EXPECT_EQ(probe().context().validation_messages(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Sizes, MapOnDevice,
                         testing::Values(Size{"smallest", {8, 8}, 1e-4},
                                         Size{"fove", {1280, 1440}, 0.005},
                                         Size{"ultra_hd", {3840, 2160}, 0.02},
                                         Size{"largest", {16384, 16384}, 0.05}),
                         [](const auto& instance) { return instance.param.name; });

TEST_F(MapOnDevice, IsFiniteFarOffScreenAndAtExtremeParameters) {
    for (const double alpha : {0.25, 16.0}) {
        for (const gaze::PixelPosition fovea :
             {gaze::PixelPosition{-2560, -1440}, gaze::PixelPosition{3840, 1800},
              gaze::PixelPosition{640.5, 360.5}}) {
            EXPECT_EQ(worst_errors(probe(), {.sigma = 32, .kernel = {alpha}}, {1280, 720}, fovea)
                          .not_finite,
                      0);
        }
    }
}

TEST_F(MapOnDevice, WrapsTheAngleOnce) {
    const foveation::KfrParameters parameters{.sigma = 2.0, .kernel = {4}};
    const foveation::ImageSize image{640, 480};
    const gaze::PixelPosition fovea{320.5, 240.5};
    const foveation::LpSize lp = value_or_throw(foveation::lp_buffer_size(parameters, image));
    const MapBuffers eye(probe().context(), foveation::build_map_tables(parameters.kernel, lp), 1,
                         lp.height);
    foveation::LogPolarPlan plan;
    foveation::plan_kfr(parameters, lp, image, fovea, plan);
    const numerics::ProbeUniforms uniforms{
        frame_uniforms({.fov = {-1, 1, 1, -1}, .width_px = 640, .height_px = 480}, 0.0, 1, nullptr),
        foveation::map_uniforms(plan)};
    const std::vector<Output> outputs =
        probe().run(eye, uniforms,
                    {{{320.5F, 240.5F}, {0, 0}},    // the fovea itself: direction (0, 0)
                     {{420.5F, 240.5F}, {0, 0}},    // angle 0
                     {{420.5F, 240.499F}, {0, 0}},  // just before a full turn
                     {{320.5F, 340.5F}, {0, 0}},    // a quarter: screen y points down
                     {{220.5F, 240.5F}, {0, 0}},    // a half
                     {{320.5F, 140.5F}, {0, 0}}});  // three quarters
    EXPECT_EQ(outputs[0].share, glm::vec2(0.0F, 0.0F));
    EXPECT_EQ(outputs[1].share.y, 0.0F);
    EXPECT_NEAR(outputs[2].share.y, 1.0F, 1e-5F);
    EXPECT_LE(outputs[2].share.y, 1.0F);
    EXPECT_FLOAT_EQ(outputs[3].share.y, 0.25F);
    EXPECT_FLOAT_EQ(outputs[4].share.y, 0.5F);
    EXPECT_FLOAT_EQ(outputs[5].share.y, 0.75F);
}

// Right way up, not mirrored, asymmetric and turned: the device's rays are gaze::unproject's.
TEST_F(MapOnDevice, ShootsTheRaysOfTheView) {
    const foveation::KfrParameters parameters{.sigma = 2.0, .kernel = {4}};
    const foveation::ImageSize image{640, 480};
    const foveation::LpSize lp = value_or_throw(foveation::lp_buffer_size(parameters, image));
    const MapBuffers eye(probe().context(), foveation::build_map_tables(parameters.kernel, lp), 1,
                         lp.height);
    foveation::LogPolarPlan plan;
    foveation::plan_kfr(parameters, lp, image, {320, 240}, plan);
    gaze::EyeView view{.fov = {-0.9, 0.7, 0.6, -0.8}, .width_px = 640, .height_px = 480};
    view.pose.orientation = glm::normalize(glm::dquat(0.9, 0.1, -0.4, 0.05));
    const std::vector<Input> inputs{{{0.5F, 0.5F}, {0, 0}},
                                    {{639.5F, 0.5F}, {0, 0}},
                                    {{0.5F, 479.5F}, {0, 0}},
                                    {{411.5F, 77.5F}, {0, 0}}};
    const std::vector<Output> outputs = probe().run(
        eye, {frame_uniforms(view, 0.0, 1, nullptr), foveation::map_uniforms(plan)}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 expected =
            view.pose.orientation *
            gaze::unproject({inputs[i].position_px.x, inputs[i].position_px.y}, view);
        EXPECT_LT(glm::length(glm::dvec3(outputs[i].ray) - expected), 1e-6) << i;
    }
}

}  // namespace
}  // namespace gazeloop::render
