#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/trace/text/line_cells.h"
#include "drivers/trace/text/text_lines.h"
#include "runtime/error.h"

namespace gazeloop::report {

/// What WiVRn stamps of a frame of its compositor, in the order in which it happens. From
/// ReceiveBegin on the headset stamps it; WiVRn writes such times in the server's clock.
enum class WivrnEvent : std::size_t {
    WakeUp,
    Begin,   ///< the compositor begins
    Submit,  ///< of older versions
    EncodeBegin,
    EncodeEnd,
    SendBegin,
    SendEnd,
    ReceiveBegin,  ///< the first packet
    ReceiveEnd,
    DecodeBegin,
    DecodeEnd,
    Blit,     ///< each time that the headset draws it
    Display,  ///< when the headset's own runtime predicted, at Blit, that it is displayed
};
inline constexpr std::size_t kWivrnEventCount = 13;
inline constexpr std::array<std::string_view, kWivrnEventCount> kWivrnEventNames{
    "wake_up",    "begin",    "submit",        "encode_begin", "encode_end",
    "send_begin", "send_end", "receive_begin", "receive_end",  "decode_begin",
    "decode_end", "blit",     "display"};

/// One row of a WiVRn timing file.
struct WivrnRow {
    WivrnEvent event = WivrnEvent::WakeUp;
    std::uint64_t frame = 0;               ///< of WiVRn's compositor
    std::int64_t ns = 0;                   ///< CLOCK_MONOTONIC of the server
    std::optional<std::uint8_t> stream{};  ///< of the video; none: of the frame as a whole
};

/// What became of a file's rows.
struct WivrnFileCounts {
    std::uint64_t rows = 0;     ///< that were read
    std::uint64_t unknown = 0;  ///< of events that are not known here
    std::uint64_t untimed = 0;  ///< without a time, or a frame, which WiVRn writes as 0 or below
    std::uint64_t bad = 0;      ///< rows of another form
    std::uint64_t first_bad_line = 0;  ///< meaningful where there are some
    bool cut = false;                  ///< the last line has no end, and is left out
};

/// Reads the file that WIVRN_DUMP_TIMINGS names, row by row, in fixed memory: event, frame, time in
/// ns, stream (255: none), further cells that are not used. A header line may be there; the file
/// may be gzip.
class WivrnCsvReader {
  public:
    /// Errors (BadInput, with file, line and remedy): a file that cannot be opened, is empty or
    /// does not begin like such a file.
    static Expected<WivrnCsvReader> open(const std::filesystem::path& file);
    /// The same of a stream; `name` stands in messages.
    static Expected<WivrnCsvReader> open(std::unique_ptr<std::istream> in, std::string name);

    /// The next row that is of use; none at the end. Errors (BadInput, with file, line and remedy):
    /// bytes that are no text.
    [[nodiscard]] Expected<std::optional<WivrnRow>> next();

    [[nodiscard]] const std::string& name() const { return lines_->name(); }
    /// Of what was read so far.
    [[nodiscard]] const WivrnFileCounts& counts() const { return counts_; }

  private:
    WivrnCsvReader(std::unique_ptr<std::istream> in, std::string name);

    enum class Form : std::uint8_t { Row, Header, NoRow };
    /// What the current line is; a row's cells are then in cells_.
    [[nodiscard]] Form form_of_line();
    [[nodiscard]] std::optional<WivrnRow> row_of_cells();

    std::unique_ptr<std::istream> in_;
    std::unique_ptr<drivers::TextLines> lines_;  ///< on the heap, so that this may be moved
    std::unique_ptr<drivers::LineCells> cells_;
    WivrnFileCounts counts_;
    std::optional<Form> first_;  ///< of the first line, until next() takes it
};

}  // namespace gazeloop::report
