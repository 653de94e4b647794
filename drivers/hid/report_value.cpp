#include "drivers/hid/report_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gazeloop::drivers::hid {
namespace {

constexpr std::uint32_t kWidest = 64;
constexpr std::uint32_t kWord = 32;

// HID 1.11, 6.2.2.7: nibble 0 is the system, 1 the length's exponent, 3 the time's.
constexpr std::uint32_t kCentimetre = 0x11;
constexpr std::uint32_t kInch = 0x13;
constexpr std::uint32_t kSecond = 0x1000;
constexpr std::uint32_t kSystem = 0xF;

std::uint64_t low_bits(std::uint32_t bits) {
    return bits >= kWidest ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

std::optional<double> stated_unit_size(const ReportField& field, Quantity quantity) {
    const double power = std::pow(10.0, field.unit_exponent);
    if (quantity == Quantity::Length && field.unit == kCentimetre) {
        return 1e-2 * power;
    }
    if (quantity == Quantity::Length && field.unit == kInch) {
        return 2.54e-2 * power;
    }
    const bool any_system = (field.unit & kSystem) != 0;
    if (quantity == Quantity::Time && any_system && (field.unit & ~kSystem) == kSecond) {
        return power;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> read_bits(std::span<const std::uint8_t> payload,
                                       std::uint32_t bit_offset, std::uint32_t bits) {
    if (bits == 0 || bits > kWidest ||
        std::uint64_t{bit_offset} + bits > 8U * std::uint64_t{payload.size()}) {
        return std::nullopt;
    }
    std::uint64_t value = 0;
    std::uint32_t done = 0;
    while (done < bits) {
        const std::uint32_t at = bit_offset + done;
        const std::uint32_t skip = at % 8U;
        value |= (std::uint64_t{payload[at / 8U]} >> skip) << done;
        done += 8U - skip;
    }
    return value & low_bits(bits);
}

bool write_bits(std::span<std::uint8_t> payload, std::uint32_t bit_offset, std::uint32_t bits,
                std::uint64_t value) {
    if (bits == 0 || bits > kWidest ||
        std::uint64_t{bit_offset} + bits > 8U * std::uint64_t{payload.size()}) {
        return false;
    }
    for (std::uint32_t i = 0; i < bits; ++i) {
        const std::uint32_t at = bit_offset + i;
        const auto mask = static_cast<std::uint8_t>(1U << (at % 8U));
        std::uint8_t& byte = payload[at / 8U];
        byte = static_cast<std::uint8_t>(((value >> i) & 1U) != 0 ? byte | mask : byte & ~mask);
    }
    return true;
}

std::optional<std::int64_t> ReportValue::raw(std::span<const std::uint8_t> payload) const {
    const std::optional<std::uint64_t> value = read_bits(payload, bit_offset, bits);
    if (!value) {
        return std::nullopt;
    }
    const bool negative = is_signed && ((*value >> (bits - 1)) & 1U) != 0;
    if (negative) {
        return static_cast<std::int64_t>(*value | ~low_bits(bits));
    }
    if (*value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(*value);
}

std::optional<std::int64_t> ReportValue::number(std::span<const std::uint8_t> payload) const {
    const std::optional<std::int64_t> value = raw(payload);
    const auto no_data = static_cast<std::int64_t>(low_bits(is_signed ? bits - 1 : bits));
    if (!value || (has_no_data && *value == no_data) ||
        (bits == kWord && *value == std::numeric_limits<std::int32_t>::max()) ||
        (least < greatest && (*value < least || *value > greatest))) {
        return std::nullopt;
    }
    return value;
}

std::optional<double> ReportValue::si(std::span<const std::uint8_t> payload) const {
    const std::optional<std::int64_t> value = number(payload);
    return value ? std::optional(static_cast<double>(*value) * scale + offset) : std::nullopt;
}

double unit_size(const ReportField& field, Quantity quantity) {
    constexpr double kMicro = 1e-6;
    return quantity == Quantity::Count ? 1.0 : stated_unit_size(field, quantity).value_or(kMicro);
}

std::optional<ReportValue> value_of(const ReportField& field, std::uint32_t element,
                                    Quantity quantity, bool is_signed) {
    if (field.bits > kWidest) {
        return std::nullopt;
    }
    const bool ranged = field.logical_minimum < field.logical_maximum;
    ReportValue value{.kind = field.kind,
                      .report_id = field.report_id,
                      .bit_offset = field.bit_offset + element * field.bits,
                      .bits = field.bits,
                      .is_signed = ranged ? field.logical_minimum < 0 : is_signed,
                      .least = field.logical_minimum,
                      .greatest = field.logical_maximum,
                      .has_no_data = quantity == Quantity::Count || field.bits >= kWord || !ranged};
    double steps = 1.0;
    double first = 0.0;
    if (ranged && field.physical_minimum < field.physical_maximum) {
        // 32-bit extents: their differences are exact in double.
        steps = static_cast<double>(field.physical_maximum - field.physical_minimum) /
                static_cast<double>(field.logical_maximum - field.logical_minimum);
        first = static_cast<double>(field.physical_minimum) -
                steps * static_cast<double>(field.logical_minimum);
    }
    const double size = unit_size(field, quantity);
    value.scale = steps * size;
    value.offset = first * size;
    return value;
}

}  // namespace gazeloop::drivers::hid
