#include "runtime/run/monitor_output.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "runtime/frame/event.h"
#include "runtime/run/line_writer.h"
#include "runtime/run/monitor_feed.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::run {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kMs;
using testing::HasSubstr;

/// A pipe whose ends are closed by themselves.
class Pipe {
  public:
    Pipe() {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
            throw std::runtime_error("no pipe");
        }
        std::signal(SIGPIPE, SIG_IGN);  // as the program does
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_reader();
        close_writer();
    }
    [[nodiscard]] int reader() const { return ends_[0]; }
    [[nodiscard]] int writer() const { return ends_[1]; }
    void close_reader() { close_end(ends_[0]); }
    void close_writer() { close_end(ends_[1]); }

    /// Everything that is in it, once the writing end is closed.
    [[nodiscard]] std::string rest() {
        close_writer();
        std::string text;
        std::array<char, 4096> bytes{};
        for (ssize_t size = 0; (size = read(reader(), bytes.data(), bytes.size())) > 0;) {
            text.append(bytes.data(), static_cast<std::size_t>(size));
        }
        return text;
    }

  private:
    static void close_end(int& end) {
        if (end >= 0) {
            close(end);
            end = -1;
        }
    }
    std::array<int, 2> ends_{-1, -1};
};

std::vector<nlohmann::json> lines_of(const std::string& text) {
    std::vector<nlohmann::json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(nlohmann::json::parse(line));
    }
    return lines;
}

TEST(LineWriter, RefusesWhatCannotBeWritten) {
    Pipe pipe;
    EXPECT_EQ(LineWriter::refusal(pipe.writer()), "");
    EXPECT_THAT(LineWriter::refusal(pipe.reader()), HasSubstr("is not open for writing"));
    const int closed = pipe.writer();
    pipe.close_writer();
    EXPECT_THAT(LineWriter::refusal(closed), HasSubstr("is not open (Bad file descriptor)"));
    EXPECT_THAT(LineWriter::refusal(-1), HasSubstr("is not open"));
    EXPECT_THAT(LineWriter::refusal(2'000'000'000), HasSubstr("is not open"));
}

TEST(LineWriter, DropsWholeLinesWhereNobodyReads) {
    Pipe pipe;
    LineWriter writer(pipe.writer());
    const std::string line(700, 'x');
    constexpr std::uint64_t kLines = 1000;
    for (std::uint64_t i = 0; i < kLines; ++i) {
        writer.write(line);
    }
    EXPECT_GT(writer.written(), 50U);
    EXPECT_GT(writer.dropped(), 500U);
    EXPECT_EQ(writer.written() + writer.dropped(), kLines);
    EXPECT_FALSE(writer.broken());
    EXPECT_EQ(fcntl(pipe.writer(), F_GETFL) & O_NONBLOCK, 0) << "others have the pipe too";
    std::istringstream stream(pipe.rest());
    std::uint64_t whole = 0;
    for (std::string one; std::getline(stream, one); ++whole) {
        ASSERT_EQ(one, line);
    }
    EXPECT_EQ(whole, writer.written());
}

TEST(LineWriter, WritesLinesOfAnyLength) {
    Pipe pipe;
    LineWriter writer(pipe.writer());
    const std::string line(200'000, 'y');  // more than a pipe holds
    EXPECT_TRUE(writer.write(line));
    EXPECT_FALSE(writer.write("next")) << "while the first one is not through";
    std::string read_text;
    std::thread reader([&] {
        read_text = [&] {
            std::string text;
            std::array<char, 4096> bytes{};
            while (text.size() < line.size() + 1) {
                const ssize_t size = read(pipe.reader(), bytes.data(), bytes.size());
                text.append(bytes.data(), static_cast<std::size_t>(size));
            }
            return text;
        }();
    });
    writer.finish(10'000);
    reader.join();
    EXPECT_EQ(read_text, line + "\n");
    EXPECT_TRUE(writer.write("last"));
    EXPECT_EQ(pipe.rest(), "last\n");
}

TEST(LineWriter, GoesOnWithoutItsReader) {
    Pipe pipe;
    LineWriter writer(pipe.writer());
    EXPECT_TRUE(writer.write("one"));
    pipe.close_reader();
    EXPECT_FALSE(writer.write("two"));
    EXPECT_TRUE(writer.broken());
    EXPECT_EQ(writer.why_broken(), "Broken pipe");
    EXPECT_FALSE(writer.write("three"));
    EXPECT_EQ(writer.dropped(), 2U);
    EXPECT_EQ(writer.written(), 1U);
}

TEST(LineWriter, WritesToSocketsWithoutWaiting) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    LineWriter writer(ends[0]);
    for (int i = 0; i < 2000; ++i) {
        writer.write(std::string(1000, 'z'));
    }
    EXPECT_GT(writer.written(), 10U);
    EXPECT_GT(writer.dropped(), 0U);
    close(ends[1]);
    close(ends[0]);
}

/// Is told what the monitor finds.
class Listener final : public frame::FrameObserver {
  public:
    void on_event(time::Stamp, std::string_view kind, std::string_view text) override {
        told.push_back(std::string(kind) + ": " + std::string(text));
    }
    std::vector<std::string> told;
};

struct Fed {
    explicit Fed(std::optional<int> fd)
        : output({.panel = false, .json_fd = fd, .budget = budget(), .clock = "wall"}),
          feed({.display = {.period_ns = latency::kExamplePeriodNs},
                .budget = budget(),
                .window_ns = 1'000'000'000,
                .interval_ns = 500'000'000,
                .output = &output}) {
        feed.tell({&listener});
    }
    static latency::LatencyBudget budget() {
        return {.name = "test", .description = {}, .source = {}, .total_ns = 15 * kMs};
    }
    void run(std::uint64_t frames) {
        for (std::uint64_t index = 0; index < frames; ++index) {
            feed.on_frame(example_frame(index));
            feed.on_gpu(example_gpu(index));
        }
        feed.finish();
        output.close();
    }

    MonitorOutput output;
    MonitorFeed feed;
    Listener listener;
};

TEST(MonitorFeed, TellsTheOthersAndTheReader) {
    Pipe pipe;
    Fed fed(pipe.writer());
    fed.feed.on_event({1, time::StampKind::Measured}, frame::kHeadLostEvent.name, "lost");
    fed.feed.on_event({1, time::StampKind::Measured}, frame::kGazeEvent.name, "routine");
    fed.run(201);
    ASSERT_EQ(fed.listener.told.size(), 1U);
    EXPECT_THAT(
        fed.listener.told[0],
        HasSubstr("budget-broken: gaze age at display above the allowed 15.00 ms: p95 16.00"));
    const auto lines = lines_of(pipe.rest());
    // begin, head-lost, budget-broken, one each half second of two, end.
    ASSERT_EQ(lines.size(), 8U);
    EXPECT_EQ(lines[0]["what"], "begin");
    EXPECT_EQ(lines[0]["budget"]["name"], "test");
    EXPECT_EQ(lines[1]["kind"], "head-lost");
    EXPECT_EQ(lines[2]["kind"], "budget-broken");
    for (std::size_t i = 3; i < 7; ++i) {
        EXPECT_EQ(lines[i]["what"], "interval");
        EXPECT_EQ(lines[i]["frame"], 50 * (i - 2));
    }
    EXPECT_EQ(lines[7]["what"], "end");
    EXPECT_EQ(lines[7]["parts"]["gaze_age_at_display"]["run"]["above"], 201);
    EXPECT_EQ(lines[7]["lines_dropped"], 0);
}

TEST(MonitorFeed, CountsFramesWithoutAGpuPartAtTheEnd) {
    Fed fed(std::nullopt);
    for (std::uint64_t index = 0; index < 3; ++index) {
        fed.feed.on_frame(example_frame(index));
    }
    frame::FrameRecord unseen = example_frame(3);
    unseen.should_render = false;
    fed.feed.on_frame(unseen);
    EXPECT_EQ(fed.feed.finish().frames, 3U);
}

TEST(MonitorOutput, IsHeldUpByNoReader) {
    Pipe pipe;
    Fed fed(pipe.writer());
    fed.run(20'000);  // 400 lines of 3 KB; the pipe holds 64
    const auto lines = lines_of(pipe.rest());
    EXPECT_GT(lines.size(), 5U);
    EXPECT_LT(lines.size(), 100U);
}

TEST(MonitorOutput, OutlivesItsReader) {
    Pipe pipe;
    pipe.close_reader();
    Fed fed(pipe.writer());
    fed.run(500);
    EXPECT_EQ(fed.listener.told.size(), 1U);
}

}  // namespace
}  // namespace gazeloop::run
