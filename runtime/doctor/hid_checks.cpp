#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "drivers/hid/find_trackers.h"
#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {
namespace {

namespace fs = std::filesystem;

struct Node {
    std::string name;  ///< hidraw0
    std::string device;
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    bool eye_tracker = false;
    bool usable = false;
};

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The value of NAME=VALUE in a uevent file.
std::string uevent_value(const std::string& uevent, const std::string& name) {
    const std::string key = name + "=";
    for (std::size_t begin = 0; begin < uevent.size();) {
        const std::size_t end = std::min(uevent.find('\n', begin), uevent.size());
        if (uevent.compare(begin, key.size(), key) == 0) {
            return uevent.substr(begin + key.size(), end - begin - key.size());
        }
        begin = end + 1;
    }
    return "";
}

Node look_at(const fs::path& root, const std::string& name) {
    const fs::path device = root / "sys/class/hidraw" / name / "device";
    const std::string uevent = text_of(device / "uevent");
    Node node;
    node.name = name;
    node.device = uevent_value(uevent, "HID_NAME");
    // Bus, vendor, product: "0003:0000054C:00000CDE".
    unsigned bus = 0;
    unsigned vendor = 0;
    unsigned product = 0;
    std::sscanf(uevent_value(uevent, "HID_ID").c_str(), "%x:%x:%x", &bus, &vendor, &product);
    node.vendor = static_cast<std::uint16_t>(vendor);
    node.product = static_cast<std::uint16_t>(product);
    const std::string bytes = text_of(device / "report_descriptor");
    const auto descriptor = drivers::hid::parse_report_descriptor(
        std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    node.eye_tracker = descriptor && drivers::hid::describes_eye_tracker(*descriptor);
    // To be asked for gaze, a tracker is written to.
    node.usable = faccessat(AT_FDCWD, (root / "dev" / name).c_str(), R_OK | W_OK, AT_EACCESS) == 0;
    return node;
}

}  // namespace

Findings check_hid(const fs::path& root) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / "sys/class/hidraw", ignored)) {
        names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    Findings findings;
    std::size_t usable = 0;
    for (const std::string& name : names) {
        const Node node = look_at(root, name);
        usable += node.usable ? 1 : 0;
        if (!node.eye_tracker) {
            continue;
        }
        const std::string id = fmt::format("{:04x}:{:04x}", node.vendor, node.product);
        Finding finding{
            .check = "hid." + name,
            .found = fmt::format("eye tracker '{}' ({}), /dev/{} {}", node.device, id, name,
                                 node.usable ? "may be opened" : "may not be opened"),
            .facts = {{"node", "/dev/" + name},
                      {"name", node.device},
                      {"id", id},
                      {"usable", node.usable}}};
        if (!node.usable) {
            finding.verdict = Verdict::Failure;
            finding.remedy = fmt::format("{} {}", drivers::kRuleRemedy,
                                         drivers::hid::udev_rule(node.vendor, node.product));
        }
        findings.push_back(std::move(finding));
    }
    findings.insert(
        findings.begin(),
        {.check = "hid.nodes",
         .verdict = findings.empty() ? Verdict::NotApplicable : Verdict::Ok,
         .found = names.empty() ? std::string("no HID device")
                                : fmt::format("{} hidraw nodes, {} may be opened, {} eye trackers "
                                              "(usage page 0x12)",
                                              names.size(), usable, findings.size()),
         .facts = {
             {"nodes", names.size()}, {"usable", usable}, {"eye_trackers", findings.size()}}});
    return findings;
}

}  // namespace gazeloop::doctor
