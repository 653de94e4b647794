#include "runtime/session/session_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "runtime/session/open_session.h"
#include "runtime/session/session_file.h"
#include "runtime/session/study_rows.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/nobody.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"
#include "tests/unit/session/child_process.h"

namespace gazeloop::session {
namespace {

using ::testing::HasSubstr;

const SessionHeader kHeader{
    .meta = {.program = "gazeloop 0.1.0", .clock = latency::LoopClock::Virtual},
    .config = {{"sigma", "1.8"}, {"alpha", "4"}, {"title", "\u00e9 \"quoted\"; DROP TABLE meta"}},
    .device = {{"vulkan", ""}}};

class Recording : public ::testing::Test {
  protected:
    std::unique_ptr<SessionRecorder> start() {
        return value_or_throw(SessionRecorder::create(file, kHeader));
    }
    SessionFile read() { return value_or_throw(read_session(file)); }
    std::set<std::string> files() {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            names.insert(entry.path().filename());
        }
        return names;
    }

    tests::TemporaryFolder folder;
    std::filesystem::path file = folder / "run.session";
};

unsigned mode(const std::filesystem::path& file) {
    struct stat status{};
    return stat(file.c_str(), &status) == 0 ? status.st_mode & 0777U : 0U;
}

gaze::GazeSample sample(std::uint64_t sequence) {
    gaze::GazeSample result;
    result.sequence = sequence;
    return result;
}

TEST_F(Recording, HoldsWhatWasAddedInOrder) {
    const auto recorder = start();
    for (std::uint64_t index = 0; index < 50; ++index) {
        recorder->add(sample(2 * index), index);
        recorder->add(sample(2 * index + 1), index);
        recorder->add(latency::example_frame(index));
        if (index >= 2) {
            recorder->add(latency::example_gpu(index - 2));
        }
    }
    recorder->event({5, time::StampKind::Measured}, "gaze-lost", "left eye");
    EXPECT_TRUE(recorder->close().complete());

    const SessionFile session = read();
    EXPECT_TRUE(session.closed_cleanly);
    EXPECT_EQ(session.records_dropped, 0U);
    ASSERT_EQ(session.samples.size(), 100U);
    ASSERT_EQ(session.frames.size(), 50U);
    for (std::uint64_t i = 0; i < 100; ++i) {
        EXPECT_EQ(session.samples[i].sample.sequence, i);
        EXPECT_EQ(session.samples[i].frame, i / 2);
    }
    for (std::uint64_t i = 0; i < 50; ++i) {
        const RecordedFrame& frame = session.frames[i];
        EXPECT_EQ(frame.frame.index, i);
        EXPECT_EQ(frame.frame.stamps.display, latency::example_frame(i).stamps.display);
        EXPECT_EQ(frame.gpu.index, i);
        EXPECT_EQ(frame.gpu.gpu_end.known(), i < 48);
        EXPECT_EQ(frame.gpu.passes[0], i < 48 ? std::optional(3 * latency::kMs) : std::nullopt);
    }
    ASSERT_EQ(session.events.size(), 1U);
    EXPECT_EQ(session.events[0].time, (time::Stamp{5, time::StampKind::Measured}));
    EXPECT_EQ(session.events[0].kind, "gaze-lost");
    EXPECT_EQ(session.events[0].text, "left eye");
}

TEST_F(Recording, StatesItsHeader) {
    start()->close();
    const SessionFile session = read();
    const auto same = [](const NamedValue& a, const NamedValue& b) {
        return a.name == b.name && a.value == b.value;
    };
    EXPECT_TRUE(std::ranges::equal(session.header.config, kHeader.config, same));
    EXPECT_TRUE(std::ranges::equal(session.header.device, kHeader.device, same));
    EXPECT_EQ(session.header.meta.program, kHeader.meta.program);
    EXPECT_EQ(session.header.meta.clock, kHeader.meta.clock);
    EXPECT_EQ(session.schema_version, 2);
    EXPECT_EQ(session.config("sigma"), "1.8");
    EXPECT_EQ(session.config("beta"), std::nullopt);
}

TEST_F(Recording, LongEventTextIsCut) {
    const auto recorder = start();
    recorder->event({}, std::string(100, 'k'),
                    fmt::format("{}\u00e9 and more", std::string(239, 't')));
    recorder->close();
    const SessionFile session = read();
    ASSERT_EQ(session.events.size(), 1U);
    EXPECT_EQ(session.events[0].kind, std::string(32, 'k'));
    EXPECT_EQ(session.events[0].text, std::string(239, 't'));
}

TEST_F(Recording, HasALogBeforeItsFirstRecord) {
    const auto recorder = start();
    for (const char* const part : {"", "-wal"}) {  // as a program leaves them that is killed now
        std::filesystem::copy_file(file.string() + part, file.string() + ".killed" + part);
    }
    const auto killed = read_session(file.string() + ".killed");
    ASSERT_TRUE(killed) << killed.error().message;
    EXPECT_EQ(killed->missing_log, "");
    EXPECT_FALSE(killed->closed_cleanly);
    EXPECT_TRUE(killed->frames.empty());
    recorder->close();
}

TEST_F(Recording, IsForItsOwnerOnly) {
    const mode_t before = umask(0);
    const auto recorder = start();
    recorder->add(latency::example_frame(0));
    for (int tries = 0; tries < 200 && mode(file.string() + "-shm") == 0; ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(mode(file), 0600U);
    EXPECT_EQ(mode(file.string() + "-wal"), 0600U);
    EXPECT_EQ(mode(file.string() + "-shm"), 0600U);
    recorder->close();
    EXPECT_EQ(mode(file), 0600U);
    umask(before);
}

TEST_F(Recording, LeavesOneFile) {
    const auto recorder = start();
    recorder->add(latency::example_frame(0));
    recorder->close();
    EXPECT_EQ(files(), std::set<std::string>{"run.session"});
}

TEST_F(Recording, IsClosedByItsEnd) {
    start()->add(latency::example_frame(0));
    const SessionFile session = read();
    EXPECT_TRUE(session.closed_cleanly);
    EXPECT_EQ(session.frames.size(), 1U);
}

TEST_F(Recording, ClosesOnce) {
    const auto recorder = start();
    EXPECT_TRUE(recorder->close().complete());
    recorder->add(latency::example_frame(0));
    EXPECT_TRUE(recorder->close().complete());
    EXPECT_EQ(read().frames.size(), 0U);
}

TEST_F(Recording, CanBeReadWhileItRuns) {
    const auto recorder = start();
    recorder->add(latency::example_frame(0));
    std::size_t frames = 0;
    for (int tries = 0; tries < 200 && frames == 0; ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        const SessionFile session = read();
        EXPECT_FALSE(session.closed_cleanly);
        EXPECT_FALSE(session.writing_failed);
        frames = session.frames.size();
    }
    EXPECT_EQ(frames, 1U);
    EXPECT_TRUE(recorder->close().complete());
}

TEST_F(Recording, IsCompleteAlsoWhileSomebodyReads) {
    const auto recorder = start();
    recorder->add(latency::example_frame(0));
    sqlite3* reader = nullptr;
    ASSERT_EQ(sqlite3_open_v2(file.c_str(), &reader, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    sqlite3_exec(reader, "BEGIN; SELECT * FROM meta", nullptr, nullptr, nullptr);
    EXPECT_TRUE(recorder->close().complete());
    sqlite3_close(reader);
    const SessionFile session = read();
    EXPECT_TRUE(session.closed_cleanly);
    EXPECT_EQ(session.frames.size(), 1U);
}

TEST_F(Recording, RefusesAFileThatExists) {
    std::ofstream(file) << "precious";
    const auto recorder = SessionRecorder::create(file, kHeader);
    ASSERT_FALSE(recorder);
    EXPECT_EQ(recorder.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(recorder.error().message, HasSubstr(file.string()));
    EXPECT_THAT(recorder.error().message, HasSubstr("exists already"));
    EXPECT_EQ(std::filesystem::file_size(file), 8U);
    EXPECT_EQ(files(), std::set<std::string>{"run.session"});
}

TEST_F(Recording, RefusesALinkToNowhere) {
    std::filesystem::create_symlink("elsewhere", file);
    const auto recorder = SessionRecorder::create(file, kHeader);
    ASSERT_FALSE(recorder);
    EXPECT_THAT(recorder.error().message, HasSubstr("exists already"));
    EXPECT_EQ(files(), std::set<std::string>{"run.session"});
}

TEST_F(Recording, WithoutAThreadLeavesNothing) {
    const int result = run_in_child([this] {
        pthread_attr_t attributes{};
        constexpr std::size_t kMoreThanThereIs = std::size_t{1} << 50U;
        if (pthread_attr_init(&attributes) != 0 ||
            pthread_attr_setstacksize(&attributes, kMoreThanThereIs) != 0 ||
            pthread_setattr_default_np(&attributes) != 0) {
            return 2;
        }
        const auto recorder = SessionRecorder::create(file, kHeader);
        return !recorder && recorder.error().message.find(file.string()) != std::string::npos ? 0
                                                                                              : 1;
    });
    EXPECT_EQ(result, 0);
    EXPECT_TRUE(files().empty());
}

TEST_F(Recording, RefusesWhatAnEarlierSessionLeft) {
    std::ofstream(file.string() + "-wal") << "rest";
    const auto recorder = SessionRecorder::create(file, kHeader);
    ASSERT_FALSE(recorder);
    EXPECT_THAT(recorder.error().message, HasSubstr("run.session-wal"));
    EXPECT_EQ(files(), std::set<std::string>{"run.session-wal"});
}

TEST_F(Recording, RefusesAMissingFolder) {
    const auto recorder = SessionRecorder::create(folder / "none" / "run.session", kHeader);
    ASSERT_FALSE(recorder);
    EXPECT_EQ(recorder.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(recorder.error().message, HasSubstr("folder must exist"));
}

TEST_F(Recording, RefusesAFolderThatCannotBeWritten) {
    if (const std::string missing = tests::missing_for_nobody(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
    const int result = run_in_child([this] {
        const bool prepared = tests::become_nobody();
        const auto recorder = SessionRecorder::create(file, kHeader);
        return prepared && !recorder &&
                       recorder.error().message.find("writable") != std::string::npos
                   ? 0
                   : 1;
    });
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
    EXPECT_EQ(result, 0);
    EXPECT_TRUE(files().empty());
}

TEST_F(Recording, RefusesANameTwiceAndLeavesNothing) {
    const auto recorder =
        SessionRecorder::create(file, {.config = {{"sigma", "1.8"}, {"sigma", "2"}}});
    ASSERT_FALSE(recorder);
    EXPECT_THAT(recorder.error().message, HasSubstr("config.name"));
    EXPECT_TRUE(files().empty());
}

TEST_F(Recording, TakesNamesThatAreSpecialToSqlite) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    auto recorder = SessionRecorder::create(":memory:", kHeader);
    ASSERT_TRUE(recorder);
    EXPECT_TRUE((*recorder)->close().complete());
    EXPECT_TRUE(read_session(":memory:"));
    std::filesystem::current_path(before);
}

TEST_F(Recording, AddingDoesNotAllocate) {
    const auto recorder = start();
    const std::string text(500, 't');
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::uint64_t index = 0; index < 1000; ++index) {
        recorder->add(sample(index), index);
        recorder->add(latency::example_frame(index));
        recorder->add(latency::example_gpu(index));
        recorder->event({}, "kind", text);
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_TRUE(recorder->close().complete());
}

TEST_F(Recording, CountsWhatTheQueueCannotTake) {
    const auto recorder = start();
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    constexpr std::uint64_t kAdded = 40'000;
    for (std::uint64_t index = 0; index < kAdded; ++index) {
        recorder->add(sample(index), 0);
    }
    sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
    sqlite3_close(other);

    const RecordingStatus status = recorder->close();
    EXPECT_EQ(status.failure, "");
    EXPECT_GT(status.dropped, 0U);
    EXPECT_FALSE(status.complete());
    const SessionFile session = read();
    EXPECT_EQ(session.records_dropped, status.dropped);
    ASSERT_EQ(session.samples.size() + status.dropped, kAdded);
    for (std::uint64_t i = 0; i < session.samples.size(); ++i) {
        ASSERT_EQ(session.samples[i].sample.sequence, i);  // the newest are lost
    }
}

TEST_F(Recording, WaitsForTheDiskWhereItMay) {
    const auto recorder = value_or_throw(SessionRecorder::create(file, kHeader, WhenFull::Wait));
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    constexpr std::uint64_t kQueue = 32'768;
    constexpr std::uint64_t kAdded = 40'000;
    std::atomic<std::uint64_t> added{0};
    std::thread loop([&] {
        for (std::uint64_t index = 0; index < kAdded; ++index) {
            recorder->add(sample(index), 0);
            added.store(index + 1);
        }
    });
    while (added.load() < kQueue) {
        std::this_thread::yield();
    }
    sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
    sqlite3_close(other);
    loop.join();

    EXPECT_TRUE(recorder->close().complete());
    EXPECT_EQ(read().samples.size(), kAdded);
}

TEST_F(Recording, AFullDiskEndsTheWritingOnly) {
    const int result = run_in_child([this] {
        const auto recorder = start();
        const rlimit limit{500'000, 500'000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
            return 2;
        }
        signal(SIGXFSZ, SIG_IGN);
        std::uint64_t added = 0;
        while (added < 4000) {  // many times what the limit lets pass
            recorder->add(latency::example_frame(added++));
            std::this_thread::sleep_for(std::chrono::microseconds(300));
        }
        for (int i = 0; i < 50'000; ++i) {
            recorder->add(latency::example_frame(added++));  // neither blocks nor counts
        }
        const RecordingStatus status = recorder->close();
        const bool says = status.failure.find(file.string()) != std::string::npos &&
                          status.failure.find("disk I/O error") != std::string::npos;
        return says && !status.complete() && status.dropped == 0 ? 0 : 1;
    });
    ASSERT_EQ(result, 0);
    const SessionFile session = read();
    EXPECT_FALSE(session.closed_cleanly);
    EXPECT_TRUE(session.writing_failed);
    ASSERT_GT(session.frames.size(), 10U);
    for (std::uint64_t i = 0; i < session.frames.size(); ++i) {
        EXPECT_EQ(session.frames[i].frame.index, i);
    }
}

TEST_F(Recording, SaysWhenWhatWasWaitedForCannotBeWritten) {
    const int result = run_in_child([this] {
        const auto recorder = value_or_throw(SessionRecorder::create(file, {.study = true}));
        const auto answered = [&](std::uint32_t trial) {
            recorder->add(ResponseRecord{.subject = 1, .trial = trial});
            return recorder->wait_until_written(std::chrono::seconds(20));
        };
        if (!answered(0) || !answered(1)) {
            return 2;
        }
        const rlimit limit{1, 1};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
            return 3;
        }
        signal(SIGXFSZ, SIG_IGN);
        const auto start = std::chrono::steady_clock::now();
        if (answered(2) || answered(3)) {
            return 4;
        }
        // At once, and not after all its patience.
        return std::chrono::steady_clock::now() - start < std::chrono::seconds(10) &&
                       recorder->in_trouble()
                   ? 0
                   : 5;
    });
    EXPECT_EQ(result, 0);
    const auto session = OpenSession::open(file);
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(value_or_throw(read_responses(*session)).size(), 2U);
}

TEST_F(Recording, ReportsAFileThatWasRemoved) {
    const auto recorder = start();
    std::filesystem::remove(file);
    recorder->add(latency::example_frame(0));
    const RecordingStatus status = recorder->close();
    EXPECT_THAT(status.failure, HasSubstr("moved or removed"));
}

TEST_F(Recording, ARepeatedFrameEndsTheWriting) {
    const auto recorder = start();
    recorder->add(latency::example_frame(7));
    recorder->add(latency::example_frame(7));
    EXPECT_THAT(recorder->close().failure, HasSubstr("frame.number"));
    EXPECT_THAT(recorder->close().failure, HasSubstr("frame.number"));
    EXPECT_TRUE(read().writing_failed);
}

}  // namespace
}  // namespace gazeloop::session
