// A study whose subject answers in the preview's window: by its keys, and by a game controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/preload.h"
#include "tests/support/run_program.h"
#include "tests/support/small_study.h"
#include "tests/support/x_display.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

double share_of_black(const Screenshot& shot) {
    return static_cast<double>(std::ranges::count(shot.pixels, std::array<std::uint8_t, 3>{})) /
           static_cast<double>(shot.pixels.size());
}

class StudyWindow : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_FALSE(server_.name().empty()) << "no Xvfb: ./dev test installs it";
    }

    [[nodiscard]] ProgramResult sit(Environment environment,
                                    const std::function<void()>& meanwhile) const {
        environment.emplace_back("DISPLAY", server_.name());
        return run_gazeloop(
            {"study", "run", plan_, "--subject", "1", "--folder", folder_.file("answers"), "--gaze",
             "fixed:0,0", "--target", "headless", "--preview", "--set", "render.scale=0.05",
             "--log-level", "debug", "--seconds", "60"},
            {.environment = environment,
             .timeout = std::chrono::seconds(100),
             .trigger = "gaze: left eye: tracking",
             .on_trigger = [&](int /*pid*/) { meanwhile(); }});
    }
    [[nodiscard]] nlohmann::json analysed() const {
        const ProgramResult result = run_gazeloop({"study", "analyse", plan_, sitting(), "--json"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out)["subjects"][0];
    }

    [[nodiscard]] std::string sitting() const {
        return folder_.file("answers/window.001.001.gaze");
    }

    XServer server_;
    ScratchFolder folder_;
    std::string plan_ = folder_.write("plan.toml", small_study("window"));
};

TEST_F(StudyWindow, TakesItsKeys) {
    const ProgramResult result = sit({}, [&] {
        SeenWindow window(server_);
        ASSERT_NE(window.wait_for_title("frame"), "");
        // While the question waits for its answer, the window is as black as the display.
        double drawn = 0.0;
        double black = 0.0;
        for (int i = 0; i < 200 && (drawn < 0.5 || black < 0.5); ++i) {
            const double now = share_of_black(window.screenshot());
            drawn = std::max(drawn, 1.0 - now);
            black = std::max(black, now);
            poll(nullptr, 0, 20);
        }
        EXPECT_GT(drawn, 0.5);
        EXPECT_GT(black, 0.5);
        // Those that come too early are refused; keys that choose what is shown have no such
        // meaning now, nor does q end the run. A failed validation trial makes a rest, which g
        // ends.
        for (int i = 0; i < 300 && std::filesystem::exists(sitting() + "-wal"); ++i) {
            window.press(i == 3 ? 'q' : i % 5 == 4 ? 'g' : 'd');
            poll(nullptr, 0, 100);
        }
    });
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr(" 0 trials left"));
    EXPECT_EQ(analysed()["answers"], 2);
    EXPECT_EQ(analysed()["failed"], 1);
}

TEST_F(StudyWindow, TakesTheButtonsOfAGamepad) {
    Environment environment = preloaded(GAZELOOP_GAMEPAD);
    environment.emplace_back("GAZELOOP_TEST_GAMEPAD", "1");  // B: the second choice, "different"
    const ProgramResult result = sit(environment, [] {});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr(" 0 trials left"));
    EXPECT_EQ(analysed()["answers"], 2);
    EXPECT_EQ(analysed()["failed"], 1);
}

}  // namespace
}  // namespace gazeloop::tests
