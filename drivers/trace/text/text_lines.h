#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/trace/text/byte_stream.h"
#include "runtime/error.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// The lines of a text file, one after the other; the file may be of any size, and gzip. Lines end
/// with LF, CRLF or, as old Macs wrote them, a lone CR. A UTF-8 byte order mark is ignored.
///
/// Every error is BadInput and says "NAME:LINE: what, and what to do".
class TextLines {
  public:
    /// The longest line that is read, in bytes without its end.
    static constexpr std::size_t kLongestLine = 65'536;

    /// `in` must outlive this; `name` stands in messages.
    TextLines(std::istream& in, std::string name);

    /// Goes to the next line; false at the end. Errors: a line that is too long, bytes that are no
    /// text, a file that is known as something else (file_kind.h) or cannot be decompressed.
    [[nodiscard]] Expected<bool> next();

    /// The next call of next() gives the same once more: for whoever looks what a file is. After a
    /// call that gave no error.
    void hold() { held_ = true; }

    /// The line without its end; until the next one is asked for.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// Whether the line has an end: the last line of a file may not.
    [[nodiscard]] bool ended() const { return ended_; }
    [[nodiscard]] std::uint64_t line() const { return line_; }  ///< from 1
    [[nodiscard]] const std::string& name() const { return name_; }

    /// About how many lines follow, were they as long as those before; none where nobody knows how
    /// much of the file is left.
    [[nodiscard]] std::optional<std::uint64_t> lines_ahead();

    [[nodiscard]] std::unexpected<Error> error_here(std::string_view message) const;

    /// Adds what was read although it is not usual.
    void report_to(gaze::TraceReport& report) const;

  private:
    [[nodiscard]] Expected<bool> read_line();
    /// Reads on behind what is in the buffer, whose used part is given up: false at the end.
    [[nodiscard]] Expected<bool> fill();

    ByteStream bytes_;
    std::string name_;
    std::vector<char> buffer_;  // never resized: text_ points into it
    std::size_t begin_ = 0;     ///< of what no line has taken yet
    std::size_t end_ = 0;
    bool after_cr_ = false;  ///< the line before ended with CR, and what follows was not looked at
    bool started_ = false;
    bool ended_ = false;
    bool held_ = false;  ///< the line, or that there is none, is to be given once more
    bool any_ = false;   ///< what the last call of next() gave
    std::string_view text_;
    std::uint64_t bytes_taken_ = 0;  ///< by the lines so far, with their ends
    std::uint64_t line_ = 0;
    std::uint64_t lone_cr_line_ = 0;  ///< the first that ended so; 0: none
};

}  // namespace gazeloop::drivers
