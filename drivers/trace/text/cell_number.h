#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace gazeloop::drivers {

/// How a number was written, where not the C way.
struct NumberSpelling {
    bool decimal_comma = false;  ///< "0,5"
    bool whole_as_real = false;  ///< "31.0" for 31
    bool minus_sign = false;     ///< U+2212, as word processors write it, for '-'
};

/// Numbers of a table's cells, whatever the locale. Decimals have a point, or a comma; a
/// minus may be U+2212. Either is added to `seen`.
///
/// A finite number; none where the cell is anything else, or does not fit.
[[nodiscard]] std::optional<double> real_number(std::string_view cell, NumberSpelling& seen);

/// The same with NaN for none: it stays in a register. An optional is returned through memory, in
/// pieces that a processor cannot forward; of a table's numbers that took a fifth of the time.
[[nodiscard]] double real_or_nan(std::string_view cell, NumberSpelling& seen);

/// A whole number of 64 bits, also as tables with gaps write it, with zeros behind a point.
[[nodiscard]] std::optional<std::int64_t> whole_number(std::string_view cell, NumberSpelling& seen);
[[nodiscard]] std::optional<std::uint64_t> count_number(std::string_view cell,
                                                        NumberSpelling& seen);

/// A number in units of its `digits`th decimal, as a clock in seconds is read in nanoseconds (9):
/// exactly, and what is behind that is rounded. None where it does not fit 64 bits. `digits` is 0
/// to 18.
[[nodiscard]] std::optional<std::int64_t> decimal_number(std::string_view cell, int digits,
                                                         NumberSpelling& seen);

/// Yes or no as programs write it: 1 or 0, "true" or "false", "yes" or "no", "valid" or "invalid",
/// in any case. None where it is something else.
[[nodiscard]] std::optional<bool> truth_of(std::string_view cell);

/// Whether the cell says that there is no number: blank, "NaN", "-nan(ind)", "inf", "n/a", "null"
/// and the like, in any case.
[[nodiscard]] bool says_no_number(std::string_view cell);

}  // namespace gazeloop::drivers
