#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/hid/report_descriptor.h"

namespace gazeloop::drivers::hid {

/// `bits` (1 to 64) bits of a report's payload, least significant first, from `bit_offset`; none
/// where the payload ends before. The payload is the report without its id's byte.
[[nodiscard]] std::optional<std::uint64_t> read_bits(std::span<const std::uint8_t> payload,
                                                     std::uint32_t bit_offset, std::uint32_t bits);

/// Writes the lowest `bits` (1 to 64) bits of a value; false, and nothing written, where the
/// payload ends before.
bool write_bits(std::span<std::uint8_t> payload, std::uint32_t bit_offset, std::uint32_t bits,
                std::uint64_t value);

/// One number in a report: where it lies and what it means.
struct ReportValue {
    ReportKind kind = ReportKind::Input;
    std::uint8_t report_id = 0;
    std::uint32_t bit_offset = 0;
    std::uint32_t bits = 0;  ///< 1 .. 64
    bool is_signed = false;
    /// Values outside say "no data"; least >= greatest: no range was given.
    std::int64_t least = 0;
    std::int64_t greatest = 0;
    /// Whether the field's greatest number means "no data". False for a position in a field of less
    /// than 32 bits whose range ends at that number: it may be the edge of a screen.
    bool has_no_data = true;
    double scale = 1.0;   ///< SI units for one step of the value
    double offset = 0.0;  ///< SI units at value 0

    /// The number as it stands in the payload; none where the payload is too short, or where an
    /// unsigned number is above the greatest signed one.
    [[nodiscard]] std::optional<std::int64_t> raw(std::span<const std::uint8_t> payload) const;

    /// The number that the device states. None where raw() has none, outside the range, and for
    /// what devices send for "no data". That is the greatest number that the field can hold, unless
    /// it may be a real value (has_no_data); with 32 bits also the greatest signed one.
    [[nodiscard]] std::optional<std::int64_t> number(std::span<const std::uint8_t> payload) const;

    /// number() in SI units.
    [[nodiscard]] std::optional<double> si(std::span<const std::uint8_t> payload) const;
};

/// What the numbers of a field measure, and the unit they have where the field itself states none
/// of that kind.
enum class Quantity : std::uint8_t {
    Length,  ///< metres; no unit stated: micrometres, as in usage page 0x12
    Time,    ///< seconds; no unit stated: microseconds
    Count,   ///< a plain number
};

/// An element of a field as a number; none if it has more than 64 bits. Physical extents scale the
/// value as in HID 1.11, 6.2.2.7. A unit of another kind than the quantity is a leftover (units are
/// global items) and counts as none stated. A field without a logical range is read as `is_signed`
/// says.
[[nodiscard]] std::optional<ReportValue> value_of(const ReportField& field, std::uint32_t element,
                                                  Quantity quantity, bool is_signed);

/// Seconds or metres for one unit of a field.
[[nodiscard]] double unit_size(const ReportField& field, Quantity quantity);

}  // namespace gazeloop::drivers::hid
