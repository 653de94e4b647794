// A disk that fills up, files that vanish or cannot be written: the loop goes on, the person is
// told at once, the code says it, and what could be written can be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "runtime/session/session_file.h"
#include "tests/support/run_program.h"
#include "tests/unit/session/child_process.h"

namespace gazeloop::tests {
namespace {

using session::run_in_child;
using ::testing::HasSubstr;

constexpr int kMayNotMount = 77;
constexpr std::uint64_t kFrames = 1500;
/// Room for part of them, however slowly they come: at the worst each has a commit of its own and
/// so has its gaze, and each writes at most a page of 4 KiB for each of ten tables and indices, and
/// one more.
constexpr std::uint64_t kRoom_bytes = 1'000'000;
constexpr std::uint64_t kLeastFrames = kRoom_bytes / (2 * 11ULL * 4096);

std::string last_error(const char* call) { return std::string(call) + ": " + std::strerror(errno); }

void write_map(const char* file, unsigned id) {
    std::ofstream(std::string("/proc/self/") + file) << "0 " << id << " 1";
}

/// Gives this process mounts of its own, which no other sees: as root, else as the root of a user
/// namespace. Empty: it has them; else why not.
std::string own_mounts() {
    if (unshare(CLONE_NEWNS) == 0) {
        // Fails where "/" is a chroot into a folder that is no mount point.
        return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0
                   ? ""
                   : last_error("making mounts private");
    }
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) {
        return last_error("a user namespace");
    }
    std::ofstream("/proc/self/setgroups") << "deny";
    write_map("uid_map", user);
    write_map("gid_map", group);
    return "";
}

class RecordingFault : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(run_gazeloop({"simulate", "gaze", trace(), "--seconds", "30"}).exit_code, 0);
        std::filesystem::create_directory(disk());
    }

    [[nodiscard]] std::string trace() const { return folder_.file("gaze.csv"); }
    [[nodiscard]] std::string disk() const { return folder_.file("disk"); }
    [[nodiscard]] std::string session() const { return disk() + "/session.gaze"; }
    [[nodiscard]] std::string summary() const { return folder_.file("summary.json"); }

    [[nodiscard]] ProgramResult record() const {
        return run_gazeloop({"replay", trace(), "--frames", std::to_string(kFrames), "--set",
                             "render.scale=0.02", "--record", session(), "--json", summary()});
    }

    /// Runs `body` with a file system of its own at disk(), in a process of its own. Skips the test
    /// where that is forbidden, and there alone: any other reason is a mistake of the test's.
    void on_small_disk(const std::string& options, const std::function<void()>& body) const {
        const int result = run_in_child([&] {
            if (const std::string reason = own_mounts(); !reason.empty()) {
                std::ofstream(folder_.file("reason")) << reason;
                return kMayNotMount;
            }
            if (mount("tmpfs", disk().c_str(), "tmpfs", 0, options.c_str()) != 0) {
                if (errno == EPERM || errno == EACCES) {
                    std::ofstream(folder_.file("reason")) << last_error("mount");
                    return kMayNotMount;
                }
                ADD_FAILURE() << "mounting a disk: " << std::strerror(errno);
                return 1;
            }
            body();
            return HasFailure() ? 1 : 0;
        });
        if (result == kMayNotMount) {
            std::ifstream reason(folder_.file("reason"));
            GTEST_SKIP()
                << "a small disk cannot be mounted here, as in most containers and chroots ("
                << reason.rdbuf() << ")";
        }
        EXPECT_EQ(result, 0);
    }

    /// The run came to its end and said what happened; the recording holds its beginning.
    void expect_incomplete(const ProgramResult& result) const {
        EXPECT_EQ(result.exit_code, 6) << result.err;
        EXPECT_THAT(result.err, HasSubstr(session() + ": recording ended early"));
        EXPECT_THAT(result.err, HasSubstr("the run goes on"));
        EXPECT_THAT(result.err, HasSubstr(std::to_string(kFrames) + " frames"));
        EXPECT_EQ(nlohmann::json::parse(std::ifstream(summary()))["frames"]["total"], kFrames);
        const auto recorded = session::read_session(session());
        ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
        EXPECT_FALSE(recorded->closed_cleanly);
        EXPECT_GE(recorded->frames.size(), kLeastFrames);
        EXPECT_LT(recorded->frames.size(), kFrames);
        for (std::size_t i = 0; i < recorded->frames.size(); ++i) {
            EXPECT_EQ(recorded->frames[i].frame.index, i);
        }
        const ProgramResult report = run_gazeloop({"report", session()});
        EXPECT_EQ(report.exit_code, 0) << report.err;
        EXPECT_THAT(report.out, HasSubstr("was not closed"));
        EXPECT_EQ(run_gazeloop({"replay", session()}).exit_code, 0);
    }

    ScratchFolder folder_;
};

TEST_F(RecordingFault, ADiskThatFillsUp) {
    on_small_disk("size=" + std::to_string(kRoom_bytes), [this] {
        const ProgramResult run = record();
        EXPECT_THAT(run.err, HasSubstr("disk is full"));
        expect_incomplete(run);
    });
}

TEST_F(RecordingFault, ADiskThatIsFullFromTheStart) {
    on_small_disk("size=8k", [this] {
        const ProgramResult run = record();
        EXPECT_EQ(run.exit_code, 3) << run.err;
        EXPECT_THAT(run.err, HasSubstr(session() + ": cannot be"));
        EXPECT_TRUE(std::filesystem::is_empty(disk()));
    });
}

TEST_F(RecordingFault, ADiskThatCannotBeWritten) {
    on_small_disk("size=1m,ro", [this] {
        const ProgramResult run = record();
        EXPECT_EQ(run.exit_code, 3) << run.err;
        EXPECT_THAT(run.err, HasSubstr("Read-only file system"));
        EXPECT_EQ(run.err.find("Vulkan:"), std::string::npos) << "refused after the set-up";
    });
}

TEST_F(RecordingFault, AFileThatMayNotGrow) {
    const int result = run_in_child([this] {
        const rlimit limit{kRoom_bytes, kRoom_bytes};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
            return 2;
        }
        expect_incomplete(record());
        return HasFailure() ? 1 : 0;
    });
    EXPECT_EQ(result, 0);
}

/// Something happens to the file while it is recorded.
class VanishingFile : public RecordingFault {
  protected:
    [[nodiscard]] ProgramResult record_and(const std::function<void()>& meanwhile) const {
        return run_gazeloop(
            {"run", "--gaze", "trace:" + trace(), "--target", "headless", "--seconds", "3", "--set",
             "render.scale=0.02", "--record", session(), "--log-level", "debug"},
            {.trigger = "gaze: left eye: tracking", .on_trigger = [&](int) { meanwhile(); }});
    }

    /// Ctrl-C, the usual end of a run, comes later.
    [[nodiscard]] ProgramResult record_and_interrupt(const std::function<void()>& meanwhile) const {
        return run_gazeloop({"run", "--gaze", "fixed:0,0", "--target", "headless", "--set",
                             "render.scale=0.02", "--record", session(), "--log-level", "debug"},
                            {.trigger = "gaze: left eye: tracking", .on_trigger = [&](int pid) {
                                 meanwhile();
                                 std::this_thread::sleep_for(std::chrono::milliseconds(500));
                                 kill(pid, SIGINT);
                             }});
    }

    void expect_told(const ProgramResult& result) const {
        EXPECT_EQ(result.exit_code, 6) << result.err;
        EXPECT_THAT(result.err, HasSubstr(session() + ": recording ended early: was moved or "
                                                      "removed"));
        EXPECT_THAT(result.err, HasSubstr("the run goes on"));
        EXPECT_THAT(result.out, HasSubstr("gaze age"));
    }
};

TEST_F(VanishingFile, IsToldOfARunThatIsInterruptedToo) {
    expect_told(record_and_interrupt([this] { std::filesystem::remove(session()); }));
}

TEST_F(VanishingFile, IsToldAtOnceWhenRemoved) {
    expect_told(record_and([this] { std::filesystem::remove(session()); }));
    EXPECT_FALSE(std::filesystem::exists(session()));
}

TEST_F(VanishingFile, IsWholeWhereItWasMovedTo) {
    const std::string moved = folder_.file("moved.gaze");
    const ProgramResult result = record_and([&] { std::filesystem::rename(session(), moved); });
    expect_told(result);
    const auto recorded = session::read_session(moved);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
    EXPECT_THAT(result.err,
                HasSubstr("info: " + std::to_string(recorded->frames.size()) + " frames"));
}

TEST_F(VanishingFile, LeavesAloneWhatReplacedIt) {
    expect_told(record_and([this] {
        std::filesystem::remove(session());
        std::ofstream(session()) << "somebody else's";
    }));
    std::ifstream file(session());
    std::string text;
    std::getline(file, text);
    EXPECT_EQ(text, "somebody else's");
}

class OtherSchema : public RecordingFault {
  protected:
    /// A session that says it has that schema version.
    void record_version(const char* version) const {
        ASSERT_EQ(run_gazeloop({"run", "--target", "headless", "--frames", "2", "--set",
                                "render.scale=0.02", "--record", session()})
                      .exit_code,
                  0);
        const std::string change = "sqlite3 '" + session() + "' \"UPDATE meta SET value = '" +
                                   version + "' WHERE name = 'schema_version'\"";
        ASSERT_EQ(std::system(change.c_str()), 0);
    }

    void expect_refused(const char* version, const char* remedy) const {
        record_version(version);
        for (const char* command : {"report", "replay"}) {
            const ProgramResult result = run_gazeloop({command, session()});
            EXPECT_EQ(result.exit_code, 3) << result.err;
            EXPECT_THAT(result.err, HasSubstr(session()));
            EXPECT_THAT(result.err, HasSubstr(std::string("has schema version ") + version));
            EXPECT_THAT(result.err, HasSubstr("this program reads"));
            EXPECT_THAT(result.err, HasSubstr(remedy));
            EXPECT_EQ(result.err.find("Vulkan:"), std::string::npos) << "refused after the set-up";
        }
    }
};

TEST_F(OtherSchema, ThatIsNewerIsRefused) { expect_refused("999", "use a newer gazeloop"); }
TEST_F(OtherSchema, ThatIsTooOldIsRefused) { expect_refused("0", "use an older gazeloop"); }

/// What can be written to is found out before the set-up, without touching anything.
class Output : public RecordingFault {
  protected:
    static void expect_refused(const std::vector<std::string>& words, const std::string& file) {
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 3) << result.err;
        EXPECT_THAT(result.err, HasSubstr(file + ": "));
        EXPECT_EQ(result.err.find("Vulkan:"), std::string::npos) << "refused after the set-up";
    }
    [[nodiscard]] static std::vector<std::string> run_with(const char* option,
                                                           const std::string& file) {
        return {"run",   "--target",          "headless", "--frames", "2",
                "--set", "render.scale=0.02", option,     file};
    }
};

TEST_F(Output, IntoNoFolderIsRefusedFirst) {
    const std::string file = folder_.file("none/out");
    for (const char* option : {"--record", "--json"}) {
        expect_refused(run_with(option, file), file);
        expect_refused(run_with(option, trace() + "/out"), trace() + "/out");
        EXPECT_FALSE(std::filesystem::exists(folder_.file("none")));
    }
}

TEST_F(Output, OntoAFolderIsRefusedFirst) {
    for (const char* option : {"--record", "--json"}) {
        expect_refused(run_with(option, disk()), disk());
    }
}

TEST_F(Output, OntoARecordingIsRefusedFirst) {
    const std::string file = folder_.write("precious", "precious");
    expect_refused(run_with("--record", file), file);
    EXPECT_EQ(std::filesystem::file_size(file), 8U);
}

TEST_F(Output, OfAReportIsRefusedFirst) {
    expect_refused({"report", session(), "--json", folder_.file("none/out")},
                   folder_.file("none/out"));
}

TEST_F(Output, IsKeptWhereTheRunFails) {
    const std::string file = folder_.write("summary", "of before");
    const ProgramResult result = run_gazeloop(
        {"run", "--target", "headless", "--set", "vulkan.device=Voodoo", "--json", file});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_EQ(std::filesystem::file_size(file), 9U);
}

TEST_F(Output, IsKeptWhereTheDiskIsFull) {
    on_small_disk("size=8k", [this] {
        const std::string file = disk() + "/summary";
        const std::string before(6000, 'x');
        std::ofstream(file) << before;
        const ProgramResult run = run_gazeloop(run_with("--json", file));
        EXPECT_EQ(run.exit_code, 3) << run.err;
        EXPECT_THAT(run.err, HasSubstr(file + ": cannot be written (No space left on device)"));
        EXPECT_EQ(std::filesystem::file_size(file), before.size());
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk()), {}), 1);
    });
}

TEST_F(Output, ReplacesFollowsLinksAndWritesToDevices) {
    const std::string file = folder_.write("summary", "of before");
    const std::string link = folder_.file("link");
    std::filesystem::create_symlink(file, link);
    std::filesystem::permissions(file, std::filesystem::perms(0640));
    EXPECT_EQ(run_gazeloop(run_with("--json", link)).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_TRUE(nlohmann::json::accept(std::ifstream(file)));
    EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0640));
    EXPECT_EQ(run_gazeloop(run_with("--json", "/dev/null")).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    const ProgramResult full = run_gazeloop(run_with("--json", "/dev/full"));
    EXPECT_EQ(full.exit_code, 3) << full.err;
}

}  // namespace
}  // namespace gazeloop::tests
