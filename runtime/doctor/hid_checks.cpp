#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "drivers/device/udev.h"
#include "drivers/hid/find_trackers.h"
#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {
namespace {

/// Of one that was not, or could not be, listened to.
Finding failure(Finding finding, std::string problem, std::string remedy) {
    finding.verdict = Verdict::Failure;
    finding.found += ": " + std::move(problem);
    finding.remedy = std::move(remedy);
    return finding;
}

std::string report_names(const std::vector<std::uint8_t>& ids) {
    std::string names;
    for (const std::uint8_t id : ids) {
        names += fmt::format("{}{:#04x}", names.empty() ? "" : ", ", id);
    }
    return names;
}

Finding found(const drivers::hid::FoundTracker& tracker, const drivers::TrackerProbe& probe) {
    const drivers::FoundDevice& device = tracker.device;
    Finding finding{.check = "hid." + device.path.substr(device.path.rfind('/') + 1),
                    .found = fmt::format("eye tracker {}", device.text()),
                    .facts = {{"node", device.path},
                              {"name", device.name},
                              {"id", fmt::format("{:04x}:{:04x}", device.vendor, device.product)},
                              {"usable", !device.access_problem && tracker.layout},
                              {"seconds", probe.seconds},
                              {"reports", probe.counts.reports},
                              {"samples", probe.counts.samples},
                              {"samples_with_gaze", probe.with_gaze},
                              {"unanswered_feature_reports", probe.facts.unanswered_reports}}};
    if (!tracker.layout) {
        return failure(std::move(finding), tracker.layout.error().message,
                       "look for newer firmware at its maker's");
    }
    if (device.access_problem) {
        return failure(std::move(finding), *device.access_problem,
                       device.missing_rule.empty()
                           ? std::string("plug it in again")
                           : fmt::format("{} {}", drivers::kRuleRemedy, device.missing_rule));
    }
    if (probe.problem) {
        return failure(std::move(finding), *probe.problem, "plug it in again");
    }
    if (probe.silence) {
        finding.verdict = Verdict::Warning;
        finding.found += ": " + *probe.silence;
        finding.remedy =
            "switch it on, wear it, calibrate it with its maker's tool; if dmesg names reports "
            "that "
            "are too short, look for newer firmware at its maker's";
    } else {
        finding.found += fmt::format(": {} samples in {:.1f} s, {} of them with gaze",
                                     probe.counts.samples, probe.seconds, probe.with_gaze);
        if (probe.with_gaze == 0 && probe.facts.missing) {
            finding.verdict = Verdict::Warning;
            finding.remedy = *probe.facts.missing;
        }
    }
    if (const auto& ids = probe.facts.unanswered_reports; !ids.empty()) {
        finding.verdict = Verdict::Warning;
        finding.found += "; no answer for feature reports " + report_names(ids);
        finding.remedy += finding.remedy.empty() ? "" : "; ";
        finding.remedy +=
            "set what it does not state of its screen (hid.screen_width_m, hid.screen_height_m)";
    }
    return finding;
}

}  // namespace

Findings check_hid(const HidChecks& asked) {
    const std::size_t nodes = drivers::kernel_devices("hidraw", "hid").size();
    const std::vector<drivers::hid::FoundTracker> trackers = drivers::hid::find_trackers();
    const std::vector<drivers::TrackerProbe> probes =
        drivers::hid::probe_trackers(trackers, asked.options, asked.listen, asked.stop);
    Findings findings;
    std::size_t usable = 0;
    for (std::size_t i = 0; i < trackers.size(); ++i) {
        findings.push_back(found(trackers[i], probes[i]));
        usable += findings.back().facts["usable"].get<bool>() ? 1 : 0;
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
