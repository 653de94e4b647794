#include "runtime/session/cursor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <array>

#include "runtime/session/session_recorder.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::session {
namespace {

using ::testing::HasSubstr;

class Cursors : public ::testing::Test {
  protected:
    /// Frames 0, 1, 3 and one beyond the signed numbers, each of which consumed a sample.
    void SetUp() override {
        const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
        for (const std::uint64_t index : kFrames) {
            gaze::GazeSample sample;
            sample.sequence = index;
            recorder->add(sample, index);
            frame::FrameRecord frame;
            frame.index = index;
            recorder->add(frame);
        }
        ASSERT_TRUE(recorder->close().complete());
    }

    static constexpr std::uint64_t kFar = std::uint64_t{1} << 63U;
    static constexpr std::array<std::uint64_t, 4> kFrames{0, 1, 3, kFar};
    tests::TemporaryFolder folder;
    std::filesystem::path file = folder / "run.session";
};

TEST_F(Cursors, GoFromTheFirstToTheLast) {
    const OpenSession session = value_or_throw(OpenSession::open(file));
    SampleCursor samples(session);
    EXPECT_EQ(samples.row(), nullptr);
    for (const std::uint64_t index : kFrames) {
        ASSERT_TRUE(value_or_throw(samples.next()));
        EXPECT_EQ(samples.row()->frame, index);
        EXPECT_EQ(samples.row()->sample.sequence, index);
    }
    for (int again = 0; again < 3; ++again) {
        EXPECT_FALSE(value_or_throw(samples.next()));
        EXPECT_EQ(samples.row(), nullptr);
    }
}

TEST_F(Cursors, MoveToFramesAtTheirOwnPace) {
    const OpenSession session = value_or_throw(OpenSession::open(file));
    FrameCursor first(session);
    FrameCursor second(session);
    ASSERT_TRUE(value_or_throw(move_to(first, 3)));
    EXPECT_EQ(first.row()->frame.index, 3U);
    ASSERT_TRUE(value_or_throw(move_to(second, 0)));
    ASSERT_TRUE(value_or_throw(move_to(second, 0))) << "where it stands";
    EXPECT_FALSE(value_or_throw(move_to(second, 2))) << "there is none";
    EXPECT_TRUE(value_or_throw(move_to(second, 3))) << "nothing was passed over";
    EXPECT_TRUE(value_or_throw(move_to(second, kFar)));
    EXPECT_FALSE(value_or_throw(move_to(second, kFar + 1)));
    EXPECT_FALSE(value_or_throw(move_to(second, kFar + 1)));
    EXPECT_EQ(first.row()->frame.index, 3U);
}

TEST_F(Cursors, NameFileAndRowOfWhatIsDamaged) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, "DELETE FROM view WHERE frame = 1 AND eye = 0", nullptr,
                           nullptr, nullptr),
              SQLITE_OK);
    sqlite3_close(database);
    const OpenSession session = value_or_throw(OpenSession::open(file));
    FrameCursor frames(session);
    ASSERT_TRUE(value_or_throw(move_to(frames, 0)));
    const auto moved = move_to(frames, 3);
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(moved.error().message, HasSubstr(file.string()));
    EXPECT_THAT(moved.error().message, HasSubstr("the left eye of frame 1 is missing"));
    EXPECT_EQ(frames.row(), nullptr);
}

}  // namespace
}  // namespace gazeloop::session
