#include "runtime/files/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/trace/text/text_output.h"
#include "runtime/calibration/calibration_file.h"
#include "runtime/render/png_file.h"
#include "runtime/report/line_chart.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::files {
namespace {

using ::testing::HasSubstr;

calibration::CalibrationFile calibration_of_one_eye() {
    calibration::CalibrationFile file{.user = "a", .device = "b", .calibration = {}};
    file.calibration[0].emplace().reach_rad = 0.3;
    return file;
}

/// Whoever writes results, by the rule of OutputFile.
const std::vector<
    std::pair<std::string, std::function<Expected<void>(const std::filesystem::path&)>>>
    kWriters{
        {"text", [](const auto& file) { return write_text(file, "text"); }},
        {"trace",
         [](const auto& file) {
             drivers::TextOutput out(file.string());
             out.stream() << "text";
             return out.close();
         }},
        {"calibration",
         [](const auto& file) {
             return calibration::write_calibration(calibration_of_one_eye(), file);
         }},
        {"picture",
         [](const auto& file) { return render::write_png({1, 1, {{{1, 2, 3}}}}, file); }},
        {"chart", [](const auto& file) { return report::write_chart({}, file); }},
    };

TEST(OutputFile, WritesAPipeInPlace) {
    for (const auto& [name, write] : kWriters) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path pipe = folder / "pipe.png";
        ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
        const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        ASSERT_GE(reader, 0);
        const auto written = write(pipe);
        EXPECT_TRUE(written.has_value()) << name << ": " << written.error().message;
        char first = 0;
        EXPECT_EQ(read(reader, &first, 1), 1) << name;
        close(reader);
        EXPECT_TRUE(std::filesystem::is_fifo(pipe)) << name;
    }
}

TEST(OutputFile, RefusesASocketAndLeavesIt) {
    for (const auto& [name, write] : kWriters) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path path = folder / "socket.png";
        sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
        std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
        const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        const auto written = write(path);
        close(socket);
        ASSERT_FALSE(written.has_value()) << name;
        EXPECT_THAT(written.error().message, HasSubstr("it is a socket, not a file")) << name;
        EXPECT_TRUE(std::filesystem::is_socket(path)) << name;
    }
}

TEST(OutputFile, LeavesADeviceThatCannotBeWritten) {
    for (const auto& [name, write] : kWriters) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path full = folder / "full.png";
        if (mknod(full.c_str(), S_IFCHR | 0600, makedev(1, 7)) != 0 ||
            access(full.c_str(), W_OK) != 0) {
            GTEST_SKIP() << "no device node can be made here: " << std::strerror(errno);
        }
        const int opened = open(full.c_str(), O_WRONLY | O_CLOEXEC);
        if (opened < 0) {
            GTEST_SKIP() << "device nodes do not work here: " << std::strerror(errno);
        }
        close(opened);
        const auto written = write(full);
        ASSERT_FALSE(written.has_value()) << name;
        EXPECT_THAT(written.error().message, HasSubstr("No space left on device")) << name;
        EXPECT_TRUE(std::filesystem::is_character_file(full)) << name;
    }
}

TEST(OutputFile, ReplacesNoRecording) {
    constexpr std::string_view kBegin{"SQLite format 3\0gaze", 20};
    for (const auto& [name, write] : kWriters) {
        const tests::TemporaryFolder folder;
        const std::filesystem::path recording = folder / "session.png";
        std::ofstream(recording, std::ios::binary) << kBegin;
        std::ofstream(folder / "session.png-wal") << "what came last";
        std::filesystem::create_symlink(recording, folder / "link.png");
        for (const char* file : {"session.png", "link.png"}) {
            const auto written = write(folder / file);
            ASSERT_FALSE(written.has_value()) << name << file;
            EXPECT_EQ(written.error().kind, ErrorKind::BadInput);
            EXPECT_THAT(written.error().message, HasSubstr("a recording is there")) << name;
        }
        EXPECT_EQ(std::filesystem::file_size(recording), kBegin.size()) << name;
        EXPECT_FALSE(check_output(folder / "session.png-wal").has_value());
        EXPECT_TRUE(check_output(folder / "other.png-wal").has_value());
    }
}

TEST(OutputFile, RefusesAFolder) {
    for (const auto& [name, write] : kWriters) {
        const tests::TemporaryFolder folder;
        std::filesystem::create_directory(folder / "a.png");
        const auto written = write(folder / "a.png");
        ASSERT_FALSE(written.has_value()) << name;
        EXPECT_THAT(written.error().message, HasSubstr("Is a directory")) << name;
    }
}

TEST(OutputFile, OfOnePersonIsReadableByNobodyElse) {
    const tests::TemporaryFolder folder;
    ASSERT_TRUE(write_text(folder / "a", "before"));
    ASSERT_EQ(chmod((folder / "a").c_str(), 0644), 0);
    ASSERT_TRUE(write_text(folder / "a", "after", kOwnerOnly));
    EXPECT_EQ(std::filesystem::status(folder / "a").permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

}  // namespace
}  // namespace gazeloop::files
