#include "tests/vm/descriptor_cases.h"

#include <fmt/format.h>

#include <random>

#include "sim/virtual_tracker.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::tests {
namespace {

using drivers::hid::CollectionType;
using drivers::hid::DescriptorItems;

constexpr std::uint32_t kVendorPage = 0xFF00;
constexpr unsigned kPage = 0x04;
constexpr unsigned kLogicalMinimum = 0x14;
constexpr unsigned kLogicalMaximum = 0x24;
constexpr unsigned kPhysicalMinimum = 0x34;
constexpr unsigned kPhysicalMaximum = 0x44;
constexpr unsigned kExponent = 0x54;
constexpr unsigned kUnit = 0x64;
constexpr unsigned kReportSize = 0x74;
constexpr unsigned kReportId = 0x84;
constexpr unsigned kReportCount = 0x94;
constexpr unsigned kPush = 0xA4;
constexpr unsigned kPop = 0xB4;
constexpr unsigned kUsage = 0x08;
constexpr unsigned kUsageMinimum = 0x18;
constexpr unsigned kUsageMaximum = 0x28;
constexpr unsigned kDelimiter = 0xA8;

/// An application collection on a vendor's page, one byte a field.
DescriptorItems begun() {
    DescriptorItems d;
    d.item(kPage, 2, kVendorPage).open(CollectionType::Application, 0x01);
    d.logical(0, 255).item(kReportSize, 1, 8).item(kReportCount, 1, 1);
    return d;
}

std::vector<DescriptorCase> rules() {
    std::vector<DescriptorCase> cases;
    const auto add = [&](const std::string& name, DescriptorItems& d, bool linux_differs = false) {
        d.usage(0x7E).input(DescriptorItems::kVariable);  // one field there always is
        cases.push_back({name, d.close().bytes(), linux_differs});
    };
    {
        DescriptorItems d = begun();
        d.item(kLogicalMinimum, 1, 0).item(kLogicalMaximum, 1, 0xFF);
        d.usage(2).input(DescriptorItems::kVariable);
        add("a maximum of one byte above a minimum of 0 is unsigned", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kLogicalMinimum, 1, 0x80).item(kLogicalMaximum, 1, 0x7F);
        d.item(kPhysicalMinimum, 2, 0x8000).item(kPhysicalMaximum, 2, 0x7FFF);
        d.usage(2).input(DescriptorItems::kVariable);
        add("signed ranges", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kLogicalMaximum, 4, 0xFFFFFFFFU).item(kReportSize, 1, 32);
        d.usage(2).input(DescriptorItems::kVariable);
        add("32 bits, unsigned", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kLogicalMinimum, 0, 0).item(kReportSize, 1, 1).item(kLogicalMaximum, 1, 1);
        d.usage(2).input(DescriptorItems::kVariable);
        add("an item without data is 0", d);
    }
    for (const unsigned exponent : {0x0U, 0x7U, 0x8U, 0xCU, 0xFU}) {
        DescriptorItems d = begun();
        d.item(kExponent, 1, exponent).item(kUnit, 1, 0x11);
        d.usage(2).input(DescriptorItems::kVariable);
        add(fmt::format("exponent nibble {:X}", exponent), d);
    }
    {
        DescriptorItems d = begun();
        d.item(kExponent, 1, 0xFC).item(kUnit, 2, 0xE011);
        d.usage(2).input(DescriptorItems::kVariable);
        add("an exponent as a whole signed byte, a unit to a power below 0", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 8).usage(2).input(0);
        add("an array", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 6).usage(2).usage(3).input(DescriptorItems::kVariable);
        add("the last usage serves what is beyond it", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 1).usage(2).usage(3).usage(4).input(DescriptorItems::kVariable);
        add("more usages than elements", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 5).item(kUsageMinimum, 1, 0x10).item(kUsageMaximum, 1, 0x14);
        d.input(DescriptorItems::kVariable);
        d.item(kUsageMinimum, 2, 0x200).item(kUsageMaximum, 2, 0x203).usage(0x300);
        d.item(kReportCount, 1, 5).output(DescriptorItems::kVariable);
        add("ranges of usages", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 4).item(kUsageMaximum, 1, 0x23).item(kUsageMinimum, 1, 0x20);
        d.input(DescriptorItems::kVariable);
        add("a range of usages, its maximum first", d, true);  // Linux: from 0
    }
    {
        DescriptorItems d = begun();
        d.item(kReportCount, 1, 2).usage(2).item(kUsage, 4, 0xFF330044U);
        d.input(DescriptorItems::kVariable);
        d.item(kUsageMinimum, 4, 0xFF330001U).item(kUsageMaximum, 4, 0xFF330002U);
        d.input(DescriptorItems::kVariable);
        add("usages that bring their page", d);
    }
    {
        DescriptorItems d = begun();
        d.usage(2).item(kPage, 2, 0xFF44).input(DescriptorItems::kVariable);
        add("the page in force at the main item counts", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kDelimiter, 1, 1).usage(2).usage(3).item(kDelimiter, 1, 0);
        d.input(DescriptorItems::kVariable);
        add("alternatives: the first is preferred", d, true);  // Linux: each is a control
    }
    {
        DescriptorItems d = begun();
        d.item(kPush, 0, 0).item(kReportSize, 1, 16).item(kPage, 2, 0xFF55).item(kUnit, 1, 0x11);
        d.usage(2).input(DescriptorItems::kVariable).item(kPop, 0, 0);
        d.usage(3).input(DescriptorItems::kVariable);
        add("push and pop", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportSize, 1, 3).usage(2).input(DescriptorItems::kVariable);
        d.item(kReportSize, 1, 5).input(DescriptorItems::kConstant);
        d.item(kReportSize, 1, 12).usage(3).input(DescriptorItems::kVariable);
        add("padding moves what follows", d);
    }
    {
        DescriptorItems d = begun();
        for (const unsigned id : {7U, 3U, 7U, 255U}) {
            d.item(kReportId, 1, id).usage(2).input(DescriptorItems::kVariable);
            d.usage(3).feature(DescriptorItems::kVariable | DescriptorItems::kConstant);
        }
        add("reports that are taken up again", d);
    }
    {
        DescriptorItems d = begun();
        d.usage(2).item(0x80, 2, 0x0142);
        add("flags of two bytes", d);
    }
    {
        DescriptorItems d = begun();
        d.item(kReportSize, 1, 64).item(kReportCount, 2, 300).usage(2);
        d.feature(DescriptorItems::kVariable);
        add("a long report", d);
    }
    return cases;
}

/// Draws items in an order in which Linux and the standard agree: a range's minimum before its
/// maximum, the maximum not below it.
class Drawn {
  public:
    explicit Drawn(unsigned seed) : random_(seed) {}

    std::vector<std::uint8_t> descriptor() {
        d_.item(kPage, 2, kVendorPage + up_to(3)).open(CollectionType::Application, 1 + up_to(9));
        d_.logical(0, 255);
        const unsigned fields = 1 + up_to(24);
        for (unsigned i = 0; i < fields; ++i) {
            turn();
        }
        while (open_ > 0) {
            close();
        }
        while (pushed_ > 0) {
            pop();
        }
        field();
        return d_.close().bytes();
    }

  private:
    static constexpr unsigned kDeepestOfLinux = 4;

    unsigned up_to(unsigned most) {
        return std::uniform_int_distribution<unsigned>(0, most)(random_);
    }
    bool rarely() { return up_to(5) == 0; }

    void pop() {
        d_.item(kPop, 0, 0);
        --pushed_;
    }
    void close() {
        d_.close();
        --open_;
    }

    void turn() {
        if (rarely()) {
            d_.item(kReportId, 1, 1 + up_to(254));
        }
        if (rarely()) {
            d_.open(up_to(1) == 0 ? CollectionType::Physical : CollectionType::Logical, up_to(99));
            ++open_;
        }
        if (pushed_ < kDeepestOfLinux && rarely()) {
            d_.item(kPush, 0, 0);
            ++pushed_;
        }
        if (rarely()) {
            d_.item(kPage, 2, kVendorPage + up_to(99));
        }
        if (rarely()) {
            d_.item(kUnit, 4, up_to(0xFFFFFFFFU)).item(kExponent, 1, up_to(15));
        }
        field();
        if (open_ > 0 && rarely()) {
            close();
        }
        if (pushed_ > 0 && rarely()) {
            pop();
        }
    }

    void range(unsigned minimum_item, unsigned maximum_item) {
        const auto greatest = static_cast<std::int32_t>(up_to(0x7FFFFFFFU) >> up_to(30));
        const std::int32_t least = up_to(1) == 0 ? -greatest - 1 : greatest / 2;
        d_.item(minimum_item, 4, static_cast<std::uint32_t>(least));
        d_.item(maximum_item, 4, static_cast<std::uint32_t>(greatest));
    }

    void usages() {
        const unsigned kind = up_to(9);
        if (kind == 0) {
            return;  // padding
        }
        if (kind <= 2) {
            const unsigned first = up_to(0xFF00);
            d_.item(kUsageMinimum, 2, first).item(kUsageMaximum, 2, first + up_to(20));
            return;
        }
        const unsigned count = 1 + up_to(4);
        for (unsigned i = 0; i < count; ++i) {
            if (kind == 3) {
                d_.item(kUsage, 4, ((kVendorPage + up_to(99)) << 16U) | up_to(0xFFFF));
            } else {
                d_.item(kUsage, 2, up_to(0xFFFF));
            }
        }
    }

    void field() {
        if (up_to(1) == 0) {
            range(kLogicalMinimum, kLogicalMaximum);
        }
        if (rarely()) {
            range(kPhysicalMinimum, kPhysicalMaximum);
        }
        d_.item(kReportSize, 1, 1 + up_to(63)).item(kReportCount, 1, 1 + up_to(15));
        usages();
        const unsigned flags = up_to(0x1FF);
        switch (up_to(2)) {
            case 0:
                d_.item(0x80, 2, flags);
                break;
            case 1:
                d_.item(0x90, 2, flags);
                break;
            default:
                d_.item(0xB0, 2, flags);
                break;
        }
    }

    std::mt19937 random_;
    DescriptorItems d_;
    unsigned open_ = 0;
    unsigned pushed_ = 0;
};

}  // namespace

std::vector<DescriptorCase> descriptor_cases(int made_up) {
    const auto ours = sim::virtual_tracker_descriptor();
    std::vector<DescriptorCase> cases{
        {"the first published layout", drivers::hid::first_layout()},
        {"the second published layout", drivers::hid::second_layout()},
        {"the second without eyes", drivers::hid::second_layout(false)},
        {"the virtual tracker's", {ours.begin(), ours.end()}}};
    const std::vector<DescriptorCase> more = rules();
    cases.insert(cases.end(), more.begin(), more.end());
    for (int i = 0; i < made_up; ++i) {
        cases.push_back({fmt::format("drawn {}", i), Drawn(static_cast<unsigned>(i)).descriptor()});
    }
    return cases;
}

}  // namespace gazeloop::tests
