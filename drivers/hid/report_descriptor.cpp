#include "drivers/hid/report_descriptor.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace gazeloop::drivers::hid {
namespace {

constexpr std::uint8_t kLongItem = 0xFE;
constexpr std::size_t kDeepestStack = 64;

enum class ItemType : std::uint8_t { Main = 0, Global = 1, Local = 2, Reserved = 3 };

enum class MainTag : std::uint8_t {
    Input = 0x8,
    Output = 0x9,
    Collection = 0xA,
    Feature = 0xB,
    EndCollection = 0xC,
};

enum class GlobalTag : std::uint8_t {
    UsagePage = 0x0,
    LogicalMinimum = 0x1,
    LogicalMaximum = 0x2,
    PhysicalMinimum = 0x3,
    PhysicalMaximum = 0x4,
    UnitExponent = 0x5,
    Unit = 0x6,
    ReportSize = 0x7,
    ReportId = 0x8,
    ReportCount = 0x9,
    Push = 0xA,
    Pop = 0xB,
};

enum class LocalTag : std::uint8_t {
    Usage = 0x0,
    UsageMinimum = 0x1,
    UsageMaximum = 0x2,
    Delimiter = 0xA,
};

/// An item's data: its meaning depends on items that may come later.
struct ItemData {
    std::uint32_t value = 0;
    std::uint32_t bytes = 0;  ///< 0, 1, 2 or 4

    [[nodiscard]] std::int64_t as_signed() const {
        switch (bytes) {
            case 1:
                return static_cast<std::int8_t>(value);
            case 2:
                return static_cast<std::int16_t>(value);
            default:
                return static_cast<std::int32_t>(value);
        }
    }
};

struct Range {
    ItemData minimum;
    ItemData maximum;

    [[nodiscard]] std::int64_t least() const { return minimum.as_signed(); }
    [[nodiscard]] std::int64_t greatest() const {
        return least() < 0 ? maximum.as_signed() : std::int64_t{maximum.value};
    }
};

/// Four bits in two's complement by the standard; some devices write a whole signed byte or more.
int exponent_of(const ItemData& data) {
    constexpr int kGreatest = 127;
    if (data.value <= 0xFU) {
        return data.value < 8U ? static_cast<int>(data.value) : static_cast<int>(data.value) - 16;
    }
    return static_cast<int>(std::clamp<std::int64_t>(data.as_signed(), -kGreatest - 1, kGreatest));
}

struct Globals {
    std::uint16_t usage_page = 0;
    Range logical;
    Range physical;
    int unit_exponent = 0;
    std::uint32_t unit = 0;
    std::uint32_t report_size = 0;
    std::uint32_t report_count = 0;
    std::uint8_t report_id = 0;
};

/// A usage before its page is known.
struct PendingUsage {
    ItemData first;
    ItemData last;
};

struct Locals {
    std::vector<PendingUsage> usages;
    std::optional<ItemData> minimum;
    std::optional<ItemData> maximum;
    bool in_delimiter = false;
    bool delimiter_has_usage = false;

    void clear() {
        usages.clear();
        minimum.reset();
        maximum.reset();
        in_delimiter = false;
        delimiter_has_usage = false;
    }
};

class Parser {
  public:
    explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    Expected<ReportDescriptor> parse() {
        if (bytes_.size() > kLongestDescriptor) {
            return error(fmt::format("longer than {} bytes", kLongestDescriptor));
        }
        while (at_ < bytes_.size()) {
            if (const std::string_view problem = item(); !problem.empty()) {
                return error(problem);
            }
        }
        if (open_) {
            return error("a collection is not closed");
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] std::unexpected<Error> error(std::string_view problem) const {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("HID report descriptor, byte {}: {}", item_at_, problem)});
    }

    /// Reads one item; gives what is wrong with it, empty if nothing is.
    std::string_view item() {
        constexpr std::string_view kTruncated = "the item is cut off";
        item_at_ = at_;
        const std::uint8_t prefix = bytes_[at_++];
        const std::size_t left = bytes_.size() - at_;
        if (prefix == kLongItem) {  // its size, a tag, the data: reserved, none is defined
            if (left < 2 || left - 2 < bytes_[at_]) {
                return kTruncated;
            }
            at_ += 2U + bytes_[at_];
            return {};
        }
        ItemData data{0, (prefix & 3U) == 3U ? 4U : (prefix & 3U)};
        if (left < data.bytes) {
            return kTruncated;
        }
        for (std::uint32_t i = 0; i < data.bytes; ++i) {
            data.value |= std::uint32_t{bytes_[at_++]} << (8U * i);
        }
        const auto tag = static_cast<std::uint8_t>(prefix >> 4U);
        switch (static_cast<ItemType>((prefix >> 2U) & 3U)) {
            case ItemType::Main:
                return main(static_cast<MainTag>(tag), data);
            case ItemType::Global:
                return global(static_cast<GlobalTag>(tag), data);
            case ItemType::Local:
                return local(static_cast<LocalTag>(tag), data);
            case ItemType::Reserved:
                break;
        }
        return {};
    }

    std::string_view main(MainTag tag, const ItemData& data) {
        if (locals_.in_delimiter) {
            return "a delimiter is not closed";
        }
        std::string_view problem;
        switch (tag) {
            case MainTag::Input:
                problem = field(ReportKind::Input, data.value);
                break;
            case MainTag::Output:
                problem = field(ReportKind::Output, data.value);
                break;
            case MainTag::Feature:
                problem = field(ReportKind::Feature, data.value);
                break;
            case MainTag::Collection:
                result_.collections.push_back(
                    {.type = static_cast<std::uint8_t>(data.value),
                     .usage = locals_.usages.empty() ? 0 : complete(locals_.usages[0].first),
                     .parent = open_});
                open_ = result_.collections.size() - 1;
                break;
            case MainTag::EndCollection:
                if (!open_) {
                    return "End Collection without a collection";
                }
                open_ = result_.collections[*open_].parent;
                break;
        }
        locals_.clear();
        return problem;
    }

    std::string_view global(GlobalTag tag, const ItemData& data) {
        switch (tag) {
            case GlobalTag::UsagePage:
                globals_.usage_page = static_cast<std::uint16_t>(data.value);
                break;
            case GlobalTag::LogicalMinimum:
                globals_.logical.minimum = data;
                break;
            case GlobalTag::LogicalMaximum:
                globals_.logical.maximum = data;
                break;
            case GlobalTag::PhysicalMinimum:
                globals_.physical.minimum = data;
                break;
            case GlobalTag::PhysicalMaximum:
                globals_.physical.maximum = data;
                break;
            case GlobalTag::UnitExponent:
                globals_.unit_exponent = exponent_of(data);
                break;
            case GlobalTag::Unit:
                globals_.unit = data.value;
                break;
            case GlobalTag::ReportSize:
                if (data.value > 0xFFFFU) {
                    return "the report size is above 65535 bits";
                }
                globals_.report_size = data.value;
                break;
            case GlobalTag::ReportId:
                if (data.value == 0 || data.value > 0xFFU) {
                    return "the report id is not in 1 .. 255";
                }
                globals_.report_id = static_cast<std::uint8_t>(data.value);
                result_.numbered = true;
                break;
            case GlobalTag::ReportCount:
                if (data.value > 0xFFFFU) {
                    return "the report count is above 65535";
                }
                globals_.report_count = data.value;
                break;
            case GlobalTag::Push:
                if (stack_.size() == kDeepestStack) {
                    return "Push: the stack is too deep";
                }
                stack_.push_back(globals_);
                break;
            case GlobalTag::Pop:
                if (stack_.empty()) {
                    return "Pop without Push";
                }
                globals_ = stack_.back();
                stack_.pop_back();
                break;
        }
        return {};
    }

    std::string_view local(LocalTag tag, const ItemData& data) {
        switch (tag) {
            case LocalTag::Usage:
                add_usage({data, data});
                break;
            case LocalTag::UsageMinimum:
                locals_.minimum = data;
                add_range();
                break;
            case LocalTag::UsageMaximum:
                locals_.maximum = data;
                add_range();
                break;
            case LocalTag::Delimiter:
                if (locals_.in_delimiter == (data.value != 0)) {
                    return "delimiters do not match";
                }
                locals_.in_delimiter = data.value != 0;
                locals_.delimiter_has_usage = false;
                break;
        }
        return {};
    }

    void add_range() {
        if (locals_.minimum && locals_.maximum) {
            add_usage({*locals_.minimum, *locals_.maximum});
            locals_.minimum.reset();
            locals_.maximum.reset();
        }
    }

    /// Between delimiters stand alternatives for one control; the first is the preferred one.
    void add_usage(const PendingUsage& pending) {
        if (locals_.in_delimiter && std::exchange(locals_.delimiter_has_usage, true)) {
            return;
        }
        locals_.usages.push_back(pending);
    }

    [[nodiscard]] Usage complete(const ItemData& data) const {
        return data.bytes == 4 ? data.value
                               : usage(globals_.usage_page, static_cast<std::uint16_t>(data.value));
    }

    std::string_view field(ReportKind kind, std::uint32_t flags) {
        if (globals_.report_size == 0 || globals_.report_count == 0) {
            return {};
        }
        ReportSize& size = report_size(kind);
        const std::uint64_t bits = std::uint64_t{globals_.report_size} * globals_.report_count;
        if (size.bits + bits > 8 * kLongestReport) {
            return "the report is too long";
        }
        ReportField field{.kind = kind,
                          .report_id = globals_.report_id,
                          .bit_offset = size.bits,
                          .bits = globals_.report_size,
                          .count = globals_.report_count,
                          .flags = flags,
                          .logical_minimum = globals_.logical.least(),
                          .logical_maximum = globals_.logical.greatest(),
                          .physical_minimum = globals_.physical.least(),
                          .physical_maximum = globals_.physical.greatest(),
                          .unit_exponent = globals_.unit_exponent,
                          .unit = globals_.unit,
                          .usages = {},
                          .collection = open_};
        field.usages.reserve(locals_.usages.size());
        for (const PendingUsage& pending : locals_.usages) {
            const UsageRange range{complete(pending.first), complete(pending.last)};
            if (range.first <= range.last) {
                field.usages.push_back(range);
            }
        }
        size.bits += static_cast<std::uint32_t>(bits);
        result_.fields.push_back(std::move(field));
        return {};
    }

    ReportSize& report_size(ReportKind kind) {
        const auto found = std::ranges::find_if(result_.reports, [&](const ReportSize& size) {
            return size.kind == kind && size.id == globals_.report_id;
        });
        if (found != result_.reports.end()) {
            return *found;
        }
        return result_.reports.emplace_back(
            ReportSize{.kind = kind, .id = globals_.report_id, .bits = 0});
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::size_t item_at_ = 0;
    Globals globals_;
    std::vector<Globals> stack_;
    Locals locals_;
    std::optional<std::size_t> open_;  ///< the innermost open collection
    ReportDescriptor result_;
};

}  // namespace

Usage ReportField::usage_of(std::uint32_t element) const {
    if (usages.empty()) {
        return 0;
    }
    std::uint32_t left = element;
    for (const UsageRange& range : usages) {
        const std::uint32_t more = range.last - range.first;
        if (left <= more) {
            return range.first + left;
        }
        left -= more + 1;  // more < left, so that this cannot wrap
    }
    return usages.back().last;
}

const ReportSize* find_report(std::span<const ReportSize> reports, ReportKind kind,
                              std::uint8_t id) {
    const auto found = std::ranges::find_if(
        reports, [&](const ReportSize& size) { return size.kind == kind && size.id == id; });
    return found == reports.end() ? nullptr : &*found;
}

bool ReportDescriptor::inside(const ReportField& field, Usage collection_usage) const {
    for (std::optional<std::size_t> at = field.collection; at; at = collections[*at].parent) {
        if (collections[*at].usage == collection_usage) {
            return true;
        }
    }
    return false;
}

Expected<ReportDescriptor> parse_report_descriptor(std::span<const std::uint8_t> bytes) {
    return Parser(bytes).parse();
}

}  // namespace gazeloop::drivers::hid
