#include "drivers/trace/text/cell_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace gazeloop::drivers {
namespace {

/// C has no plus before a number; some programs write one.
std::string_view without_plus(std::string_view cell) {
    const bool plus = cell.size() > 1 && cell[0] == '+' && cell[1] != '-' && cell[1] != '+';
    return plus ? cell.substr(1) : cell;
}

constexpr std::string_view kMinusSign = "\xE2\x88\x92";  // U+2212

/// What `parse` makes of a cell that begins with a minus sign, with '-' in its place.
template <typename Parse>
auto parsed_with_minus(std::string_view cell, NumberSpelling& seen, const Parse& parse)
    -> decltype(parse(cell)) {
    std::array<char, 64> copy{};
    if (!cell.starts_with(kMinusSign) || cell.size() > copy.size()) {
        return std::nullopt;
    }
    const std::string_view rest = cell.substr(kMinusSign.size());
    copy[0] = '-';
    std::copy(rest.begin(), rest.end(), copy.begin() + 1);
    const auto value = parse(std::string_view{copy.data(), rest.size() + 1});
    seen.minus_sign = seen.minus_sign || value.has_value();
    return value;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Decimals of a few digits, as half of a table's cells are, for a fraction of what any number
/// takes; NaN for all else, and for what is no number. Exact: a whole number below 2^53 over a
/// power of ten that a double holds is rounded once.
double short_decimal(std::string_view cell) {
    constexpr std::size_t kMostDigits = 15;
    constexpr std::array<double, kMostDigits + 1> kPowers{
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    if (cell.empty() || cell.size() > kMostDigits) {
        return kNone;
    }
    const bool negative = cell.front() == '-';
    std::uint64_t whole = 0;
    std::size_t digits = 0;
    std::size_t behind = 0;  // the point
    bool point = false;
    for (const char c : cell.substr(negative ? 1 : 0)) {
        const unsigned digit = static_cast<unsigned char>(c) - unsigned{'0'};
        if (digit < 10) {
            whole = 10 * whole + digit;
            ++digits;
            behind += point ? 1U : 0U;
        } else if (c == '.' && !point) {
            point = true;
        } else {
            return kNone;
        }
    }
    if (digits == 0) {
        return kNone;
    }
    const double value = static_cast<double>(whole) / kPowers[behind];
    return negative ? -value : value;
}

/// The whole cell as a number, NaN where it is not one.
double parsed(std::string_view cell) {
    double value = short_decimal(cell);
    if (!std::isnan(value)) {
        return value;
    }
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    return error == std::errc{} && stop == end ? value : kNone;
}

/// A number with a comma for its point.
double parsed_with_comma(std::string_view cell) {
    std::array<char, 64> copy{};
    const auto comma = std::find(cell.begin(), cell.end(), ',');
    if (comma == cell.end() || cell.size() > copy.size()) {
        return kNone;
    }
    std::copy(cell.begin(), cell.end(), copy.begin());
    copy.at(static_cast<std::size_t>(comma - cell.begin())) = '.';
    return parsed({copy.data(), cell.size()});
}

template <typename Whole>
std::optional<Whole> parsed_whole(std::string_view cell, NumberSpelling& seen) {
    cell = without_plus(cell);
    if (cell.starts_with(kMinusSign)) {
        return parsed_with_minus(
            cell, seen, [&](std::string_view ascii) { return parsed_whole<Whole>(ascii, seen); });
    }
    Whole value{};
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc{}) {
        return std::nullopt;
    }
    if (stop == end) {
        return value;
    }
    const bool zeros_follow = (*stop == '.' || *stop == ',') &&
                              std::all_of(stop + 1, end, [](char c) { return c == '0'; });
    if (!zeros_follow) {
        return std::nullopt;
    }
    seen.whole_as_real = true;
    seen.decimal_comma = seen.decimal_comma || *stop == ',';
    return value;
}

}  // namespace

double real_or_nan(std::string_view cell, NumberSpelling& seen) {
    if (cell.empty()) {
        return kNone;
    }
    cell = without_plus(cell);
    double value = parsed(cell);
    if (std::isnan(value)) {
        value = parsed_with_comma(cell);
        seen.decimal_comma = seen.decimal_comma || !std::isnan(value);
    }
    if (std::isnan(value) && cell.starts_with(kMinusSign)) {
        return parsed_with_minus(cell, seen,
                                 [&](std::string_view ascii) { return real_number(ascii, seen); })
            .value_or(kNone);
    }
    return std::isfinite(value) ? value : kNone;
}

std::optional<double> real_number(std::string_view cell, NumberSpelling& seen) {
    const double value = real_or_nan(cell, seen);
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<std::int64_t> whole_number(std::string_view cell, NumberSpelling& seen) {
    return parsed_whole<std::int64_t>(cell, seen);
}

std::optional<std::uint64_t> count_number(std::string_view cell, NumberSpelling& seen) {
    return parsed_whole<std::uint64_t>(cell, seen);
}

namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Digits with an exponent, as programs write small times.
std::optional<std::int64_t> decimal_of_real(std::string_view cell, int digits,
                                            NumberSpelling& seen) {
    constexpr double kMost = 9.2e18;
    const std::optional<double> value = real_number(cell, seen);
    const double scaled = value.value_or(0.0) * std::pow(10.0, digits);
    if (!value || !(std::abs(scaled) < kMost)) {
        return std::nullopt;
    }
    return std::llround(scaled);
}

}  // namespace

std::optional<std::int64_t> decimal_number(std::string_view cell, int digits,
                                           NumberSpelling& seen) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    if (cell.starts_with(kMinusSign)) {
        return parsed_with_minus(cell, seen, [&](std::string_view ascii) {
            return decimal_number(ascii, digits, seen);
        });
    }
    std::string_view rest = without_plus(cell);
    const bool negative = rest.starts_with('-');
    rest.remove_prefix(negative ? 1 : 0);
    std::int64_t value = 0;
    int behind = -1;  // digits behind the point, once there is one
    bool rounds_up = false;
    bool any_digit = false;
    bool comma = false;
    for (const char c : rest) {
        if ((c == '.' || c == ',') && behind < 0) {
            behind = 0;
            comma = c == ',';
            continue;
        }
        if (!is_digit(c)) {
            return c == 'e' || c == 'E' ? decimal_of_real(cell, digits, seen) : std::nullopt;
        }
        any_digit = true;
        if (behind >= digits) {
            rounds_up = behind == digits ? c >= '5' : rounds_up;
            ++behind;
            continue;
        }
        behind += behind >= 0 ? 1 : 0;
        if (value > (kMost - 9) / 10) {
            return std::nullopt;
        }
        value = 10 * value + (c - '0');
    }
    if (!any_digit) {
        return std::nullopt;
    }
    for (int missing = digits - std::clamp(behind, 0, digits); missing > 0; --missing) {
        if (value > kMost / 10) {
            return std::nullopt;
        }
        value *= 10;
    }
    value += rounds_up && value < kMost ? 1 : 0;
    seen.decimal_comma = seen.decimal_comma || comma;
    return negative ? -value : value;
}

namespace {

constexpr std::size_t kLongestWord = 9;  // "-nan(ind)"

/// A cell in lower case; empty where it is longer than any word that is known.
class ShortWord {
  public:
    explicit ShortWord(std::string_view cell)
        : size_(cell.size() <= kLongestWord ? cell.size() : 0) {
        std::transform(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(size_),
                       lower_.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    }
    [[nodiscard]] std::string_view text() const { return {lower_.data(), size_}; }

  private:
    std::array<char, kLongestWord> lower_{};
    std::size_t size_;
};

}  // namespace

std::optional<bool> truth_of(std::string_view cell) {
    if (cell == "1" || cell == "0") {
        return cell == "1";
    }
    NumberSpelling ignored;
    if (const std::optional<std::int64_t> number = whole_number(cell, ignored)) {
        return *number == 0 || *number == 1 ? std::optional(*number == 1) : std::nullopt;
    }
    const ShortWord word(cell);
    for (const std::string_view yes : {"true", "yes", "valid"}) {
        if (word.text() == yes) {
            return true;
        }
    }
    for (const std::string_view no : {"false", "no", "invalid"}) {
        if (word.text() == no) {
            return false;
        }
    }
    return std::nullopt;
}

bool says_no_number(std::string_view cell) {
    if (cell.empty()) {
        return true;
    }
    const ShortWord lower(cell);
    std::string_view word = lower.text();
    if (word.empty()) {
        return false;
    }
    // "-1.#IND" is how Microsoft's libraries wrote it.
    constexpr std::array<std::string_view, 4> kWords{"n/a", "na", "null", "none"};
    if (word == "-" || word == "." ||
        std::find(kWords.begin(), kWords.end(), word) != kWords.end()) {
        return true;
    }
    if (word.front() == '-' || word.front() == '+') {
        word.remove_prefix(1);
    }
    return word.starts_with("nan") || word == "inf" || word == "infinity" ||
           word.starts_with("1.#");
}

}  // namespace gazeloop::drivers
