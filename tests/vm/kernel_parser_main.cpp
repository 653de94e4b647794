// vm_kernel_parser COUNT: gives the kernel descriptors, as HID devices through /dev/uhid, and
// compares what it reads from them with our parser; COUNT of them are drawn. Needs debugfs.
#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "sim/uhid_device.h"
#include "tests/vm/descriptor_cases.h"
#include "tests/vm/kernel_fields.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint16_t kVendor = 0x1209;
constexpr std::uint16_t kProduct = 0xE7E8;

/// What the kernel lists for our device, once it has bound it; none if it never does.
std::optional<std::string> rdesc(sim::UhidDevice& device) {
    constexpr int kLooks = 2000;
    for (int i = 0; i < kLooks; ++i) {
        device.answer_for(std::chrono::milliseconds(5), [] { return false; });
        for (const auto& entry : std::filesystem::directory_iterator("/sys/bus/hid/devices")) {
            const std::string name = entry.path().filename();
            if (name.find(fmt::format("{:04X}:{:04X}", kVendor, kProduct)) == std::string::npos ||
                !std::filesystem::exists(entry.path() / "hidraw")) {
                continue;
            }
            std::ifstream file("/sys/kernel/debug/hid/" + name + "/rdesc");
            return std::string(std::istreambuf_iterator<char>(file), {});
        }
    }
    return std::nullopt;
}

/// Whether both say the same of it; prints where they do not.
bool agree(const DescriptorCase& the_case, std::size_t& fields) {
    auto device = value_or_throw(
        sim::UhidDevice::create({"descriptor", kVendor, kProduct}, the_case.bytes,
                                {.get_feature = [](std::uint8_t) { return std::nullopt; },
                                 .set_feature = [](std::span<const std::uint8_t>) {}}));
    const auto ours = drivers::hid::parse_report_descriptor(the_case.bytes);
    const auto text = rdesc(device);
    if (!ours || !text) {
        fmt::print("differ: {}: {}\n", the_case.name,
                   ours ? "the kernel refuses it" : "we refuse it: " + ours.error().message);
        return false;
    }
    const std::vector<FieldText> theirs = fields_of_kernel(*text);
    const std::vector<FieldText> own = fields_of(*ours);
    fields += theirs.size();
    for (std::size_t i = 0; i < std::max(own.size(), theirs.size()); ++i) {
        const FieldText none = "(none)";
        const FieldText& our_field = i < own.size() ? own[i] : none;
        const FieldText& their_field = i < theirs.size() ? theirs[i] : none;
        if (our_field != their_field) {
            fmt::print("differ: {}, field {}\n  kernel {}\n  we     {}\n", the_case.name, i,
                       their_field, our_field);
            return false;
        }
    }
    return true;
}

int kernel_parser_main(std::string_view count) {
    int made_up = 0;
    if (std::from_chars(count.data(), count.data() + count.size(), made_up).ec != std::errc()) {
        fmt::print(stderr, "usage: vm_kernel_parser COUNT\n");
        return 2;
    }
    const std::vector<DescriptorCase> cases = descriptor_cases(made_up);
    std::size_t agreed = 0;
    std::size_t fields = 0;
    for (const DescriptorCase& the_case : cases) {
        agreed += agree(the_case, fields) != the_case.linux_differs ? 1 : 0;
    }
    fmt::print("{} of {} descriptors read as expected, {} fields\n", agreed, cases.size(), fields);
    return agreed == cases.size() ? 0 : 1;
}

}  // namespace
}  // namespace gazeloop::tests

int main(int count, char** arguments) {
    try {
        return gazeloop::tests::kernel_parser_main(count == 2 ? arguments[1] : "");
    } catch (const std::exception& error) {
        fmt::print(stderr, "vm_kernel_parser: {}\n", error.what());
        return 1;
    }
}
