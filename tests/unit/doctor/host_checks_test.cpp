#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "runtime/doctor/checks.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::doctor {
namespace {

const Finding& named(const Findings& findings, const std::string& check) {
    static const Finding none{.check = "none"};
    for (const Finding& finding : findings) {
        if (finding.check == check) {
            return finding;
        }
    }
    ADD_FAILURE() << "no finding " << check;
    return none;
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

TEST(CheckClocks, KnowsSlowSources) {
    const tests::TemporaryFolder root;
    EXPECT_EQ(named(check_clocks(root.path()), "clock.source").verdict, Verdict::NotApplicable);
    const auto file = root / "sys/devices/system/clocksource/clocksource0/current_clocksource";
    write(file, "tsc\n");
    EXPECT_EQ(named(check_clocks(root.path()), "clock.source").verdict, Verdict::Ok);
    write(file, "hpet\n");
    const Findings slow = check_clocks(root.path());
    EXPECT_EQ(named(slow, "clock.source").verdict, Verdict::Warning);
    EXPECT_FALSE(named(slow, "clock.source").remedy.empty());
    EXPECT_GT(named(slow, "clock.monotonic").facts["read_ns"], 0.0);
}

TEST(CheckScheduling, CountsGovernors) {
    const tests::TemporaryFolder root;
    EXPECT_EQ(named(check_scheduling(root.path()), "scheduling.governor").verdict,
              Verdict::NotApplicable);
    write(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
    EXPECT_EQ(named(check_scheduling(root.path()), "scheduling.governor").verdict, Verdict::Ok);
    write(root / "sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave\n");
    const Findings mixed = check_scheduling(root.path());
    EXPECT_EQ(named(mixed, "scheduling.governor").verdict, Verdict::Warning);
    EXPECT_EQ(named(mixed, "scheduling.governor").facts["governors"]["powersave"], 1);
}

TEST(CheckScheduling, LeavesThePriorityAsItWas) {
    const int policy = sched_getscheduler(0);
    const Findings findings = check_scheduling("/");
    EXPECT_EQ(sched_getscheduler(0), policy);
    const Finding& priority = named(findings, "scheduling.real_time");
    EXPECT_EQ(priority.facts["allowed"], priority.verdict == Verdict::Ok);
    EXPECT_EQ(priority.remedy.empty(), priority.verdict == Verdict::Ok);
}

TEST(CheckRecordingFolder, MeasuresAndLeavesNothingBehind) {
    const tests::TemporaryFolder folder;
    const Findings findings = check_recording_folder(folder.path());
    EXPECT_NE(named(findings, "recording.write").verdict, Verdict::Failure);
    EXPECT_GT(named(findings, "recording.write").facts["write_mb_per_s"], 0.0);
    EXPECT_GT(named(findings, "recording.space").facts["free_mb"], 0.0);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CheckRecordingFolder, SaysWhyNothingCanBeWritten) {
    for (const char* folder : {"/nowhere/at/all", "/proc", "/dev/null"}) {
        const Findings findings = check_recording_folder(folder);
        EXPECT_EQ(named(findings, "recording.write").verdict, Verdict::Failure) << folder;
        EXPECT_FALSE(named(findings, "recording.write").remedy.empty()) << folder;
        EXPECT_FALSE(named(findings, "recording.write").stops_loop) << folder;
    }
}

// As a disk that is full: the file cannot grow.
TEST(CheckRecordingFolder, NoticesWhenTheRoomRunsOut) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit little{10'000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
    const tests::TemporaryFolder folder;
    const Findings findings = check_recording_folder(folder.path());
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(named(findings, "recording.write").verdict, Verdict::Failure);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Findings, DecideWhetherTheLoopCanRun) {
    Findings findings{{.check = "a.ok"},
                      {.check = "a.warned", .verdict = Verdict::Warning, .remedy = "do this"},
                      {.check = "a.failed", .verdict = Verdict::Failure}};
    EXPECT_TRUE(loop_can_run(findings));
    EXPECT_TRUE(
        findings_text(findings).starts_with("the loop can run; ok 1, warnings 1, failures 1"));
    EXPECT_NE(findings_text(findings).find("-> do this"), std::string::npos);
    findings.push_back({.check = "b.bad", .verdict = Verdict::Failure, .stops_loop = true});
    EXPECT_FALSE(loop_can_run(findings));
    EXPECT_TRUE(findings_text(findings).starts_with("THE LOOP CANNOT RUN: b.bad;"));
    const nlohmann::json json = findings_json(findings);
    EXPECT_EQ(json["loop_can_run"], false);
    EXPECT_EQ(json["counts"]["failure"], 2);
    EXPECT_EQ(json["checks"][1]["verdict"], "warning");
}

}  // namespace
}  // namespace gazeloop::doctor
