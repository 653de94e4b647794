#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace gazeloop {

/// Where lists and objects of a JSON text first lie deeper in each other than `most`, as a byte;
/// none: nowhere. One pass over text that need not be JSON, so that what reads it may recurse.
/// (nlohmann's parser has a callback that is told depths, but then takes time by the square of how
/// many values lie side by side.)
[[nodiscard]] constexpr std::optional<std::size_t> nested_deeper_at(std::string_view json,
                                                                    std::size_t most) {
    std::size_t depth = 0;
    bool is_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_text) {
            i += c == '\\' ? 1 : 0;
            is_text = c != '"';
        } else if (c == '"') {
            is_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > most) {
                return i;
            }
        } else if (c == '}' || c == ']') {
            depth -= depth > 0 ? 1 : 0;
        }
    }
    return std::nullopt;
}

}  // namespace gazeloop
