#include <fmt/core.h>
#include <fmt/ranges.h>
#include <pwd.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>

#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {
namespace {

namespace fs = std::filesystem;

std::string user_name() {
    const passwd* const user = getpwuid(geteuid());
    return user != nullptr ? user->pw_name : fmt::format("#{}", geteuid());
}

Finding check_real_time() {
    // Asked for once and given back at once; nothing else tells what limits and cgroups allow.
    rlimit limit{};
    getrlimit(RLIMIT_RTPRIO, &limit);
    sched_param before{};
    const int policy = sched_getscheduler(0);
    sched_getparam(0, &before);
    sched_param lowest{};
    lowest.sched_priority = sched_get_priority_min(SCHED_FIFO);
    const int refusal = sched_setscheduler(0, SCHED_FIFO, &lowest) == 0 ? 0 : errno;
    if (refusal == 0) {
        sched_setscheduler(0, policy, &before);
    }
    Finding finding{.check = "scheduling.real_time",
                    .facts = {{"allowed", refusal == 0}, {"rlimit_rtprio", limit.rlim_cur}}};
    if (refusal == 0) {
        finding.found =
            "real-time priority (SCHED_FIFO) is allowed; it is used by `chrt -f 20 gazeloop "
            "...`";
        return finding;
    }
    finding.verdict = Verdict::Warning;
    finding.found = fmt::format(
        "no real-time priority ({}; RLIMIT_RTPRIO is {}): other programs "
        "can delay the gaze",
        std::strerror(refusal), limit.rlim_cur);
    finding.remedy =
        limit.rlim_cur > 0 || geteuid() == 0
            ? "the limit allows it but the container or control group does not: run outside it, or "
              "give the container SYS_NICE (docker run --cap-add SYS_NICE); then start it by `chrt "
              "-f "
              "20 gazeloop ...`"
            : fmt::format(
                  "as root, write '{} - rtprio 20' into "
                  "/etc/security/limits.d/gazeloop.conf, log in again, and start it by `chrt -f 20 "
                  "gazeloop ...`",
                  user_name());
    return finding;
}

Finding check_governor(const fs::path& root) {
    std::map<std::string, int> governors;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / "sys/devices/system/cpu", ignored)) {
        std::string governor;
        if (std::ifstream(entry.path() / "cpufreq/scaling_governor") >> governor) {
            ++governors[governor];
        }
    }
    Finding finding{.check = "scheduling.governor", .facts = {{"governors", governors}}};
    if (governors.empty()) {
        finding.verdict = Verdict::NotApplicable;
        finding.found = "the processors' frequency is not governed here";
        return finding;
    }
    for (const auto& [name, count] : governors) {
        finding.found +=
            fmt::format("{}{} on {} processors", finding.found.empty() ? "" : ", ", name, count);
    }
    if (governors.size() > 1 || !governors.contains("performance")) {
        finding.verdict = Verdict::Warning;
        finding.found += ": clocks rise only after the work has begun";
        finding.remedy =
            "as root, run: echo performance | tee "
            "/sys/devices/system/cpu/cpu*/cpufreq/scaling_governor";
    }
    return finding;
}

}  // namespace

Findings check_scheduling(const fs::path& root) {
    return {check_real_time(), check_governor(root)};
}

}  // namespace gazeloop::doctor
