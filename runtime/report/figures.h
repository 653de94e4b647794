#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "runtime/time/stamp.h"

namespace gazeloop::report {

/// A figure for a column of a table, at most `most` characters wide where that can be: longer ones
/// lose decimals, then digits. "-": none.
[[nodiscard]] inline std::string figure(const std::optional<double>& value, std::size_t most = 8) {
    if (!value) {
        return "-";
    }
    for (const int decimals : {2, 1, 0}) {
        std::string text = fmt::format("{:.{}f}", *value, decimals);
        if (text.size() <= most) {
            return text;
        }
    }
    constexpr std::size_t kOneDecimal = 8;  // "-1.2e+13"
    return fmt::format("{:.{}e}", *value, most < kOneDecimal ? 0 : 1);
}

/// A count, in at most 8 characters.
[[nodiscard]] inline std::string count_text(std::uint64_t value) {
    constexpr std::uint64_t kWidest = 99'999'999;
    return value <= kWidest ? fmt::format("{}", value)
                            : fmt::format("{:.2e}", static_cast<double>(value));
}

/// The least certain kind of the frames that know a quantity, with '+' where there are better ones.
[[nodiscard]] inline std::string kind_text(
    const std::array<std::uint64_t, time::kStampKindCount>& frames_by_kind) {
    std::string text;
    for (std::size_t kind = time::kStampKindCount - 1; kind > 0; --kind) {
        if (frames_by_kind[kind] > 0 && text.empty()) {
            text = time::name(static_cast<time::StampKind>(kind));
        } else if (frames_by_kind[kind] > 0) {
            return text + "+";
        }
    }
    return text.empty() ? std::string(time::name(time::StampKind::Unknown)) : text;
}

}  // namespace gazeloop::report
