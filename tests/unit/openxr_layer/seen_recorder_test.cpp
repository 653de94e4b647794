// What is seen is in the session, or counted as lost: in the file and in the log.
#include "runtime/openxr_layer/seen_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "runtime/session/session_file.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

TEST(SeenRecorder, LosesNothingInSilence) {
    const Home home;
    const std::filesystem::path file = home.folder.path() / "session.gaze";
    // Far more at once than the queue holds.
    constexpr std::uint64_t kFrames = 60'000;
    {
        const auto recorder = value_or_throw(SeenRecorder::open(file, {}, {}));
        for (std::uint64_t index = 0; index < kFrames; ++index) {
            SeenFrame seen;
            seen.index = index;
            recorder->add(seen);
        }
    }
    const session::SessionFile session = value_or_throw(session::read_session(file));
    const std::uint64_t lost = session.records_dropped;
    EXPECT_EQ(session.frames.size() + lost, kFrames);
    ASSERT_GT(lost, 0U) << "the queue was never full";
    EXPECT_THAT(home.log(), testing::HasSubstr(std::to_string(lost) + " records were lost"));
}

TEST(SeenRecorder, SaysWhyNothingIsRecorded) {
    const auto recorder = SeenRecorder::open("/nowhere/session.gaze", {}, {});
    ASSERT_FALSE(recorder);
    EXPECT_THAT(recorder.error().message, testing::HasSubstr("/nowhere/session.gaze"));
}

}  // namespace
}  // namespace gazeloop::openxr_layer
