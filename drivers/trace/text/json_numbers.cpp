#include "drivers/trace/text/json_numbers.h"

#include <charconv>
#include <cstddef>
#include <system_error>

#include "drivers/trace/text/cell_number.h"

namespace gazeloop::drivers {
namespace {

bool is_of_a_number(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
           c == '-' || c == '.' || c == '#' || c == '(' || c == ')';
}

bool is_too_large(std::string_view token) {
    double value = 0.0;
    const char* const end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    return error == std::errc::result_out_of_range && stop == end;
}

/// Behind the string that begins here.
std::size_t end_of_string(std::string_view json, std::size_t begin) {
    std::size_t at = begin + 1;
    while (at < json.size() && json[at] != '"') {
        at += json[at] == '\\' ? 2 : 1;
    }
    return at < json.size() ? at + 1 : json.size();
}

}  // namespace

std::string with_numbers_quoted_that_json_lacks(std::string_view json) {
    std::string text;
    text.reserve(json.size() + 2);
    for (std::size_t at = 0; at < json.size();) {
        std::size_t end = at + 1;
        bool quote = false;
        if (json[at] == '"') {
            end = end_of_string(json, at);
        } else if (is_of_a_number(json[at])) {
            while (end < json.size() && is_of_a_number(json[end])) {
                ++end;
            }
            const std::string_view token = json.substr(at, end - at);
            quote = token != "null" && (says_no_number(token) || is_too_large(token));
        }
        const std::string_view part = json.substr(at, end - at);
        text += quote ? '"' + std::string{part} + '"' : std::string{part};
        at = end;
    }
    return text;
}

}  // namespace gazeloop::drivers
