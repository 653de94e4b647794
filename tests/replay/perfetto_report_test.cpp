// `gazeloop report --perfetto` as users run it, on a session that was recorded once.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/perfetto_trace.h"
#include "tests/support/run_program.h"

namespace gazeloop {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using tests::ProgramResult;
using tests::run_gazeloop;

class PerfettoReport : public ::testing::Test {
  protected:
    PerfettoReport() {
        std::filesystem::copy_file(
            std::filesystem::path(GAZELOOP_SOURCE_DIR) / "tests/replay/golden/sim-kfr-openxr.gaze",
            session);
    }

    tests::ScratchFolder folder;
    std::string session = folder.file("session.gaze");
    std::string file = folder.file("trace.pftrace");
};

TEST_F(PerfettoReport, WritesATraceBesideTheSummaryAndSaysWhatItLacks) {
    const ProgramResult result = run_gazeloop({"report", session, "--perfetto", file});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("frames"));
    EXPECT_THAT(result.err, HasSubstr(file + " lacks what is of unknown time: "));
    EXPECT_THAT(result.err, HasSubstr(file + " lacks samples that no frame rested on: "));
    std::ifstream stream(file, std::ios::binary);
    const auto trace =
        tests::read_perfetto(std::string{std::istreambuf_iterator<char>(stream), {}});
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_GT(trace.named("frame").size(), 0U);
}

TEST_F(PerfettoReport, WritesToStdoutTheTraceAlone) {
    const ProgramResult result =
        run_gazeloop({"report", session, "--perfetto", "-", "--perfetto-samples", "all"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("rested on")));
    const auto trace = tests::read_perfetto(result.out);
    EXPECT_THAT(trace.faults, IsEmpty());
    EXPECT_GT(trace.named("sample").size(), 0U);
}

TEST_F(PerfettoReport, RefusesWhatCannotBe) {
    EXPECT_EQ(run_gazeloop({"report", session, "--perfetto", "-", "--json", "-"}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"report", session, "--perfetto-samples", "all"}).exit_code, 2);
    const ProgramResult full = run_gazeloop({"report", session, "--perfetto", "/dev/full"});
    EXPECT_EQ(full.exit_code, 3);
    EXPECT_THAT(full.err, HasSubstr("/dev/full: cannot be written (No space left on device)"));
    EXPECT_EQ(run_gazeloop({"report", session, "--perfetto", folder.file("no/where")}).exit_code,
              3);
}

}  // namespace
}  // namespace gazeloop
