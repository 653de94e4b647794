// --preview as somebody sees it who sits in front of the screen.
#include <gtest/gtest.h>
#include <png.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/session/session_file.h"
#include "tests/support/run_program.h"
#include "tests/support/x_display.h"

namespace gazeloop::tests {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kRing{255, 32, 32};
constexpr Colour kGpuBar{204, 121, 167};

std::ptrdiff_t count(const Screenshot& shot, const Colour& colour) {
    return std::ranges::count(shot.pixels, colour);
}

Screenshot read_png(const std::string& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << file;
    image.format = PNG_FORMAT_RGB;
    Screenshot picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    picture.pixels.resize(std::size_t{image.width} * image.height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr), 0);
    return picture;
}

class Preview : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_FALSE(server_.name().empty()) << "no Xvfb: ./dev test installs it";
    }

    /// A run at 320x360 an eye until something ends it. `meanwhile` runs once the loop does.
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& more,
                                    const std::function<void(int pid)>& meanwhile,
                                    const std::string& target = "headless") const {
        std::vector<std::string> words{"run", "--gaze", "fixed:6,4", "--target", target};
        for (const char* setting : {"render.scale=0.25", "vulkan.validation=true"}) {
            words.insert(words.end(), {"--set", setting});
        }
        words.insert(words.end(), {"--log-level", "debug"});
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words, {.environment = {{"DISPLAY", server_.name()}},
                                    .timeout = std::chrono::seconds(100),
                                    .trigger = "gaze: left eye: tracking",
                                    .on_trigger = meanwhile});
    }

    /// Waits until what is seen is as it should be; the last look in any case.
    static Screenshot wait_for(const SeenWindow& window,
                               const std::function<bool(const Screenshot&)>& right) {
        Screenshot shot = window.screenshot();
        for (int i = 0; i < 500 && !right(shot); ++i) {
            poll(nullptr, 0, 20);
            shot = window.screenshot();
        }
        return shot;
    }

    static std::uint64_t frame_of(const std::string& title) {
        const std::size_t at = title.rfind(' ');
        return at == std::string::npos ? 0 : std::stoull(title.substr(at + 1));
    }

    XServer server_;
    ScratchFolder folder_;
};

TEST_F(Preview, ShowsTheFrameAndMarksTheFovea) {
    const std::string session = folder_.file("session.gaze");
    Screenshot marked;
    Screenshot plain;
    std::uint64_t frame = 0;
    const ProgramResult result = run({"--preview", "left", "--record", session}, [&](int pid) {
        SeenWindow window(server_);
        ASSERT_NE(window.wait_for_title("left eye, frame"), "");
        const auto is_marked = [](const Screenshot& shot) {
            return count(shot, kRing) > 0 && count(shot, kGpuBar) > 0;
        };
        EXPECT_TRUE(is_marked(wait_for(window, is_marked)));
        // With the loop held, the window keeps its last frame, once that has arrived.
        kill(pid, SIGSTOP);
        poll(nullptr, 0, 500);
        EXPECT_TRUE(is_marked(wait_for(window, is_marked)));
        window.press('b');  // the bars may lie over the ring
        marked = wait_for(window, [](const Screenshot& shot) {
            return count(shot, kRing) > 0 && count(shot, kGpuBar) == 0;
        });
        window.press('f');
        plain = wait_for(window, [](const Screenshot& shot) {
            return count(shot, kRing) == 0 && count(shot, kGpuBar) == 0;
        });
        frame = frame_of(window.wait_for_title("left eye, frame"));
        kill(pid, SIGCONT);
        window.close();
    });
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("the preview was closed"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
    ASSERT_LT(frame, recorded->frames.size());

    // The picture, bit for bit but for a rounding of the reduction.
    const std::string pictures = folder_.file("pictures");
    const ProgramResult replayed =
        run_gazeloop({"replay", session, "--quiet", "--frames", std::to_string(frame + 1),
                      "--snapshot", pictures});
    ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
    const Screenshot expected = read_png(pictures + "/left-result.png");
    ASSERT_EQ(plain.width, expected.width);
    ASSERT_EQ(plain.height, expected.height);
    int largest = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(plain.pixels[i][c] - expected.pixels[i][c]));
        }
    }
    EXPECT_LE(largest, 1);

    // The ring, around the fovea of that frame.
    const gaze::PixelPosition& fovea = recorded->frames[frame].frame.fovea.eyes[0].position;
    double least = 1e9;
    double most = 0.0;
    double x_sum = 0.0;
    double y_sum = 0.0;
    auto pixel = marked.pixels.begin();
    for (int y = 0; y < marked.height; ++y) {
        for (int x = 0; x < marked.width; ++x, ++pixel) {
            if (*pixel == kRing) {
                const double r = std::hypot(x + 0.5 - fovea.x_px, y + 0.5 - fovea.y_px);
                least = std::min(least, r);
                most = std::max(most, r);
                x_sum += x + 0.5;
                y_sum += y + 0.5;
            }
        }
    }
    const auto ring = static_cast<double>(count(marked, kRing));
    ASSERT_GT(ring, 20.0);
    EXPECT_NEAR(x_sum / ring, fovea.x_px, 2.0);
    EXPECT_NEAR(y_sum / ring, fovea.y_px, 2.0);
    EXPECT_GT(least, 5.0);
    EXPECT_LT(most - least, 4.0);
}

TEST_F(Preview, ObeysItsKeys) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result = run({"--preview", "--record", session}, [&](int) {
        SeenWindow window(server_);
        EXPECT_NE(window.wait_for_title("both eyes, frame"), "");
        EXPECT_EQ(window.screenshot().width, 640);
        window.press('2');
        EXPECT_NE(window.wait_for_title("right eye, frame"), "");
        window.press('1');
        EXPECT_NE(window.wait_for_title("left eye, frame"), "");
        window.resize(500, 200);
        const Screenshot wide = wait_for(window, [](const Screenshot& shot) {
            return shot.width == 500 && shot.pixels[0] == Colour{0, 0, 0};
        });
        EXPECT_EQ(wide.pixels[0], (Colour{0, 0, 0})) << "beside the picture there is nothing";
        EXPECT_NE(wide.pixels[250], (Colour{0, 0, 0}));
        window.press('3');
        EXPECT_NE(window.wait_for_title("both eyes, frame"), "");
        window.press('q');
    });
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
}

// A window that answers no more drops its frames; the loop goes its way.
TEST_F(Preview, DoesNotHoldTheLoopUp) {
    const ProgramResult result = run({"--preview", "--frames", "200"}, [](int pid) {
        std::ifstream file("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) +
                           "/children");
        int child = 0;
        ASSERT_TRUE(file >> child);
        kill(child, SIGSTOP);
    });
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("200 frames, limit reached"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(" 0 dropped"), std::string::npos) << result.err;
}

TEST_F(Preview, IsSurvivedWhenTheDisplayGoesAway) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result =
        run({"--preview", "--frames", "200", "--record", session}, [&](int) { server_.end(); });
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("the preview's window broke"), std::string::npos) << result.err;
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_EQ(recorded->frames.size(), 200U);
}

TEST_F(Preview, ShowsWhatGoesToAHeadset) {
    const ProgramResult result = run(
        {"--preview", "right"},
        [&](int) {
            SeenWindow window(server_);
            EXPECT_NE(window.wait_for_title("right eye, frame"), "");
            const Screenshot shot =
                wait_for(window, [](const Screenshot& at) { return count(at, kRing) > 0; });
            EXPECT_GT(count(shot, kRing), 20);
            window.close();
        },
        "openxr");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
}

TEST_F(Preview, LeavesTheFramesAlone) {
    const auto hashes = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{
            "replay", folder_.file("gaze.csv"), "--frames", "12", "--quiet", "--hash",
            "--set",  "render.scale=0.1"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result =
            run_gazeloop(words, {.environment = {{"DISPLAY", server_.name()}}});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_NE(result.out.find("hash pixels"), std::string::npos) << result.out;
        return result.out;
    };
    ASSERT_EQ(
        run_gazeloop({"simulate", "gaze", folder_.file("gaze.csv"), "--seconds", "1"}).exit_code,
        0);
    EXPECT_EQ(hashes({"--preview"}), hashes({}));
}

TEST(PreviewWithoutDisplay, IsRefused) {
    for (const char* display : {"", ":4321"}) {
        const ProgramResult result =
            run_gazeloop({"run", "--target", "headless", "--frames", "1", "--preview"},
                         {.environment = {{"DISPLAY", display}}});
        EXPECT_EQ(result.exit_code, 4) << result.err;
        EXPECT_NE(result.err.find("--preview: no window can be opened"), std::string::npos)
            << result.err;
        EXPECT_NE(result.err.find("xvfb-run"), std::string::npos) << result.err;
    }
}

TEST(PreviewWithoutDisplay, TellsEyesFromFiles) {
    const ProgramResult eye = run_gazeloop({"run", "--preview", "middle"});
    EXPECT_EQ(eye.exit_code, 2);
    EXPECT_NE(eye.err.find("left, right or both"), std::string::npos) << eye.err;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"replay", "--preview", "/nowhere/gaze.csv"},
          {"replay", "--preview", "left", "/nowhere/gaze.csv"},
          {"replay", "/nowhere/gaze.csv", "--preview"}}) {
        const ProgramResult file = run_gazeloop(words);
        EXPECT_EQ(file.exit_code, 3);
        EXPECT_NE(file.err.find("/nowhere/gaze.csv: cannot be opened"), std::string::npos)
            << file.err;
    }
}

}  // namespace
}  // namespace gazeloop::tests
