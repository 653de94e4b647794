#include "runtime/report/perfetto/perfetto_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "runtime/session/playback.h"
#include "runtime/session/session_file.h"
#include "tests/support/perfetto_trace.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report::perfetto {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using tests::PerfettoTrace;

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> golden_sessions() {
    std::vector<fs::path> sessions;
    for (const auto& entry :
         fs::directory_iterator(fs::path(GAZELOOP_SOURCE_DIR) / "tests/replay/golden")) {
        if (entry.path().extension() == ".gaze") {
            sessions.push_back(entry.path());
        }
    }
    std::ranges::sort(sessions);
    return sessions;
}

class PerfettoOfGolden : public ::testing::TestWithParam<fs::path> {};
INSTANTIATE_TEST_SUITE_P(Sessions, PerfettoOfGolden, ::testing::ValuesIn(golden_sessions()),
                         [](const auto& session) {
                             std::string name = session.param.stem();
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST_P(PerfettoOfGolden, KeepsTheRulesAndTheSessionsTimes) {
    const tests::TemporaryFolder folder;
    const fs::path copy = folder / "session.gaze";
    fs::copy_file(GetParam(), copy);
    const session::SessionFile recorded = value_or_throw(session::read_session(copy));
    const fs::path file = folder / "trace.pftrace";
    PerfettoFile perfetto(file, recorded.header, SampleDetail::All);
    const std::array<frame::FrameObserver*, 1> observers{&perfetto.observer()};
    value_or_throw(session::play(copy, observers));
    const std::vector<std::string> lacks = perfetto.finish();
    const PerfettoTrace trace = tests::read_perfetto(bytes_of(file));
    EXPECT_THAT(trace.faults, IsEmpty());

    std::size_t rendered = 0;
    const auto frames = trace.on("loop");
    for (const session::RecordedFrame& one : recorded.frames) {
        const frame::FrameStamps& stamps = one.frame.stamps;
        const bool drawn = std::ranges::any_of(frames, [&](const PerfettoTrace::Slice& slice) {
            return slice.depth == 0 && slice.begin_ns == stamps.wake_up.ns &&
                   slice.end_ns == stamps.end_frame.ns &&
                   slice.annotations.at("frame") == std::to_string(one.frame.index);
        });
        EXPECT_TRUE(drawn) << one.frame.index;
        rendered += one.frame.should_render ? 1 : 0;
    }
    EXPECT_EQ(trace.named("frame").size(), rendered);
    EXPECT_EQ(trace.named("photon").size(), rendered);
    EXPECT_EQ(trace.named("gpu").size(), rendered);
    EXPECT_EQ(trace.named("sample").size() + trace.named("sample, no eye valid").size(),
              recorded.samples.size());
    EXPECT_EQ(trace.clock.has_value(), recorded.header.meta.clock == latency::LoopClock::Wall);
    // No runtime said when it presented.
    EXPECT_THAT(lacks, ::testing::Contains(HasSubstr(fmt::format("{} of runtime", rendered))));
}

class PerfettoOnDisk : public ::testing::Test {
  protected:
    void write(const fs::path& to) {
        PerfettoFile perfetto(to, {}, SampleDetail::Used);
        for (std::uint64_t index = 1; index <= frames; ++index) {
            perfetto.observer().on_frame(latency::example_frame(index));
            perfetto.observer().on_gpu(latency::example_gpu(index));
        }
        during = fs::is_regular_file(to) ? bytes_of(to) : std::string{};
        lacks = perfetto.finish();
    }
    static std::string refusal(const std::function<void()>& action) {
        try {
            action();
        } catch (const SetupError& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            return error.what();
        }
        return "not refused";
    }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
    }

    tests::TemporaryFolder folder;
    fs::path file = folder / "trace.pftrace";
    std::uint64_t frames = 2000;  // more than one piece
    std::string during;
    std::vector<std::string> lacks;
};

TEST_F(PerfettoOnDisk, ReplacesAFileOnceItIsComplete) {
    std::ofstream(file) << "what was there";
    write(file);
    EXPECT_EQ(during, "what was there");
    EXPECT_THAT(tests::read_perfetto(bytes_of(file)).faults, IsEmpty());
    EXPECT_EQ(tests::read_perfetto(bytes_of(file)).named("frame").size(), frames);
    EXPECT_EQ(files(), 1U);
}

TEST_F(PerfettoOnDisk, LeavesWhatWasThereIfItIsNotFinished) {
    std::ofstream(file) << "what was there";
    {
        PerfettoFile perfetto(file, {}, SampleDetail::Used);
        perfetto.observer().on_frame(latency::example_frame(1));
    }
    EXPECT_EQ(bytes_of(file), "what was there");
    EXPECT_EQ(files(), 1U);
}

TEST_F(PerfettoOnDisk, NamesFileAndReasonWhereTheDiskIsFull) {
    EXPECT_THAT(refusal([this] { write("/dev/full"); }),
                HasSubstr("/dev/full: cannot be written (No space left on device)"));
    frames = 1;  // all of it in one piece, at the end
    EXPECT_THAT(refusal([this] { write("/dev/full"); }),
                HasSubstr("/dev/full: cannot be written (No space left on device)"));
}

TEST_F(PerfettoOnDisk, RefusesAFileThatCannotBeBeforeAnyWork) {
    EXPECT_THAT(refusal([this] { write(folder / "nowhere/trace"); }), HasSubstr("nowhere/trace"));
    EXPECT_THAT(refusal([this] { write(folder.path()); }), HasSubstr("Is a directory"));
    EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace gazeloop::report::perfetto
