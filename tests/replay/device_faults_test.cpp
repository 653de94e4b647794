// A Vulkan device that fails on demand: said with the remedy and the right code, nothing lost that
// was recorded until then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;

struct DeviceFault {
    const char* name;
    const char* plan;
    int exit_code;
    const char* says;
};

void PrintTo(const DeviceFault& fault, std::ostream* out) { *out << fault.name; }

class Device : public testing::TestWithParam<DeviceFault> {
  protected:
    [[nodiscard]] ProgramResult run() const {
        return run_gazeloop({"run", "--gaze", "fixed:1,1", "--frames", "40", "--target", "headless",
                             "--set", "render.scale=0.05", "--record", session()},
                            {.environment = vulkan_faults(GetParam().plan)});
    }
    [[nodiscard]] std::string session() const { return folder_.file("session.gaze"); }

    ScratchFolder folder_;
};

class FailingDevice : public Device {};

TEST_P(FailingDevice, EndsTheRunAndKeepsTheRecording) {
    const ProgramResult result = run();
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(GetParam().says));
    EXPECT_THAT(result.out, HasSubstr("gaze age"));

    const auto recorded = session::read_session(session());
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
    ASSERT_GT(recorded->frames.size(), 3U);
    EXPECT_LT(recorded->frames.size(), 40U);
    for (std::size_t i = 0; i < recorded->frames.size(); ++i) {
        EXPECT_EQ(recorded->frames[i].frame.index, i);
    }
    EXPECT_TRUE(std::ranges::any_of(recorded->events, [](const session::RecordedEvent& event) {
        return event.kind == "error" && event.text.find("Vulkan") != std::string::npos;
    }));
    EXPECT_EQ(run_gazeloop({"report", session()}).exit_code, 0);
    EXPECT_EQ(run_gazeloop({"replay", session()}).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Vulkan, FailingDevice,
    testing::Values(DeviceFault{"lost_at_submit", "vkQueueSubmit2@60=VK_ERROR_DEVICE_LOST", 5,
                                "the Vulkan device was lost"},
                    DeviceFault{"lost_at_wait", "vkWaitSemaphores@9=VK_ERROR_DEVICE_LOST", 5,
                                "the Vulkan device was lost"},
                    DeviceFault{"full_at_submit", "vkQueueSubmit2@60=VK_ERROR_OUT_OF_DEVICE_MEMORY",
                                5, "use a smaller picture"}),
    [](const auto& instance) { return instance.param.name; });

class UnusableDevice : public Device {};

TEST_P(UnusableDevice, IsRefusedWithoutARecording) {
    const ProgramResult result = run();
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(GetParam().says));
    EXPECT_TRUE(folder_.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Vulkan, UnusableDevice,
    testing::Values(DeviceFault{"without_memory",
                                "vkAllocateMemory@2=VK_ERROR_OUT_OF_DEVICE_MEMORY", 4,
                                "use a smaller picture"},
                    DeviceFault{"without_an_image", "vkCreateImage@1=VK_ERROR_OUT_OF_DEVICE_MEMORY",
                                4, "use a smaller picture"},
                    DeviceFault{"lost_at_its_first_frame", "vkQueueSubmit2@1=VK_ERROR_DEVICE_LOST",
                                4, "ErrorDeviceLost"}),
    [](const auto& instance) { return instance.param.name; });

// Compiling ahead of the first frame takes the renderer itself: a second one would create its
// pipelines once more. Kernel foveated rendering has three.
TEST(WarmUp, CreatesNoPipelineTwice) {
    const std::vector<std::string> run{"run",      "--gaze",   "fixed:1,1", "--frames",         "3",
                                       "--target", "headless", "--set",     "render.scale=0.05"};
    const char* const plan = "vkCreateGraphicsPipelines@%=VK_ERROR_OUT_OF_HOST_MEMORY";
    const auto failing_at = [&](const std::string& call) {
        std::string text = plan;
        return run_gazeloop(run,
                            {.environment = vulkan_faults(text.replace(text.find('%'), 1, call))});
    };
    EXPECT_EQ(failing_at("4").exit_code, 0);
    EXPECT_NE(failing_at("3").exit_code, 0) << "the count is not that of this method any more";
}

}  // namespace
}  // namespace gazeloop::tests
