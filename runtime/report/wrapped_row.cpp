#include "runtime/report/wrapped_row.h"

#include <fmt/format.h>

namespace gazeloop::report {

std::string wrapped_row(std::string_view label, std::string_view text) {
    constexpr std::size_t kIndent = 9;
    constexpr std::size_t kWidth = 100 - kIndent;
    std::string result = fmt::format("{:<{}}", label, kIndent);
    while (text.size() > kWidth) {
        std::size_t end = text.substr(0, kWidth + 1).rfind(' ');
        if (end == std::string_view::npos) {
            end = text.find(' ');
        }
        if (end == std::string_view::npos) {
            break;
        }
        result += fmt::format("{}\n{:{}}", text.substr(0, end), "", kIndent);
        text.remove_prefix(end + 1);
    }
    return fmt::format("{}{}\n", result, text);
}

}  // namespace gazeloop::report
