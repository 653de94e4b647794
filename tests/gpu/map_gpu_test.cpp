// The map as the shaders compute it, on the device, against double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "runtime/render/eye_uniforms.h"
#include "runtime/render/kfr_eye.h"
#include "runtime/render/pipelines.h"

namespace gazeloop::render {
namespace {

constexpr std::uint32_t kProbeWords[] = {
#include "map_probe.comp.inc"
};
constexpr double kTurn = 2.0 * std::numbers::pi;

struct Input {
    glm::vec2 position;
    glm::vec2 cell;
};
struct Output {
    glm::vec2 lp;
    glm::vec2 position;
    glm::vec3 ray;
    float unused;
};

class Probe {
  public:
    Probe() : context_({.validation = true, .device = ""}, nullptr) {}

    std::vector<Output> run(const KfrEye& eye, const EyeUniforms& uniforms,
                            const std::vector<Input>& inputs) {
        const vk::raii::Device& device = context_.device();
        HostBuffer uniform_buffer(context_, sizeof uniforms,
                                  vk::BufferUsageFlagBits::eUniformBuffer);
        uniform_buffer.write(uniforms);
        HostBuffer input_buffer(context_, inputs.size() * sizeof(Input),
                                vk::BufferUsageFlagBits::eStorageBuffer);
        input_buffer.write(std::span<const Input>(inputs));
        HostBuffer output_buffer(context_, inputs.size() * sizeof(Output),
                                 vk::BufferUsageFlagBits::eStorageBuffer);

        using Type = vk::DescriptorType;
        const std::vector<std::tuple<std::uint32_t, Type, vk::Buffer>> resources{
            {kEyeUniformsBinding, Type::eUniformBuffer, uniform_buffer.buffer()},
            {kMapTablesBinding, Type::eUniformBuffer, eye.map_tables()},
            {kColumnTableBinding, Type::eStorageBuffer, eye.column_table()},
            {kRowTableBinding, Type::eStorageBuffer, eye.row_table()},
            {6, Type::eStorageBuffer, input_buffer.buffer()},
            {7, Type::eStorageBuffer, output_buffer.buffer()}};
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        bindings.reserve(resources.size());
        for (const auto& [binding, type, buffer] : resources) {
            bindings.emplace_back(binding, type, 1, vk::ShaderStageFlagBits::eCompute);
        }
        const vk::raii::DescriptorSetLayout set_layout(
            device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
        const vk::raii::PipelineLayout layout(device,
                                              vk::PipelineLayoutCreateInfo({}, *set_layout));
        const vk::raii::ShaderModule module(
            device, vk::ShaderModuleCreateInfo({}, sizeof kProbeWords, kProbeWords));
        const vk::raii::Pipeline pipeline(
            device, nullptr,
            vk::ComputePipelineCreateInfo(
                {},
                vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eCompute, *module,
                                                  "main"),
                *layout));
        const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 2),
                               vk::DescriptorPoolSize(Type::eStorageBuffer, 4)};
        const vk::raii::DescriptorPool pool(
            device, vk::DescriptorPoolCreateInfo(
                        vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes));
        const vk::raii::DescriptorSets sets(device,
                                            vk::DescriptorSetAllocateInfo(*pool, *set_layout));
        for (const auto& [binding, type, buffer] : resources) {
            const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
            device.updateDescriptorSets(
                vk::WriteDescriptorSet(*sets[0], binding, 0, type, {}, info), {});
        }
        const vk::raii::CommandPool command_pool(
            device, vk::CommandPoolCreateInfo({}, context_.queue_family()));
        const vk::raii::CommandBuffers buffers(
            device,
            vk::CommandBufferAllocateInfo(*command_pool, vk::CommandBufferLevel::ePrimary, 1));
        buffers[0].begin(vk::CommandBufferBeginInfo());
        buffers[0].bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
        buffers[0].bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *sets[0], {});
        buffers[0].dispatch(static_cast<std::uint32_t>((inputs.size() + 63) / 64), 1, 1);
        const vk::MemoryBarrier2 to_host(
            vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderWrite,
            vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
        buffers[0].pipelineBarrier2(vk::DependencyInfo({}, to_host));
        buffers[0].end();
        const vk::CommandBufferSubmitInfo submit(*buffers[0]);
        context_.queue().submit2(vk::SubmitInfo2({}, {}, submit));
        device.waitIdle();
        std::vector<Output> outputs(inputs.size());
        std::memcpy(outputs.data(), output_buffer.mapped().data(), output_buffer.size());
        return outputs;
    }

    [[nodiscard]] const VulkanContext& context() const { return context_; }

  private:
    VulkanContext context_;
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
    const KfrEye eye(probe.context(), parameters, image);
    foveation::SamplingPlan plan;
    foveation::plan_kfr(parameters, eye.lp(), image, fovea, plan);
    gaze::EyeView view{
        .fov = {-0.8, 0.8, 0.8, -0.8}, .width_px = image.width_px, .height_px = image.height_px};
    const EyeUniforms uniforms = eye_uniforms(view, 0.0, 1, &plan);

    std::mt19937 random(11);
    std::uniform_int_distribution<std::uint32_t> x(0, image.width_px - 1);
    std::uniform_int_distribution<std::uint32_t> y(0, image.height_px - 1);
    std::uniform_int_distribution<std::uint32_t> column(0, eye.lp().width - 1);
    std::uniform_int_distribution<std::uint32_t> row(0, eye.lp().height - 1);
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
        if (!std::isfinite(out.lp.x + out.lp.y + out.position.x + out.position.y)) {
            ++worst.not_finite;
            continue;
        }
        const glm::dvec2 d = glm::dvec2(inputs[i].position) - glm::dvec2(fovea.x_px, fovea.y_px);
        const double r = glm::length(d);
        if (r >= 2.0) {
            const double radius = map.radius_px(out.lp.x / static_cast<double>(eye.lp().width));
            const double angle = out.lp.y / static_cast<double>(eye.lp().height) * kTurn;
            const glm::dvec2 back = radius * glm::dvec2(std::cos(angle), std::sin(angle));
            worst.forward_px = std::max(worst.forward_px, glm::length(back - d));
        }
        const double true_radius = map.radius_px((inputs[i].cell.x + 0.5) / eye.lp().width);
        const double true_angle = (inputs[i].cell.y + 0.5) / eye.lp().height * kTurn;
        const glm::dvec2 true_position =
            glm::dvec2(fovea.x_px, fovea.y_px) +
            true_radius * glm::dvec2(std::cos(true_angle), std::sin(true_angle));
        worst.inverse_px =
            std::max(worst.inverse_px, glm::length(glm::dvec2(out.position) - true_position));
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
    const KfrEye eye(probe().context(), parameters, image);
    foveation::SamplingPlan plan;
    foveation::plan_kfr(parameters, eye.lp(), image, fovea, plan);
    const EyeUniforms uniforms =
        eye_uniforms({.fov = {-1, 1, 1, -1}, .width_px = 640, .height_px = 480}, 0.0, 1, &plan);
    const float h = static_cast<float>(eye.lp().height);
    const std::vector<Output> outputs =
        probe().run(eye, uniforms,
                    {{{320.5F, 240.5F}, {0, 0}},    // the fovea itself: direction (0, 0)
                     {{420.5F, 240.5F}, {0, 0}},    // angle 0
                     {{420.5F, 240.499F}, {0, 0}},  // just before a full turn
                     {{320.5F, 340.5F}, {0, 0}},    // a quarter: screen y points down
                     {{220.5F, 240.5F}, {0, 0}},    // a half
                     {{320.5F, 140.5F}, {0, 0}}});  // three quarters
    EXPECT_EQ(outputs[0].lp, glm::vec2(0.0F, 0.0F));
    EXPECT_EQ(outputs[1].lp.y, 0.0F);
    EXPECT_NEAR(outputs[2].lp.y, h, h * 1e-5F);
    EXPECT_LE(outputs[2].lp.y, h);
    EXPECT_FLOAT_EQ(outputs[3].lp.y, 0.25F * h);
    EXPECT_FLOAT_EQ(outputs[4].lp.y, 0.5F * h);
    EXPECT_FLOAT_EQ(outputs[5].lp.y, 0.75F * h);
}

// Right way up, not mirrored, asymmetric and turned: the device's rays are gaze::unproject's.
TEST_F(MapOnDevice, ShootsTheRaysOfTheView) {
    const foveation::KfrParameters parameters{.sigma = 2.0, .kernel = {4}};
    const foveation::ImageSize image{640, 480};
    const KfrEye eye(probe().context(), parameters, image);
    foveation::SamplingPlan plan;
    foveation::plan_kfr(parameters, eye.lp(), image, {320, 240}, plan);
    gaze::EyeView view{.fov = {-0.9, 0.7, 0.6, -0.8}, .width_px = 640, .height_px = 480};
    view.pose.orientation = glm::normalize(glm::dquat(0.9, 0.1, -0.4, 0.05));
    const std::vector<Input> inputs{{{0.5F, 0.5F}, {0, 0}},
                                    {{639.5F, 0.5F}, {0, 0}},
                                    {{0.5F, 479.5F}, {0, 0}},
                                    {{411.5F, 77.5F}, {0, 0}}};
    const std::vector<Output> outputs = probe().run(eye, eye_uniforms(view, 0.0, 1, &plan), inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 expected =
            view.pose.orientation *
            gaze::unproject({inputs[i].position.x, inputs[i].position.y}, view);
        EXPECT_LT(glm::length(glm::dvec3(outputs[i].ray) - expected), 1e-6) << i;
    }
}

}  // namespace
}  // namespace gazeloop::render
