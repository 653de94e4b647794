#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {
namespace {

namespace fs = std::filesystem;

struct Node {
    std::string name;  ///< hidraw0
    std::string device;
    unsigned vendor = 0;
    unsigned product = 0;
    bool eye_tracker = false;
    bool readable = false;
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
    std::sscanf(uevent_value(uevent, "HID_ID").c_str(), "%x:%x:%x", &bus, &node.vendor,
                &node.product);
    node.eye_tracker = describes_eye_tracker(text_of(device / "report_descriptor"));
    node.readable = faccessat(AT_FDCWD, (root / "dev" / name).c_str(), R_OK, AT_EACCESS) == 0;
    return node;
}

}  // namespace

/// HID 1.11, 6.2.2: short items are a prefix (size, type, tag) and 0, 1, 2 or 4 bytes.
bool describes_eye_tracker(std::string_view descriptor) {
    constexpr unsigned kEyeAndHeadTrackers = 0x12;
    constexpr unsigned kUsagePage = 0x04;
    constexpr unsigned kUsage = 0x08;
    constexpr unsigned kCollection = 0xA0;
    constexpr unsigned kInput = 0x80;
    constexpr unsigned kOutput = 0x90;
    constexpr unsigned kFeature = 0xB0;
    constexpr unsigned kLongItem = 0xFE;
    const auto byte = [&](std::size_t i) {
        return static_cast<unsigned>(static_cast<unsigned char>(descriptor[i]));
    };
    unsigned page = 0;
    unsigned page_of_usage = 0;
    for (std::size_t at = 0; at < descriptor.size();) {
        const unsigned prefix = byte(at);
        if (prefix == kLongItem) {
            if (at + 1 >= descriptor.size()) {
                return false;
            }
            at += std::size_t{3} + byte(at + 1);
            continue;
        }
        const unsigned code = prefix & 3U;
        const std::size_t size = code == 3 ? 4 : code;
        if (at + size >= descriptor.size() && size > 0) {
            return false;
        }
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            value |= static_cast<std::uint32_t>(byte(at + 1 + i)) << (8 * i);
        }
        switch (prefix & 0xFCU) {
            case kUsagePage:
                page = value;
                break;
            case kUsage:
                page_of_usage = size == 4 ? value >> 16U : page;
                break;
            case kCollection:
                if (page_of_usage == kEyeAndHeadTrackers) {
                    return true;
                }
                page_of_usage = 0;
                break;
            case kInput:
            case kOutput:
            case kFeature:
                page_of_usage = 0;  // a main item ends the local ones
                break;
            default:
                break;
        }
        at += 1 + size;
    }
    return false;
}

Findings check_hid(const fs::path& root) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / "sys/class/hidraw", ignored)) {
        names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    Findings findings;
    std::size_t readable = 0;
    for (const std::string& name : names) {
        const Node node = look_at(root, name);
        readable += node.readable ? 1 : 0;
        if (!node.eye_tracker) {
            continue;
        }
        const std::string id = fmt::format("{:04x}:{:04x}", node.vendor, node.product);
        Finding finding{.check = "hid." + name,
                        .found = fmt::format("eye tracker '{}' ({}), /dev/{} {}", node.device, id,
                                             name, node.readable ? "readable" : "not readable"),
                        .facts = {{"node", "/dev/" + name},
                                  {"name", node.device},
                                  {"id", id},
                                  {"readable", node.readable}}};
        if (!node.readable) {
            finding.verdict = Verdict::Failure;
            // Before 73-seat-late.rules, which is what acts on uaccess.
            finding.remedy = fmt::format(
                "as root, write KERNEL==\"hidraw*\", KERNELS==\"*:{:04X}:{:04X}.*\", "
                "TAG+=\"uaccess\" into /etc/udev/rules.d/70-gazeloop.rules, run udevadm control "
                "--reload && udevadm trigger, and log in at this machine's seat",
                node.vendor, node.product);
        }
        findings.push_back(std::move(finding));
    }
    findings.insert(
        findings.begin(),
        {.check = "hid.nodes",
         .verdict = findings.empty() ? Verdict::NotApplicable : Verdict::Ok,
         .found = names.empty() ? std::string("no HID device")
                                : fmt::format("{} hidraw nodes, {} readable, {} eye trackers "
                                              "(usage page 0x12)",
                                              names.size(), readable, findings.size()),
         .facts = {
             {"nodes", names.size()}, {"readable", readable}, {"eye_trackers", findings.size()}}});
    return findings;
}

}  // namespace gazeloop::doctor
