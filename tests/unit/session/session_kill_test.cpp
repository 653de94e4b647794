#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <random>
#include <thread>
#include <vector>

#include "runtime/session/open_session.h"
#include "runtime/session/session_file.h"
#include "runtime/session/session_recorder.h"
#include "runtime/session/study_rows.h"
#include "runtime/time/clock.h"
#include "tests/support/nobody.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"
#include "tests/unit/session/child_process.h"

namespace gazeloop::session {
namespace {

constexpr std::int64_t kMayBeLostNs = 100'000'000;

/// What the child tells of each frame, after it was handed to the recorder.
struct HandedOver {
    std::uint64_t index;
    std::int64_t at_ns;
};

/// Records frames every 2 ms, each with a sample and the frame before's GPU part, until killed.
int record_until_killed(const std::filesystem::path& file, int report) {
    const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
    for (std::uint64_t index = 0;; ++index) {
        recorder->add(gaze::GazeSample{}, index);
        recorder->add(latency::example_frame(index));
        if (index > 0) {
            recorder->add(latency::example_gpu(index - 1));
        }
        const HandedOver told{index, time::monotonic_ns()};
        if (write(report, &told, sizeof told) != sizeof told) {
            return 1;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

struct Killed {
    std::vector<HandedOver> handed_over;
    std::int64_t at_ns = 0;
};

Killed record_and_kill(const std::filesystem::path& file, std::chrono::milliseconds after) {
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
        return {};
    }
    const auto [from, to] = pipe_ends;
    const pid_t child =
        start_child([&file, report = to] { return record_until_killed(file, report); });
    close(to);
    Killed killed;
    HandedOver told{};
    bool alive = read(from, &told, sizeof told) == sizeof told;  // the recorder runs
    std::thread killer([&] {
        std::this_thread::sleep_for(after);
        killed.at_ns = time::monotonic_ns();
        kill(child, SIGKILL);
    });
    while (alive) {
        killed.handed_over.push_back(told);
        alive = read(from, &told, sizeof told) == sizeof told;
    }
    killer.join();
    waitpid(child, nullptr, 0);
    close(from);
    return killed;
}

TEST(KilledSession, LacksAtMostTheLastTenthOfASecond) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> milliseconds(1, 600);
    for (int round = 0; round < 12; ++round) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path file = folder / "run.session";
        const Killed killed =
            record_and_kill(file, std::chrono::milliseconds(milliseconds(random)));
        ASSERT_FALSE(killed.handed_over.empty());

        const SessionFile session = value_or_throw(read_session(file));
        EXPECT_FALSE(session.closed_cleanly);
        EXPECT_FALSE(session.writing_failed);
        EXPECT_TRUE(session.had_write_ahead_log || session.frames.empty());
        ASSERT_LE(session.frames.size(), killed.handed_over.size() + 1);
        for (std::uint64_t i = 0; i < session.frames.size(); ++i) {
            EXPECT_EQ(session.frames[i].frame.index, i);
        }
        if (session.frames.size() < killed.handed_over.size()) {
            const HandedOver& first_missing = killed.handed_over[session.frames.size()];
            EXPECT_LT(killed.at_ns - first_missing.at_ns, kMayBeLostNs)
                << killed.handed_over.size() - session.frames.size() << " frames are missing";
        }
        EXPECT_GE(session.samples.size(), session.frames.size());
    }
}

// Beside frames that come without a pause, as in a study.
TEST(KilledSession, HasEveryAnswerThatWasWaitedFor) {
    std::mt19937 random(11);
    std::uniform_int_distribution<std::uint32_t> answers(1, 60);
    for (int round = 0; round < 12; ++round) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path file = folder / "run.session";
        std::array<int, 2> pipe_ends{};
        ASSERT_EQ(pipe2(pipe_ends.data(), O_CLOEXEC), 0);
        const auto [from, to] = pipe_ends;
        const pid_t child = start_child([&file, report = to] {
            const auto recorder = value_or_throw(SessionRecorder::create(file, {.study = true}));
            for (std::uint32_t trial = 0;; ++trial) {
                recorder->add(latency::example_frame(trial));
                recorder->add(ResponseRecord{.frame = trial, .subject = 1, .trial = trial});
                if (!recorder->wait_until_written(std::chrono::seconds(20)) ||
                    write(report, &trial, sizeof trial) != sizeof trial) {
                    return 1;
                }
            }
        });
        close(to);
        std::uint32_t told = 0;
        const std::uint32_t last = answers(random);
        while (told < last && read(from, &told, sizeof told) == sizeof told) {
        }
        kill(child, SIGKILL);
        while (read(from, &told, sizeof told) == sizeof told) {
        }
        waitpid(child, nullptr, 0);
        close(from);
        const auto session = OpenSession::open(file);
        ASSERT_TRUE(session) << session.error().message;
        const auto kept = read_responses(*session);
        ASSERT_TRUE(kept) << kept.error().message;
        EXPECT_GE(told, last);
        EXPECT_GE(kept->size(), told + 1U);
        for (std::uint32_t trial = 0; trial < kept->size(); ++trial) {
            EXPECT_EQ(kept->at(trial).trial, trial);
        }
    }
}

TEST(KilledSession, WithoutItsLogHasNone) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "run.session";
    record_and_kill(file, std::chrono::milliseconds(200));
    const std::filesystem::path copy = folder / "copy.session";
    std::filesystem::copy_file(file, copy);
    const SessionFile session = value_or_throw(read_session(copy));
    EXPECT_FALSE(session.closed_cleanly);
    EXPECT_FALSE(session.had_write_ahead_log);
    EXPECT_TRUE(session.frames.empty());
    EXPECT_THAT(session.missing_log, testing::HasSubstr("its log copy.session-wal"));
    EXPECT_THAT(session.missing_log, testing::HasSubstr("copy copy.session-wal from where"));
    EXPECT_EQ(value_or_throw(read_session(file)).missing_log, "");
    std::filesystem::copy_file(file.string() + "-wal", copy.string() + "-wal",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::remove(copy.string() + "-shm");
    EXPECT_EQ(value_or_throw(read_session(copy)).missing_log, "");
    EXPECT_FALSE(value_or_throw(read_session(copy)).frames.empty());
    std::filesystem::remove(copy.string() + "-wal");
    std::filesystem::remove(copy.string() + "-shm");
    // Nor does what SQLite made in order to read it count as one.
    EXPECT_FALSE(value_or_throw(read_session(copy)).had_write_ahead_log);
}

TEST(KilledSession, IsReadableOrNotThereWhenKilledWhileItIsCreatedOrClosed) {
    const SessionHeader header{.config = {{"sigma", "1.8"}}};
    const auto create = [&header](const std::filesystem::path& file) {
        return SessionRecorder::create(file, header).has_value() ? 0 : 1;
    };
    const tests::TemporaryFolder folder;
    const std::int64_t start_ns = time::monotonic_ns();
    ASSERT_EQ(run_in_child([&] { return create(folder / "whole.session"); }), 0);
    const std::int64_t whole_ns = time::monotonic_ns() - start_ns;

    constexpr int kRounds = 100;
    for (int round = 0; round < kRounds; ++round) {
        const std::filesystem::path file = folder / fmt::format("{}.session", round);
        const pid_t child = start_child([&] { return create(file); });
        std::this_thread::sleep_for(std::chrono::nanoseconds(whole_ns * round / kRounds));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);

        EXPECT_FALSE(std::filesystem::exists(file.string() + "-journal"));
        if (std::filesystem::exists(file)) {
            const Expected<SessionFile> session = read_session(file);
            ASSERT_TRUE(session) << session.error().message;
            EXPECT_EQ(session->config("sigma"), "1.8");
        } else {
            EXPECT_EQ(create(file), 0);
        }
    }
}

TEST(KilledSession, CanBeReadInAFolderThatCannotBeWritten) {
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "run.session";
    record_and_kill(file, std::chrono::milliseconds(200));
    for (const char* part : {"", "-wal", "-shm"}) {
        std::filesystem::permissions(file.string() + part, std::filesystem::perms(0444));
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
    const auto read_as_nobody = [&file] {
        return run_in_child([&file] {
            if (!tests::become_nobody()) {
                return 2;
            }
            const Expected<SessionFile> session = read_session(file);
            if (session) {
                return session->frames.empty() ? 3 : 0;
            }
            return session.error().message.find("copy") != std::string::npos ? 1 : 4;
        });
    };
    EXPECT_EQ(read_as_nobody(), 0);

    // Without its index the log cannot be read there: an error that says what to do.
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
    std::filesystem::remove(file.string() + "-shm");
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
    EXPECT_EQ(read_as_nobody(), 1);
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
}

}  // namespace
}  // namespace gazeloop::session
