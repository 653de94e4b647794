#include "drivers/trace/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace gazeloop::drivers {
namespace {

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// A cell as it may stand in a message: short, and nothing that a terminal would act on.
std::string quoted(std::string_view cell) {
    constexpr std::size_t kLongest = 40;
    std::string text{cell.substr(0, kLongest)};
    std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return fmt::format("'{}{}'", text, cell.size() > kLongest ? "..." : "");
}

bool is_text(std::string_view line) {
    return std::none_of(line.begin(), line.end(), [](char c) {
        return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r';
    });
}

/// The whole cell as a number of this type; none where it is not one or does not fit.
template <typename Number>
std::optional<Number> parse(std::string_view cell) {
    Number value{};
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc{} || stop != end) {
        return std::nullopt;
    }
    return value;
}

}  // namespace

CsvTable::CsvTable(std::istream& in, std::string name)
    // One byte more for a CR, one for the zero that getline writes.
    : in_(&in), name_(std::move(name)), buffer_(kLongestLine + 2) {}

Expected<CsvTable> CsvTable::open(std::istream& in, std::string name) {
    CsvTable table(in, std::move(name));
    const Expected<bool> any = table.read_line();
    if (!any) {
        return std::unexpected(any.error());
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (table.text_.starts_with(kByteOrderMark)) {
        table.text_.remove_prefix(kByteOrderMark.size());
    }
    if (!*any || table.text_.empty()) {
        return table.error_here(*any ? "no header in the first line" : "empty file");
    }

    constexpr std::array<char, 3> kSeparators{',', ';', '\t'};
    table.separator_ =
        *std::max_element(kSeparators.begin(), kSeparators.end(), [&](char a, char b) {
            return std::count(table.text_.begin(), table.text_.end(), a) <
                   std::count(table.text_.begin(), table.text_.end(), b);
        });
    table.split();
    for (const std::string_view cell : table.cells_) {
        const bool is_new =
            table.column_of_.try_emplace(std::string{cell}, table.header_.size()).second;
        if (!is_new && !cell.empty()) {
            return table.error_here(fmt::format("column {} occurs twice", quoted(cell)));
        }
        table.header_.emplace_back(cell);
    }
    return table;
}

std::vector<std::string_view> CsvTable::missing(std::span<const std::string_view> columns) const {
    std::vector<std::string_view> absent;
    for (const std::string_view column : columns) {
        if (!column_of_.contains(column)) {
            absent.push_back(column);
        }
    }
    return absent;
}

std::size_t CsvTable::column(std::string_view column_name) const {
    const auto found = column_of_.find(column_name);
    assert(found != column_of_.end());
    return found->second;
}

Expected<bool> CsvTable::next() {
    if (refused_) {
        return std::unexpected(*refused_);
    }
    while (true) {
        const Expected<bool> any = read_line();
        if (!any || !*any) {
            return any;
        }
        if (trimmed(text_).empty()) {
            continue;
        }
        split();
        if (cells_.size() != header_.size()) {
            return error_here(
                fmt::format("{} columns, the header has {}", cells_.size(), header_.size()));
        }
        return true;
    }
}

double CsvTable::number(std::size_t column) {
    const std::optional<double> value = parse<double>(cells_[column]);
    if (!value) {
        refuse(column, "is not a number");
        return 0.0;
    }
    if (!std::isfinite(*value)) {
        refuse(column, "is not finite");
        return 0.0;
    }
    return *value;
}

double CsvTable::number_or(std::size_t column, double unknown) {
    return blank(column) ? unknown : number(column);
}

std::int64_t CsvTable::integer(std::size_t column) {
    const std::optional<std::int64_t> value = parse<std::int64_t>(cells_[column]);
    if (!value) {
        refuse(column, "is not a whole number of 64 bits");
    }
    return value.value_or(0);
}

std::uint64_t CsvTable::count(std::size_t column) {
    const std::optional<std::uint64_t> value = parse<std::uint64_t>(cells_[column]);
    if (!value) {
        refuse(column, "is not a whole number from 0");
    }
    return value.value_or(0);
}

void CsvTable::refuse(std::size_t column, std::string_view problem) {
    if (!refused_) {
        refused_ = error_here(fmt::format("column '{}': {} {}", header_[column],
                                          quoted(cells_[column]), problem))
                       .error();
    }
}

Expected<bool> CsvTable::read_line() {
    ++line_;
    in_->getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const auto extracted = static_cast<std::size_t>(in_->gcount());
    if (in_->bad()) {
        return error_here("cannot be read");
    }
    if (in_->eof() && extracted == 0) {
        return false;
    }
    const bool ended = !in_->eof() && !in_->fail();
    text_ = std::string_view{buffer_.data(), ended ? extracted - 1 : extracted};
    if (text_.ends_with('\r')) {
        text_.remove_suffix(1);
    }
    if ((in_->fail() && !in_->eof()) || text_.size() > kLongestLine) {
        return error_here(fmt::format("longer than {} bytes", kLongestLine));
    }
    if (!is_text(text_)) {
        return error_here("not a text file");
    }
    return true;
}

void CsvTable::split() {
    cells_.clear();
    std::string_view rest = text_;
    while (true) {
        const std::size_t end = rest.find(separator_);
        cells_.push_back(trimmed(rest.substr(0, end)));
        if (end == std::string_view::npos) {
            return;
        }
        rest.remove_prefix(end + 1);
    }
}

std::unexpected<Error> CsvTable::error_here(std::string_view message) const {
    return std::unexpected(
        Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", name_, line_, message)});
}

}  // namespace gazeloop::drivers
