#include "tests/vm/kernel_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>

namespace gazeloop::tests {
namespace {

using drivers::hid::ReportDescriptor;
using drivers::hid::ReportField;
using drivers::hid::ReportKind;

constexpr std::array<const char*, 3> kKinds{"INPUT", "OUTPUT", "FEATURE"};

std::string trimmed(const std::string& line) {
    const auto begin = line.find_first_not_of(" \t");
    const auto end = line.find_last_not_of(" \t");
    return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
}

/// The unit's nibbles in the kernel's words (HID 1.11, 6.2.2.7).
std::string unit_text(std::uint32_t unit) {
    constexpr std::uint32_t kNibbles = 8;
    constexpr std::array<const char*, 5> kSystems{"None", "SI Linear", "SI Rotation",
                                                  "English Linear", "English Rotation"};
    using Names = std::array<const char*, kNibbles>;
    constexpr std::array<Names, 5> kUnits{
        Names{"None", "None", "None", "None", "None", "None", "None", "None"},
        Names{"None", "Centimeter", "Gram", "Seconds", "Kelvin", "Ampere", "Candela", "None"},
        Names{"None", "Radians", "Gram", "Seconds", "Kelvin", "Ampere", "Candela", "None"},
        Names{"None", "Inch", "Slug", "Seconds", "Fahrenheit", "Ampere", "Candela", "None"},
        Names{"None", "Degrees", "Slug", "Seconds", "Fahrenheit", "Ampere", "Candela", "None"}};
    const std::uint32_t system = unit & 0xFU;
    if (system >= kSystems.size()) {
        return "Unit(Invalid)";
    }
    std::string text = fmt::format("Unit({} : ", kSystems[system]);
    bool first = true;
    for (std::uint32_t i = 1; i < kNibbles; ++i) {
        const std::uint32_t nibble = (unit >> (4U * i)) & 0xFU;
        if (nibble == 0) {
            continue;
        }
        text += fmt::format("{}{}", first ? "" : "*", kUnits[system][i]);
        first = false;
        if (nibble != 1) {
            text += fmt::format(
                "^{}", nibble < 8 ? static_cast<int>(nibble) : static_cast<int>(nibble) - 16);
        }
    }
    return text + ")";
}

std::string text_of(const ReportField& field) {
    const std::string id = field.report_id != 0 ? fmt::format("({})", field.report_id) : "";
    const char* const kind = kKinds[static_cast<std::size_t>(field.kind)];
    std::string text = fmt::format("{}{}[{}]", kind, id, kind);
    const auto add = [&](const std::string& line) { text += "; " + line; };
    const auto add_range = [&](const char* name, std::int64_t minimum, std::int64_t maximum) {
        const auto least = static_cast<std::int32_t>(minimum);
        const auto greatest = static_cast<std::int32_t>(maximum);
        if (least != greatest) {
            add(fmt::format("{} Minimum({})", name, least));
            add(fmt::format("{} Maximum({})", name, greatest));
        }
    };
    std::uint32_t declared = 0;
    for (const auto& range : field.usages) {
        declared += range.last - range.first + 1;
    }
    const std::uint32_t usages = std::max(declared, field.count);
    add(fmt::format("Usage({})", usages));
    for (std::uint32_t i = 0; i < usages; ++i) {
        const drivers::hid::Usage usage = field.usage_of(i);
        add(fmt::format("{:04x}.{:04x}", usage >> 16U, usage & 0xFFFFU));
    }
    add_range("Logical", field.logical_minimum, field.logical_maximum);
    add_range("Physical", field.physical_minimum, field.physical_maximum);
    if (field.unit_exponent != 0) {
        add(fmt::format("Unit Exponent({})", field.unit_exponent));
    }
    if (field.unit != 0) {
        add(unit_text(field.unit));
    }
    add(fmt::format("Report Size({})", field.bits));
    add(fmt::format("Report Count({})", field.count));
    add(fmt::format("Report Offset({})", field.bit_offset));
    std::string flags;
    for (const auto& [mask, set, clear] : {std::tuple{0x001U, "Constant ", ""},
                                           {0x002U, "Variable ", "Array "},
                                           {0x004U, "Relative ", "Absolute "},
                                           {0x008U, "Wrap ", ""},
                                           {0x010U, "NonLinear ", ""},
                                           {0x020U, "NoPreferredState ", ""},
                                           {0x040U, "NullState ", ""},
                                           {0x080U, "Volatile ", ""},
                                           {0x100U, "BufferedByte ", ""}}) {
        flags += (field.flags & mask) != 0 ? set : clear;
    }
    add(fmt::format("Flags( {})", flags));
    return text;
}

}  // namespace

std::vector<FieldText> fields_of_kernel(const std::string& rdesc) {
    std::vector<FieldText> fields;
    std::istringstream lines(rdesc);
    std::string report;
    bool in_field = false;
    for (std::string line; std::getline(lines, line);) {
        line = trimmed(line);
        if (line.ends_with("INPUT]") || line.ends_with("OUTPUT]") || line.ends_with("FEATURE]")) {
            report = line;
            in_field = false;
        } else if (!report.empty() && line.starts_with("Field(")) {
            fields.push_back(report);
            in_field = true;
        } else if (line.empty() || line.find("--->") != std::string::npos) {
            in_field = false;  // the list of mapped keys and axes follows
        } else if (in_field && !line.starts_with("Physical(") && !line.starts_with("Logical(") &&
                   !line.starts_with("Application(")) {
            fields.back() += "; " + line;
        }
    }
    return fields;
}

std::vector<FieldText> fields_of(const ReportDescriptor& descriptor) {
    // The kernel lists reports by kind, then in the order in which they were first mentioned.
    std::vector<FieldText> fields;
    for (const ReportKind kind : {ReportKind::Input, ReportKind::Output, ReportKind::Feature}) {
        for (const auto& report : descriptor.reports) {
            for (const ReportField& field : descriptor.fields) {
                if (report.kind == kind && field.kind == kind && field.report_id == report.id &&
                    !field.usages.empty()) {
                    fields.push_back(text_of(field));
                }
            }
        }
    }
    return fields;
}

}  // namespace gazeloop::tests
