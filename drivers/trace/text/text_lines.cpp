#include "drivers/trace/text/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "drivers/trace/text/file_kind.h"

namespace gazeloop::drivers {

namespace {

/// The first byte from `at` on that is below a space, or `end`; eight bytes at a time.
std::size_t first_control(std::span<const char> bytes, std::size_t at, std::size_t end) {
    constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101;
    constexpr std::uint64_t kHighBits = 0x80 * kOnes;
    for (; at + sizeof(std::uint64_t) <= end; at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof(word));
        // A byte below ' ' borrows into its high bit, which a byte of 128 or more has already.
        if (((word - ' ' * kOnes) & ~word & kHighBits) != 0) {
            break;
        }
    }
    while (at != end && static_cast<unsigned char>(bytes[at]) >= ' ') {
        ++at;
    }
    return at;
}

}  // namespace

TextLines::TextLines(std::istream& in, std::string name)
    // Twice the longest, so that little is moved when more is read behind a part of a line.
    : bytes_(in), name_(std::move(name)), buffer_(2 * (kLongestLine + 1)) {}

Expected<bool> TextLines::next() {
    if (std::exchange(held_, false)) {
        return any_;
    }
    const Expected<bool> any = read_line();
    any_ = any.value_or(false);
    return any;
}

Expected<bool> TextLines::read_line() {
    ++line_;
    std::size_t at = begin_;  // the first byte that was not looked at
    while (true) {
        if (after_cr_ && begin_ != end_) {
            after_cr_ = false;
            if (buffer_[begin_] == '\n') {
                at = ++begin_;
            } else if (lone_cr_line_ == 0) {
                lone_cr_line_ = line_ - 1;
            }
        }
        for (; at != end_; ++at) {
            at = first_control(buffer_, at, end_);
            if (at == end_) {
                break;
            }
            const auto c = static_cast<unsigned char>(buffer_[at]);
            if (c == '\t') {
                continue;
            }
            if (c != '\n' && c != '\r') {
                return error_here(fmt::format(
                    "not a text file (a byte {:#04x}): export the table as CSV; if it is text "
                    "up to here, the file was damaged, and can be cut here",
                    c));
            }
            text_ = std::string_view{buffer_.data() + begin_, at - begin_};
            begin_ = at + 1;
            bytes_taken_ += text_.size() + 1;
            after_cr_ = c == '\r';
            ended_ = true;
            break;
        }
        const bool found = at != end_;
        if ((found ? text_.size() : at - begin_) > kLongestLine) {
            return error_here(fmt::format(
                "longer than {} bytes: no table of gaze; export it as CSV, one row per line",
                kLongestLine));
        }
        if (found) {
            return true;
        }
        at -= begin_;
        const Expected<bool> more = fill();
        if (!more) {
            return more;
        }
        at += begin_;
        if (!*more) {
            text_ = std::string_view{buffer_.data() + begin_, end_ - begin_};
            begin_ = end_;
            ended_ = false;
            return !text_.empty();
        }
    }
}

Expected<bool> TextLines::fill() {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
    // At first as much as it takes to know what kind of file it is.
    constexpr std::size_t kLookedAt = 512;
    std::size_t filled = 0;
    do {
        const auto read = bytes_.read(std::span{buffer_}.subspan(end_));
        if (!read) {
            return error_here(read.error());
        }
        filled = *read;
        end_ += filled;
    } while (!started_ && filled > 0 && end_ < kLookedAt);
    const bool was_first = !std::exchange(started_, true);
    if (was_first) {
        const std::string_view start{buffer_.data(), end_};
        if (const std::string_view kind = kind_of_no_table(start); !kind.empty()) {
            return error_here(kind);
        }
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (start.starts_with(kByteOrderMark)) {
            begin_ = kByteOrderMark.size();
        }
    }
    return begin_ != end_ && (filled > 0 || was_first);
}

std::optional<std::uint64_t> TextLines::lines_ahead() {
    const std::optional<std::uint64_t> left = bytes_.bytes_left();
    if (!left || bytes_taken_ == 0) {
        return std::nullopt;
    }
    const auto bytes = static_cast<double>(*left + (end_ - begin_));
    return static_cast<std::uint64_t>(bytes * static_cast<double>(line_) /
                                      static_cast<double>(bytes_taken_));
}

std::unexpected<Error> TextLines::error_here(std::string_view message) const {
    return std::unexpected(
        Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", name_, line_, message)});
}

void TextLines::report_to(gaze::TraceReport& report) const {
    if (bytes_.is_gzip()) {
        report.add({.kind = gaze::TraceFindingKind::Text, .text = "gzip: decompressed"});
    }
    if (lone_cr_line_ > 0) {
        report.add({.kind = gaze::TraceFindingKind::Text,
                    .line = lone_cr_line_,
                    .text = "lines end with a lone CR, as old Macs wrote them"});
    }
}

}  // namespace gazeloop::drivers
