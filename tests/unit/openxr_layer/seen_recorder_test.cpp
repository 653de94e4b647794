// What is seen is in the session, or counted as lost: in the file and in the log.
#include "runtime/openxr_layer/seen_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

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

TEST(SeenRecorder, SaysInMidRunThatTheRecordingHasGone) {
    const Home home;
    const std::filesystem::path file = home.folder.path() / "session.gaze";
    const auto recorder = value_or_throw(SeenRecorder::open(file, {}, {}));
    std::filesystem::remove(file);
    constexpr int kLooks = 2'000;
    for (int look = 0; look < kLooks && home.log().empty(); ++look) {
        SeenFrame seen;
        seen.index = static_cast<std::uint64_t>(look);
        recorder->add(seen);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_THAT(home.log(), testing::HasSubstr("moved or removed"));
}

TEST(SeenRecorder, SaysWhyNothingIsRecorded) {
    const auto recorder = SeenRecorder::open("/nowhere/session.gaze", {}, {});
    ASSERT_FALSE(recorder);
    EXPECT_THAT(recorder.error().message, testing::HasSubstr("/nowhere/session.gaze"));
}

}  // namespace
}  // namespace gazeloop::openxr_layer
