#include "runtime/report/wrapped_row.h"

#include <fmt/format.h>

namespace gazeloop::report {

std::string wrapped_row(std::string_view label, std::string_view text, std::size_t indent) {
    constexpr std::size_t kColumns = 100;
    const std::size_t width = kColumns - indent;
    std::string result = fmt::format("{:<{}}", label, indent);
    while (text.size() > width) {
        std::size_t end = text.substr(0, width + 1).rfind(' ');
        if (end == std::string_view::npos) {
            end = text.find(' ');
        }
        if (end == std::string_view::npos) {
            break;
        }
        result += fmt::format("{}\n{:{}}", text.substr(0, end), "", indent);
        text.remove_prefix(end + 1);
    }
    return fmt::format("{}{}\n", result, text);
}

}  // namespace gazeloop::report
