// What a runtime may ask for while frames go on: an end, another mask. A layer of our own between
// the program and Monado asks for it (tests/support/openxr_layer).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

/// Before, the corners are hidden: two views, asked how much and what.
constexpr std::string_view kMaskChanges =
    "xrWaitFrame@10=event:VISIBILITY_MASK_CHANGED;xrGetVisibilityMaskKHR@5+99=";

class RuntimeWishes : public testing::Test {
  protected:
    /// A recorded run of up to 30 frames.
    ProgramResult run(const std::string& plan, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",   "--frames",         "30",    "--record", session(),
                                       "--set", "render.scale=0.2", "--hash"};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words, {.environment = openxr_faults(plan)});
    }

    [[nodiscard]] session::SessionFile recorded() const {
        return value_or_throw(session::read_session(session()));
    }

    [[nodiscard]] std::string session() const { return scratch_.file("session.gaze"); }

    ScratchFolder scratch_;
};

TEST_F(RuntimeWishes, AnEndIsAnOrderlyEnd) {
    const ProgramResult result = run("xrWaitFrame@10=exit");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("ended by the runtime"), std::string::npos) << result.err;
    const session::SessionFile session = recorded();
    EXPECT_TRUE(session.closed_cleanly);
    EXPECT_GE(session.frames.size(), 9U);
    EXPECT_LT(session.frames.size(), 30U);
    for (const session::RecordedFrame& frame : session.frames) {
        EXPECT_EQ(frame.gpu.pixel_hash.has_value(), frame.frame.should_render);
    }
    const auto exiting =
        std::ranges::find(session.events, "session state: EXITING", &session::RecordedEvent::text);
    EXPECT_NE(exiting, session.events.end());
}

TEST_F(RuntimeWishes, ARuntimeThatNeverSaysThatItHasEndedIsLeft) {
    const ProgramResult result = run("xrEndSession@1=silence");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("does not end the session"), std::string::npos) << result.err;
    EXPECT_TRUE(recorded().closed_cleanly);
    EXPECT_EQ(recorded().frames.size(), 30U);
}

TEST_F(RuntimeWishes, ALossIsSaidAndLosesNothing) {
    const ProgramResult result = run("xrWaitFrame@10=event:LOSS_PENDING");
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_NE(result.err.find("session loss pending"), std::string::npos) << result.err;
    const session::SessionFile session = recorded();
    EXPECT_TRUE(session.closed_cleanly);
    EXPECT_EQ(session.frames.size(), 10U);
    EXPECT_EQ(session.frames.back().gpu.pixel_hash.has_value(), true);
}

TEST_F(RuntimeWishes, AnotherMaskIsFollowedAndReplayed) {
    ASSERT_EQ(run(std::string(kMaskChanges) + "half").exit_code, 0);
    const session::SessionFile session = recorded();
    ASSERT_EQ(session.hidden.size(), 2U);
    EXPECT_EQ(session.hidden[0].frame, 0U);
    EXPECT_EQ((*session.hidden[0].meshes)[0].size(), 4U);  // Monado's corners
    EXPECT_EQ((*session.hidden[1].meshes)[1].size(), 2U);
    const std::uint64_t at = session.hidden[1].frame;
    ASSERT_GT(at, 5U);
    ASSERT_LT(at, session.frames.size());
    const frame::SampleCounts& corners = session.frames[at - 1].frame.samples;
    const frame::SampleCounts& half = session.frames[at].frame.samples;
    EXPECT_GT(corners.pixels_hidden, 0U);
    EXPECT_GT(half.pixels_hidden, corners.pixels_hidden);
    EXPECT_LE(half.pixels_hidden, half.pixels_output / 2);
    EXPECT_GT(half.grids[0].hidden, corners.grids[0].hidden);
    EXPECT_LT(half.grids[0].shaded, corners.grids[0].shaded);

    const ProgramResult replayed = run_gazeloop({"replay", RuntimeWishes::session(), "--hash"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out;
    EXPECT_NE(replayed.out.find("pictures equal in 29 of 29 frames"), std::string::npos)
        << replayed.out;
    const ProgramResult other = run_gazeloop(
        {"replay", RuntimeWishes::session(), "--hash", "--set", "render.hidden_area=false"});
    EXPECT_NE(other.out.find("settings differ"), std::string::npos) << other.out;
    EXPECT_EQ(other.out.find(", hidden"), std::string::npos) << other.out;
}

TEST_F(RuntimeWishes, AMaskMayGo) {
    ASSERT_EQ(run(std::string(kMaskChanges) + "none").exit_code, 0);
    const session::SessionFile session = recorded();
    ASSERT_EQ(session.hidden.size(), 2U);
    EXPECT_TRUE((*session.hidden[1].meshes)[0].empty());
    EXPECT_EQ(session.frames.back().frame.samples.pixels_hidden, 0U);
    EXPECT_EQ(run_gazeloop({"replay", RuntimeWishes::session(), "--hash"}).exit_code, 0);
}

// Full resolution and the foveated methods are compared on the same pixels.
TEST_F(RuntimeWishes, EveryMethodLeavesOutTheSame) {
    ASSERT_EQ(run("", {"--method", "full"}).exit_code, 0);
    const frame::SampleCounts full = recorded().frames.back().frame.samples;
    EXPECT_GT(full.pixels_hidden, 0U);
    EXPECT_EQ(full.shaded(), full.pixels_output - full.pixels_hidden);
    std::filesystem::remove(session());
    ASSERT_EQ(run("", {"--method", "kfr"}).exit_code, 0);
    EXPECT_EQ(recorded().frames.back().frame.samples.pixels_hidden, full.pixels_hidden);
    std::filesystem::remove(session());
    ASSERT_EQ(run("", {"--set", "render.hidden_area=false"}).exit_code, 0);
    EXPECT_EQ(recorded().frames.back().frame.samples.pixels_hidden, 0U);
    EXPECT_TRUE(recorded().hidden.empty());
}

TEST_F(RuntimeWishes, AMaskThatIsNoneIsRefused) {
    const ProgramResult result = run("xrGetVisibilityMaskKHR@1+99=odd");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("no list of triangles"), std::string::npos) << result.err;
    EXPECT_TRUE(recorded().hidden.empty());
}

}  // namespace
}  // namespace gazeloop::tests
