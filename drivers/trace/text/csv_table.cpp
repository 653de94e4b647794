#include "drivers/trace/text/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace gazeloop::drivers {
namespace {

constexpr std::string_view kSeparators = ",;\t|";

/// Also one that a program saved in quotes.
bool is_comment(std::string_view line) {
    if (line.starts_with('"')) {
        line.remove_prefix(1);
    }
    return line.starts_with('#') || line.starts_with("//");
}

/// A line of one cell, however many empty ones stand behind it.
bool is_title(std::string_view line) {
    return std::all_of(kSeparators.begin(), kSeparators.end(), [&](char separator) {
        LineCells cells(line.size());
        return cells.split(line, separator) == LineCells::Problem::None && !cells[0].empty() &&
               std::all_of(cells.cells().begin() + 1, cells.cells().end(),
                           [](std::string_view cell) { return cell.empty(); });
    });
}

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

std::string lower_case(std::string_view text) {
    std::string lower{text};
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return lower;
}

/// A cell as it may stand in a message: short, and nothing that a terminal would act on.
std::string shown(std::string_view cell) {
    constexpr std::size_t kLongest = 40;
    std::string text{cell.substr(0, kLongest)};
    std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return fmt::format("'{}{}'", text, cell.size() > kLongest ? "..." : "");
}

constexpr std::string_view kAnyUnit = " [*]";

/// A column's name taken apart: "Time [ms]" is "Time" and "ms".
struct NameAndUnit {
    std::string_view name;
    std::string_view unit;
};

NameAndUnit apart(std::string_view column) {
    for (const auto& [open, close] : {std::pair{" [", ']'}, std::pair{" (", ')'}}) {
        const std::size_t at = column.find(open);
        if (column.ends_with(close) && at != std::string_view::npos) {
            return {column.substr(0, at), column.substr(at + 2, column.size() - at - 3)};
        }
    }
    return {column, {}};
}

std::string_view said(LineCells::Problem problem) {
    return problem == LineCells::Problem::OpenQuote
               ? "a cell's double quote is not closed on its line: close it, or remove the line "
                 "end "
                 "in the cell"
               : "text behind a cell's closing quote: separate it, or write a quote in a cell "
                 "twice";
}

}  // namespace

CsvTable::CsvTable(TextLines lines) : lines_(std::move(lines)) {}

Expected<CsvTable> CsvTable::open(std::istream& in, std::string name) {
    return open(TextLines{in, std::move(name)});
}

Expected<CsvTable> CsvTable::open(TextLines lines) {
    CsvTable table{std::move(lines)};
    for (const auto step : {&CsvTable::skip_preamble, &CsvTable::read_header}) {
        if (const Expected<void> done = (table.*step)(); !done) {
            return std::unexpected(done.error());
        }
    }
    return table;
}

Expected<CsvTable> CsvTable::without_header(TextLines lines, char separator,
                                            std::span<const std::string> columns) {
    CsvTable table{std::move(lines)};
    table.separator_ = separator;
    const std::vector<std::string_view> names(columns.begin(), columns.end());
    if (const Expected<void> taken = table.take_header(names); !taken) {
        return std::unexpected(taken.error());
    }
    return table;
}

Expected<void> CsvTable::skip_preamble() {
    constexpr std::size_t kMostTitles = 8;
    constexpr std::string_view kNoHeader =
        "no header: no line up to here has columns' names with , ; | or tabs between them";
    std::uint64_t first_skipped = 0;
    std::uint64_t title = 0;
    std::size_t titles = 0;
    while (true) {
        const Expected<bool> any = lines_.next();
        if (!any) {
            return std::unexpected(any.error());
        }
        if (!*any && titles > 0) {
            return lines_.error_here(kNoHeader);
        }
        if (!*any) {
            return lines_.error_here(lines_.line() == 1
                                         ? "empty file: record or copy it again"
                                         : "no header: a table begins with its columns' names");
        }
        const std::string_view text = trimmed(lines_.text());
        if (text.empty() || is_comment(text)) {
            first_skipped = first_skipped > 0 ? first_skipped : lines_.line();
            continue;
        }
        const Expected<bool> says_separator = takes_separator(lines_.text());
        if (!says_separator) {
            return std::unexpected(says_separator.error());
        }
        if (*says_separator) {
            continue;
        }
        if (separator_ != '\0' || !is_title(lines_.text())) {
            break;
        }
        title = lines_.line();
        if (++titles > kMostTitles) {
            return lines_.error_here(kNoHeader);
        }
    }
    header_line_ = lines_.line();
    if (first_skipped > 0) {
        note(first_skipped,
             fmt::format("blank or comment lines before the header, which is line {}: skipped",
                         header_line_));
    }
    if (title > 0) {
        note(title,
             fmt::format("a title before the header, which is line {}: skipped", header_line_));
    }
    return {};
}

Expected<bool> CsvTable::takes_separator(std::string_view line) {
    constexpr std::string_view kKey = "sep=";
    if (line.starts_with('"')) {
        line.remove_prefix(1);
    }
    if (lower_case(line.substr(0, kKey.size())) != kKey) {
        return false;
    }
    line.remove_prefix(kKey.size());
    const char named = line.empty() ? '\0' : line.front();
    // Programs that saw a table in it add separators, or a closing quote.
    if (std::any_of(line.begin(), line.end(),
                    [=](char c) { return c != named && c != '"' && c != ' '; })) {
        return false;
    }
    if (named == '\0' || kSeparators.find(named) == std::string_view::npos) {
        return lines_.error_here(
            "'sep=' names no separator that is known: use , ; | or a tab, or remove the line");
    }
    separator_ = named;
    note(lines_.line(), "a line 'sep=' before the header: its separator is used");
    return true;
}

Expected<void> CsvTable::read_header() {
    const std::string_view line = lines_.text();
    if (separator_ == '\0') {
        std::size_t most = 0;
        separator_ = ',';
        for (const char candidate : kSeparators) {
            const std::size_t count = count_outside_quotes(line, candidate);
            if (count > most) {
                most = count;
                separator_ = candidate;
            }
        }
    }
    if (const LineCells::Problem problem = cells_.split(line, separator_);
        problem != LineCells::Problem::None) {
        return lines_.error_here(said(problem));
    }
    if (cells_.had_quotes()) {
        seen_quotes_ = true;
        note(lines_.line(), "cells in double quotes: read without them");
    }
    return take_header(cells_.cells());
}

Expected<void> CsvTable::take_header(std::span<const std::string_view> names) {
    for (const std::string_view cell : names) {
        const std::size_t at = header_.size();
        const bool is_new = column_of_.try_emplace(std::string{cell}, at).second;
        if (!is_new && !cell.empty()) {
            return lines_.error_here(
                fmt::format("column {} occurs twice: rename or remove one", shown(cell)));
        }
        for (auto* const columns : {&column_of_lower_case_, &column_of_unitless_}) {
            const std::string_view name = columns == &column_of_unitless_ ? apart(cell).name : cell;
            const auto [other, is_only] = columns->try_emplace(lower_case(name), at);
            if (!is_only) {
                other->second = kNowhere;
            }
        }
        header_.emplace_back(cell);
    }
    return {};
}

std::size_t CsvTable::find(std::string_view column_name) const {
    if (const auto exactly = column_of_.find(column_name); exactly != column_of_.end()) {
        return exactly->second;
    }
    if (column_name.ends_with(kAnyUnit)) {
        column_name.remove_suffix(kAnyUnit.size());
        const auto unitless = column_of_unitless_.find(lower_case(column_name));
        return unitless != column_of_unitless_.end() ? unitless->second : kNowhere;
    }
    const auto in_other_case = column_of_lower_case_.find(lower_case(column_name));
    return in_other_case != column_of_lower_case_.end() ? in_other_case->second : kNowhere;
}

bool CsvTable::has(std::string_view column_name) const { return find(column_name) != kNowhere; }

std::vector<std::string_view> CsvTable::missing(std::span<const std::string_view> columns) const {
    std::vector<std::string_view> absent;
    std::copy_if(columns.begin(), columns.end(), std::back_inserter(absent),
                 [&](std::string_view column) { return !has(column); });
    return absent;
}

std::optional<std::size_t> CsvTable::column(std::string_view column_name) {
    const std::size_t at = find(column_name);
    if (at == kNowhere) {
        return std::nullopt;
    }
    if (header_[at] != column_name && !column_name.ends_with(kAnyUnit) &&
        std::find(in_other_case_.begin(), in_other_case_.end(), header_[at]) ==
            in_other_case_.end()) {
        in_other_case_.push_back(header_[at]);
    }
    return at;
}

void CsvTable::note_missing(std::span<const std::string_view> names, std::string_view what) {
    const std::vector<std::string_view> absent = missing(names);
    if (absent.size() < names.size()) {
        note(header_line_,
             fmt::format("{}: not read, for want of the column '{}'", what,
                         fmt::join(absent, "', '")),
             gaze::TraceFindingKind::NotRead);
    }
}

void CsvTable::take_width_from_first_row() {
    width_ = header_.size();
    if (cells_.size() == width_ + 1 && cells_[width_].empty()) {
        ++width_;
        note(lines_.line(), "rows end with a separator, the header does not: read without it");
    } else if (cells_.size() + 1 == width_ && header_.back().empty()) {
        --width_;
        note(header_line_, "the header ends with a separator, rows do not: read without it");
    }
}

Expected<bool> CsvTable::next() {
    while (true) {
        const Expected<bool> any = lines_.next();
        if (!any || !*any) {
            return any;
        }
        if (trimmed(lines_.text()).empty()) {
            continue;
        }
        const LineCells::Problem problem = cells_.split(lines_.text(), separator_);
        if (width_ == 0) {
            take_width_from_first_row();
        }
        const bool is_short = problem == LineCells::Problem::OpenQuote ||
                              (problem == LineCells::Problem::None && cells_.size() < width_);
        if (is_short && !lines_.ended()) {
            cut_line_ = lines_.line();
            return false;
        }
        if (problem != LineCells::Problem::None) {
            return lines_.error_here(said(problem));
        }
        if (cells_.size() != width_) {
            return lines_.error_here(
                fmt::format("{} columns, the header has {}: mend or remove the line{}",
                            cells_.size(), header_.size(),
                            separator_ == ',' && cells_.size() > width_
                                ? "; numbers with decimal commas need ';' between them, or quotes"
                                : ""));
        }
        if (!lines_.ended()) {
            note(lines_.line(),
                 "the last line has no end: were it cut short within its last "
                 "number, nobody could tell; it is used");
        }
        if (cells_.had_quotes() && !seen_quotes_) {
            seen_quotes_ = true;
            note(lines_.line(), "cells in double quotes: read without them");
        }
        return true;
    }
}

std::optional<std::int64_t> CsvTable::whole(std::size_t column) {
    NumberSpelling seen;
    const std::optional<std::int64_t> value = whole_number(cells_[column], seen);
    note(seen);
    return value;
}

std::optional<std::uint64_t> CsvTable::count(std::size_t column) {
    NumberSpelling seen;
    const std::optional<std::uint64_t> value = count_number(cells_[column], seen);
    note(seen);
    return value;
}

std::optional<std::int64_t> CsvTable::decimal(std::size_t column, int digits) {
    NumberSpelling seen;
    const std::optional<std::int64_t> value = decimal_number(cells_[column], digits, seen);
    note(seen);
    return value;
}

std::optional<bool> CsvTable::truth(std::size_t column) {
    const std::optional<bool> yes = truth_of(cells_[column]);
    const char first = cells_[column].empty() ? '\0' : cells_[column].front();
    if (yes && !seen_truth_in_words_ && first != '0' && first != '1') {
        seen_truth_in_words_ = true;
        note(lines_.line(), fmt::format("{}: words for 1 and 0: read as these", described(column)));
    }
    return yes;
}

std::string_view CsvTable::unit(std::size_t column) const { return apart(header_[column]).unit; }

std::string CsvTable::quoted(std::size_t column) const { return shown(cells_[column]); }

std::string CsvTable::described(std::size_t column) const {
    return fmt::format("column '{}': {}", header_[column], shown(cells_[column]));
}

void CsvTable::note(std::uint64_t line, std::string text, gaze::TraceFindingKind kind) {
    notes_.push_back({.kind = kind, .line = line, .text = std::move(text)});
}

void CsvTable::note(const NumberSpelling& seen) {
    if (seen.decimal_comma && !seen_.decimal_comma) {
        seen_.decimal_comma = true;
        note(lines_.line(), "decimal commas: read as points");
    }
    if (seen.minus_sign && !seen_.minus_sign) {
        seen_.minus_sign = true;
        note(lines_.line(), "minus signs (U+2212): read as '-'");
    }
    if (seen.whole_as_real && !seen_.whole_as_real) {
        seen_.whole_as_real = true;
        note(lines_.line(), "whole numbers with zeros behind a point: read without them");
    }
}

void CsvTable::report_to(gaze::TraceReport& report) const {
    lines_.report_to(report);
    for (const gaze::TraceFinding& finding : notes_) {
        report.add(finding);
    }
    if (!in_other_case_.empty()) {
        report.add({.kind = gaze::TraceFindingKind::Text,
                    .line = header_line_,
                    .text = fmt::format("column names in another case: {} ({} in all)",
                                        shown(in_other_case_.front()), in_other_case_.size())});
    }
    if (cut_line_ > 0) {
        report.rows += 1;
        report.add({.kind = gaze::TraceFindingKind::CutRow,
                    .line = cut_line_,
                    .rows = 1,
                    .dropped = 1,
                    .text = "the last line was not finished: it is not used"});
    }
}

}  // namespace gazeloop::drivers
