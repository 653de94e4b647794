#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::drivers::hid {

/// The longest descriptor that is read, and the longest report that one may describe, in bytes: the
/// bounds of the Linux kernel, which hands out no others.
inline constexpr std::size_t kLongestDescriptor = 4096;
inline constexpr std::size_t kLongestReport = 16384;

enum class ReportKind : std::uint8_t { Input, Output, Feature };

/// A usage: its page in the upper, its id in the lower 16 bits. 0 is none.
using Usage = std::uint32_t;

[[nodiscard]] constexpr Usage usage(std::uint16_t page, std::uint16_t id) {
    return (Usage{page} << 16U) | id;
}

/// Usages that follow each other, both ends included; first <= last.
struct UsageRange {
    Usage first = 0;
    Usage last = 0;
};

enum class CollectionType : std::uint8_t { Physical = 0, Application = 1, Logical = 2 };

struct Collection {
    std::uint8_t type = 0;  ///< CollectionType, or another of HID's
    Usage usage = 0;
    std::optional<std::size_t> parent;  ///< index of the collection around it
};

/// One Input, Output or Feature item: `count` elements of `bits` bits each, side by side. Fields
/// flagged Constant are kept: some devices flag their data so.
struct ReportField {
    ReportKind kind = ReportKind::Input;
    std::uint8_t report_id = 0;    ///< 0 where the device does not number its reports
    std::uint32_t bit_offset = 0;  ///< of the first element, after the report id's byte
    std::uint32_t bits = 0;        ///< > 0
    std::uint32_t count = 0;       ///< > 0
    std::uint32_t flags = 0;       ///< the item's data (HID 1.11, 6.2.2.4)
    std::int64_t logical_minimum = 0;
    std::int64_t logical_maximum = 0;
    std::int64_t physical_minimum = 0;  ///< both 0: as the logical ones
    std::int64_t physical_maximum = 0;
    int unit_exponent = 0;                  ///< power of ten
    std::uint32_t unit = 0;                 ///< nibbles as in HID 1.11, 6.2.2.7
    std::vector<UsageRange> usages;         ///< in order; may be empty
    std::optional<std::size_t> collection;  ///< index of the innermost one around it

    /// Of an element of a variable field: the last usage serves all elements beyond it.
    [[nodiscard]] Usage usage_of(std::uint32_t element) const;
};

/// How long a report is.
struct ReportSize {
    ReportKind kind = ReportKind::Input;
    std::uint8_t id = 0;
    std::uint32_t bits = 0;  ///< without the report id's byte

    [[nodiscard]] std::size_t payload_bytes() const { return (bits + 7U) / 8U; }
};

/// Null where there is no such report.
[[nodiscard]] const ReportSize* find_report(std::span<const ReportSize> reports, ReportKind kind,
                                            std::uint8_t id);

/// What a HID device says of its reports (HID 1.11, 6.2.2), item by item.
struct ReportDescriptor {
    std::vector<Collection> collections;
    std::vector<ReportField> fields;
    std::vector<ReportSize> reports;
    bool numbered = false;  ///< every report begins with a byte that is its id

    /// Whether the field lies in a collection with that usage, at any depth.
    [[nodiscard]] bool inside(const ReportField& field, Usage collection_usage) const;
};

/// Reads a report descriptor. Long items and reserved tags are skipped. Usage ranges are kept as
/// such, so that no descriptor takes more than a small multiple of its own size.
///
/// Ranges are signed where the minimum is negative, unsigned otherwise, whichever item came first.
/// Usages of one or two bytes belong to the usage page in force at the main item.
///
/// Errors (BadInput), with the byte where each stands: a truncated item; an unmatched Pop, End
/// Collection or Delimiter; a collection that is not closed. Also a report id of 0 or above 255, a
/// field of more than 65,535 bits or elements, a report or descriptor above the bounds.
[[nodiscard]] Expected<ReportDescriptor> parse_report_descriptor(
    std::span<const std::uint8_t> bytes);

}  // namespace gazeloop::drivers::hid
