#include "runtime/doctor/probe.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace gazeloop::doctor {
namespace {

using namespace std::chrono_literals;

ProbeResult run(const std::function<void(ProbeReport&)>& probe,
                std::chrono::milliseconds patience = 60s) {
    return run_probe(probe, {.patience = patience, .stop = [] { return false; }});
}

TEST(Probe, HandsItsFindingsOver) {
    const ProbeResult result = run([](ProbeReport& report) {
        report.step("counting");
        report.add({.check = "a.b",
                    .verdict = Verdict::Warning,
                    .found = "one \"two\"\nthree",
                    .remedy = "do",
                    .facts = {{"n", 3}},
                    .stops_loop = true});
        std::puts("noise");
    });
    EXPECT_EQ(result.broken, "");
    EXPECT_EQ(result.step, "counting");
    ASSERT_EQ(result.findings.size(), 1U);
    EXPECT_EQ(result.findings[0].check, "a.b");
    EXPECT_EQ(result.findings[0].verdict, Verdict::Warning);
    EXPECT_EQ(result.findings[0].found, "one \"two\"\nthree");
    EXPECT_EQ(result.findings[0].facts["n"], 3);
    EXPECT_TRUE(result.findings[0].stops_loop);
}

TEST(Probe, SaysDuringWhatItCrashed) {
    ProbeResult result = run([](ProbeReport& report) {
        report.add({.check = "kept"});
        report.step("loading the driver");
        std::fputs("first\nlast words\n", stderr);
        std::fflush(stderr);
        raise(SIGABRT);
    });
    EXPECT_EQ(result.broken, "crashed (SIGABRT); its last words: last words");
    const auto findings = std::move(result).findings_and_end("driver", "remedy", true);
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].check, "kept");
    EXPECT_EQ(findings[1].check, "driver");
    EXPECT_EQ(findings[1].verdict, Verdict::Failure);
    EXPECT_EQ(findings[1].found,
              "loading the driver: crashed (SIGABRT); its last words: last words");
    EXPECT_TRUE(findings[1].stops_loop);
}

TEST(Probe, EndsWhatHangs) {
    const ProbeResult result = run(
        [](ProbeReport& report) {
            report.step("waiting");
            for (;;) {
                pause();
            }
        },
        200ms);
    EXPECT_NE(result.broken.find("hung"), std::string::npos) << result.broken;
    EXPECT_EQ(result.step, "waiting");
}

TEST(Probe, EndsWhenAskedTo) {
    const ProbeResult result =
        run_probe([](ProbeReport&) { pause(); }, {.patience = 60s, .stop = [] { return true; }});
    EXPECT_EQ(result.broken, "interrupted");
}

TEST(Probe, ReportsErrorsAndExits) {
    EXPECT_EQ(run([](ProbeReport&) { throw std::runtime_error("no device"); }).broken, "no device");
    EXPECT_EQ(run([](ProbeReport&) { _exit(3); }).broken, "ended itself (exit code 3)");
}

TEST(Probe, IsNotHeldUpByWhatItLeavesBehind) {
    const ProbeResult result = run([](ProbeReport& report) {
        report.step("starting a service");
        if (fork() == 0) {
            sleep(2);  // holds the pipes
            _exit(0);
        }
        _exit(9);
    });
    EXPECT_EQ(result.broken, "ended itself (exit code 9)");
}

TEST(Probe, TakesMuchOutputAndBytesThatAreNoText) {
    const ProbeResult result = run([](ProbeReport& report) {
        for (int i = 0; i < 100'000; ++i) {
            std::puts("a line of noise, again and again");
        }
        report.add({.check = "name", .found = "\xff\xfe device"});
    });
    EXPECT_EQ(result.broken, "");
    ASSERT_EQ(result.findings.size(), 1U);
}

}  // namespace
}  // namespace gazeloop::doctor
