#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "runtime/gaze/eye.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// What of a row is lost by a cell that cannot be read.
enum class RowPart : std::uint8_t {
    LeftDirection,
    RightDirection,
    LeftOther,  ///< origin, openness, confidence
    RightOther,
    Head,
    Other,  ///< sequence number, arrival
};
inline constexpr std::size_t kRowParts = 6;

[[nodiscard]] constexpr RowPart direction_of(gaze::Eye eye) {
    return eye == gaze::Eye::Left ? RowPart::LeftDirection : RowPart::RightDirection;
}
[[nodiscard]] constexpr RowPart other_of(gaze::Eye eye) {
    return eye == gaze::Eye::Left ? RowPart::LeftOther : RowPart::RightOther;
}

/// Counts, over a whole file, the rows of which a part cannot be used because of its cells. It
/// keeps what was wrong with the first.
class BadCells {
  public:
    /// `what` says what is wrong: "column 'x': 'abc' is no number". It is called for the first
    /// only.
    template <typename What>
    void add(RowPart part, std::uint64_t line, const What& what) {
        Count& count = counts_[static_cast<std::size_t>(part)];
        if (count.rows == 0) {
            count.first_line = line;
            count.first = what();
        }
        count.rows += count.last_line == line ? 0U : 1U;
        count.last_line = line;
    }

    /// Adds a finding for each part that is concerned.
    void report_to(gaze::TraceReport& report) const;

  private:
    struct Count {
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
        std::uint64_t last_line = 0;
        std::string first;
    };
    std::array<Count, kRowParts> counts_;
};

}  // namespace gazeloop::drivers
