#include "drivers/trace/text/line_cells.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace gazeloop::drivers {
namespace {

constexpr char kQuote = '"';
constexpr std::size_t kEight = sizeof(std::uint64_t);

/// Finds a character in eight at once: cells are short, and a call for each costs more than they.
class Eightfold {
  public:
    explicit Eightfold(char searched) : searched_(kOnes * static_cast<unsigned char>(searched)) {}

    /// The high bit of each byte that is the character, the first one's lowest; no other bit.
    [[nodiscard]] std::uint64_t in(const char* eight) const {
        static_assert(std::endian::native == std::endian::little);
        std::uint64_t word = 0;
        std::memcpy(&word, eight, kEight);
        const std::uint64_t differs = word ^ searched_;
        return ~(((differs & kLow) + kLow) | differs | kLow);
    }

  private:
    static constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101;
    static constexpr std::uint64_t kLow = 0x7f * kOnes;
    std::uint64_t searched_;
};

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
    std::size_t begin = 0;
    const auto end_cell = [&](std::size_t end) {
        cells_.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    };
    const Eightfold searched(separator);
    std::size_t at = 0;
    for (; at + kEight <= line.size(); at += kEight) {
        for (std::uint64_t found = searched.in(line.data() + at); found != 0; found &= found - 1) {
            end_cell(at + static_cast<std::size_t>(std::countr_zero(found)) / kEight);
        }
    }
    for (; at < line.size(); ++at) {
        if (line[at] == separator) {
            end_cell(at);
        }
    }
    end_cell(line.size());
    return Problem::None;
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
