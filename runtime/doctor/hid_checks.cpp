#include <fmt/core.h>

#include "drivers/device/udev.h"
#include "drivers/hid/find_trackers.h"
#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {
namespace {

Finding found(const drivers::hid::FoundTracker& tracker) {
    const drivers::FoundDevice& device = tracker.device;
    Finding finding{.check = "hid." + device.path.substr(device.path.rfind('/') + 1),
                    .found = fmt::format("eye tracker {}, may be opened", device.text()),
                    .facts = {{"node", device.path},
                              {"name", device.name},
                              {"id", fmt::format("{:04x}:{:04x}", device.vendor, device.product)},
                              {"usable", !device.access_problem && tracker.layout}}};
    if (!tracker.layout) {
        finding.verdict = Verdict::Failure;
        finding.found =
            fmt::format("eye tracker {}: {}", device.text(), tracker.layout.error().message);
        finding.remedy = "look for newer firmware at its maker's";
    } else if (device.access_problem) {
        finding.verdict = Verdict::Failure;
        finding.found = fmt::format("eye tracker {}: {}", device.text(), *device.access_problem);
        finding.remedy = device.missing_rule.empty()
                             ? std::string("plug it in again")
                             : fmt::format("{} {}", drivers::kRuleRemedy, device.missing_rule);
    }
    return finding;
}

}  // namespace

Findings check_hid() {
    const std::size_t nodes = drivers::kernel_devices("hidraw", "hid").size();
    Findings findings;
    std::size_t usable = 0;
    for (const drivers::hid::FoundTracker& tracker : drivers::hid::find_trackers()) {
        findings.push_back(found(tracker));
        usable += findings.back().verdict == Verdict::Ok ? 1 : 0;
    }
    findings.insert(
        findings.begin(),
        {.check = "hid.nodes",
         .verdict = findings.empty() ? Verdict::NotApplicable : Verdict::Ok,
         .found = nodes == 0 ? std::string("no HID device")
                             : fmt::format("{} hidraw nodes, {} eye trackers (usage page 0x12), {} "
                                           "of them usable",
                                           nodes, findings.size(), usable),
         .facts = {{"nodes", nodes}, {"usable", usable}, {"eye_trackers", findings.size()}}});
    return findings;
}

}  // namespace gazeloop::doctor
