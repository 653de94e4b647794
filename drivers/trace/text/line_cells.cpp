#include "drivers/trace/text/line_cells.h"

namespace gazeloop::drivers {
namespace {

constexpr char kQuote = '"';

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::size_t count_outside_quotes(std::string_view line, char c) {
    std::size_t count = 0;
    bool quoted = false;
    for (const char at : line) {
        quoted = quoted != (at == kQuote);
        count += !quoted && at == c ? 1U : 0U;
    }
    return count;
}

LineCells::Problem LineCells::split(std::string_view line, char separator) {
    cells_.clear();
    had_quotes_ = line.find(kQuote) != std::string_view::npos;
    if (had_quotes_) {
        return split_quoted(line, separator);
    }
    while (true) {
        const std::size_t end = line.find(separator);
        cells_.push_back(trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) {
            return Problem::None;
        }
        line.remove_prefix(end + 1);
    }
}

LineCells::Problem LineCells::split_quoted(std::string_view line, char separator) {
    unquoted_.clear();
    had_quotes_ = false;  // a quote within a cell is a character like any other
    while (true) {
        std::size_t first = 0;
        while (first < line.size() && line[first] == ' ') {
            ++first;
        }
        if (first == line.size() || line[first] != kQuote) {
            const std::size_t end = line.find(separator);
            cells_.push_back(trimmed(line.substr(0, end)));
            if (end == std::string_view::npos) {
                return Problem::None;
            }
            line.remove_prefix(end + 1);
            continue;
        }
        had_quotes_ = true;
        const std::size_t start = unquoted_.size();
        std::size_t at = first + 1;
        while (true) {
            const std::size_t quote = line.find(kQuote, at);
            if (quote == std::string_view::npos) {
                return Problem::OpenQuote;
            }
            unquoted_ += line.substr(at, quote - at);
            at = quote + 1;
            if (at == line.size() || line[at] != kQuote) {
                break;
            }
            unquoted_ += kQuote;
            ++at;
        }
        cells_.push_back(trimmed(std::string_view{unquoted_}.substr(start)));
        while (at < line.size() && line[at] == ' ') {
            ++at;
        }
        if (at == line.size()) {
            return Problem::None;
        }
        if (line[at] != separator) {
            return Problem::TextBehindQuote;
        }
        line.remove_prefix(at + 1);
    }
}

}  // namespace gazeloop::drivers
