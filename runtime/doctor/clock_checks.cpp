#include <fmt/core.h>
#include <ctime>

#include <algorithm>
#include <fstream>
#include <limits>

#include "runtime/doctor/checks.h"
#include "runtime/time/clock.h"

namespace gazeloop::doctor {
namespace {

Finding check_resolution() {
    timespec resolution{};
    clock_getres(CLOCK_MONOTONIC, &resolution);
    const std::int64_t step_ns =
        std::int64_t{resolution.tv_sec} * 1'000'000'000 + resolution.tv_nsec;
    // The time between two reads is what a stamp cannot be better than.
    constexpr int kReads = 2000;
    std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max();
    std::int64_t longest_ns = 0;
    const std::int64_t start_ns = time::monotonic_ns();
    std::int64_t before_ns = start_ns;
    for (int i = 0; i < kReads; ++i) {
        const std::int64_t now_ns = time::monotonic_ns();
        shortest_ns = std::min(shortest_ns, now_ns - before_ns);
        longest_ns = std::max(longest_ns, now_ns - before_ns);
        before_ns = now_ns;
    }
    const double read_ns = static_cast<double>(before_ns - start_ns) / kReads;
    constexpr std::int64_t kCoarseNs = 1000;
    constexpr double kSlowNs = 1000.0;
    const bool good = step_ns <= kCoarseNs && read_ns <= kSlowNs && shortest_ns >= 0;
    return {
        .check = "clock.monotonic",
        .verdict = good ? Verdict::Ok : Verdict::Warning,
        .found = fmt::format("CLOCK_MONOTONIC: resolution {} ns, a read takes {:.0f} ns, longest "
                             "gap between two of {} reads {:.1f} us",
                             step_ns, read_ns, kReads, static_cast<double>(longest_ns) * 1e-3),
        .remedy = good ? ""
                       : "boot with the kernel parameter clocksource=tsc, if the "
                         "processor's time stamp counter is stable",
        .facts = {
            {"resolution_ns", step_ns}, {"read_ns", read_ns}, {"longest_gap_ns", longest_ns}}};
}

Finding check_source(const std::filesystem::path& root) {
    std::string source;
    std::ifstream(root / "sys/devices/system/clocksource/clocksource0/current_clocksource") >>
        source;
    Finding finding{.check = "clock.source", .facts = {{"clocksource", source}}};
    if (source.empty()) {
        finding.verdict = Verdict::NotApplicable;
        finding.found = "the kernel does not say what it reads the time from";
        return finding;
    }
    finding.found = fmt::format("clocksource {}", source);
    // Read over a bus, in microseconds, under a lock.
    if (source == "hpet" || source == "acpi_pm" || source == "jiffies" || source == "pit") {
        finding.verdict = Verdict::Warning;
        finding.found += ": slow to read";
        finding.remedy =
            "boot with the kernel parameter tsc=reliable, after dmesg | grep -i tsc has shown that "
            "only the watchdog rejected the counter";
    }
    return finding;
}

}  // namespace

Findings check_clocks(const std::filesystem::path& root) {
    return {check_resolution(), check_source(root)};
}

}  // namespace gazeloop::doctor
