// A study whose subject answers by the controllers of an OpenXR runtime, which a layer presses, and
// takes the headset off.
#include <nlohmann/json.hpp>

#include "tests/openxr/eye_gaze.h"
#include "tests/support/small_study.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;

/// A button pressed every 20 frames, whatever is shown then, for as long as any run lasts.
std::string pressed_again_and_again(const std::string& button) {
    std::string plan;
    for (int frame = 15; frame < 4000; frame += 20) {
        plan += (plan.empty() ? "" : ";") + button + "@" + std::to_string(frame) + "+3=down";
    }
    return plan;
}

class StudyAnswers : public EyeGaze {
  protected:
    ProgramResult sit(const std::string& plan, const std::string& gaze) {
        return run_gazeloop(
            {"study", "run", plan_, "--subject", "1", "--folder", folder_.file("answers"), "--gaze",
             gaze, "--target", "openxr", "--set", "render.scale=0.05", "--seconds", "60"},
            {.environment = gaze_layers(plan, gaze_file_, validation_file())});
    }
    nlohmann::json analysed() {
        const ProgramResult result = run_gazeloop({"study", "analyse", plan_, sitting(), "--json"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }
    [[nodiscard]] std::size_t recorded_gaze() const {
        return value_or_throw(session::read_session(sitting())).samples.size();
    }
    [[nodiscard]] std::string sitting() const {
        return folder_.file("answers/pressed.001.001.gaze");
    }

    std::string plan_ = folder_.write("plan.toml", small_study("pressed"));
};

TEST_F(StudyAnswers, AreThePressesOfAController) {
    const ProgramResult result = sit(pressed_again_and_again("second"), "fixed:0,0");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_no_validation_messages(result);
    EXPECT_THAT(result.err, HasSubstr(" 0 trials left"));
    const nlohmann::json json = analysed();
    EXPECT_EQ(json["subjects"][0]["answers"], 2);
    EXPECT_EQ(json["subjects"][0]["failed"], 1);  // the second button: different, each time
    const ProgramResult replayed = run_gazeloop({"replay", sitting()});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
}

// Both have actions in the one session.
TEST_F(StudyAnswers, ComeBesideTheEyeGazeOfTheSameRuntime) {
    plan_ = folder_.write("plan.toml", small_study("pressed") + "[gaze]\nfollow = true\n");
    const ProgramResult result = sit(pressed_again_and_again("first"), "openxr");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_no_validation_messages(result);
    EXPECT_THAT(result.err, HasSubstr(" 0 trials left"));
    EXPECT_EQ(analysed()["subjects"][0]["failed"], 0);
    EXPECT_GT(recorded_gaze(), 30U);
}

TEST_F(StudyAnswers, BeginAgainAfterTheHeadsetWasOff) {
    const ProgramResult result =
        sit(pressed_again_and_again("first") + ";xrWaitFrame@20+30=hidden", "fixed:0,0");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("the headset is off: put it on, the trial begins again"));
    EXPECT_THAT(result.err, HasSubstr(" 0 trials left"));
    EXPECT_EQ(analysed()["subjects"][0]["answers"], 2);
    EXPECT_EQ(run_gazeloop({"replay", sitting()}).exit_code, 0);
}

}  // namespace
}  // namespace gazeloop::tests
