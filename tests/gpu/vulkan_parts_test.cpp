// Parts of runtime/vulkan on a device, with validation.
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "runtime/vulkan/history.h"
#include "runtime/vulkan/run_once.h"
#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

using VulkanParts = FrameRendererTest;

// Tables get into a device's own memory also where the host cannot write there.
TEST_F(VulkanParts, ADeviceBufferHoldsItsContentEitherWay) {
    std::vector<std::uint32_t> content(5000);
    std::iota(content.begin(), content.end(), 7U);
    for (const auto way :
         {vulkan::DeviceBuffer::Way::Shortest, vulkan::DeviceBuffer::Way::Copied}) {
        const vulkan::DeviceBuffer buffer(
            context(), std::as_bytes(std::span(content)),
            vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc, way);
        const vulkan::HostBuffer back(context(), content.size() * sizeof content[0],
                                      vk::BufferUsageFlagBits::eTransferDst);
        vulkan::run_once(context(), [&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(buffer.buffer(), back.buffer(), vk::BufferCopy(0, 0, back.size()));
            const vk::MemoryBarrier2 to_host(
                vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
                vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
            commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
        });
        EXPECT_EQ(std::memcmp(back.mapped().data(), content.data(), back.size()), 0);
    }
}

// A pass that nobody listed is refused: it would have written past the times that are kept.
TEST_F(VulkanParts, APassRecorderRefusesWhatTheRunDoesNotHave) {
    const frame::PassList passes{"one", "two"};
    vulkan::PassRecorder recorder(context(), passes, true);
    EXPECT_THROW(recorder.begin("three"), std::logic_error);
    for (int i = 0; i < 2; ++i) {
        recorder.begin("one");
        recorder.begin("two");
    }
    recorder.begin_untimed();
    EXPECT_THROW(recorder.begin("one"), std::logic_error) << "more often than there is room for";
    const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
    const vk::raii::Semaphore done(context().device(), vk::SemaphoreCreateInfo({}, &timeline));
    recorder.submit(*done, 1);
    context().device().waitIdle();
}

TEST_F(VulkanParts, AHistoryHasNoPastAtFirstAndAfterAReset) {
    vulkan::History history(context(), {8, 8}, vk::Format::eR32G32B32A32Sfloat);
    history.advance();
    EXPECT_EQ(history.before(), nullptr);
    const vk::Image first = history.now().image.image();
    vulkan::run_once(context(), [&](const vk::raii::CommandBuffer& commands) {
        history.now().tracked.use(commands, vulkan::Use::ColorTarget);
        history.now().tracked.use(commands, vulkan::Use::Sampled);
    });
    history.advance();
    ASSERT_NE(history.before(), nullptr);
    EXPECT_EQ(history.before()->image.image(), first);
    EXPECT_NE(history.now().image.image(), first);
    EXPECT_EQ(history.before()->tracked.layout(), vk::ImageLayout::eShaderReadOnlyOptimal);
    history.reset();
    history.advance();
    EXPECT_EQ(history.before(), nullptr);
}

// Eight bits and floats of the same picture.
TEST_F(VulkanParts, PicturesAreThereInLinearLightToo) {
    const MethodConfig full = config(Method::Full);
    OffScreen off_screen(context(), scene(), passes_of(full), full);
    const FrameRequest at = request(full, {80, 60});
    off_screen.render(at.frame_view(), at.fovea());
    const Picture bytes = off_screen.picture(gaze::Eye::Left);
    const LinearPicture linear = off_screen.linear_picture(gaze::Eye::Left);
    ASSERT_EQ(linear.pixels.size(), bytes.pixels.size());
    double brightest = 0.0;
    for (std::size_t i = 0; i < bytes.pixels.size(); ++i) {
        const double encoded = bytes.pixels[i][1] / 255.0;
        const double expected =
            encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        ASSERT_NEAR(linear.pixels[i].y, expected, 1e-6);
        brightest = std::max(brightest, expected);
    }
    EXPECT_GT(brightest, 0.2);
}

}  // namespace
}  // namespace gazeloop::render
