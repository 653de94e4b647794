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

/// What a row may leave out, which is only worth a word where other rows have it.
enum class RowDetail : std::uint8_t {
    LeftOrigin,
    LeftOpenness,
    LeftConfidence,
    RightOrigin,
    RightOpenness,
    RightConfidence,
    Head,
    Sequence,
    Arrival,
};
inline constexpr std::size_t kRowDetails = 9;

[[nodiscard]] constexpr RowDetail origin_of(gaze::Eye eye) {
    return eye == gaze::Eye::Left ? RowDetail::LeftOrigin : RowDetail::RightOrigin;
}
[[nodiscard]] constexpr RowDetail openness_of(gaze::Eye eye) {
    return eye == gaze::Eye::Left ? RowDetail::LeftOpenness : RowDetail::RightOpenness;
}
[[nodiscard]] constexpr RowDetail confidence_of(gaze::Eye eye) {
    return eye == gaze::Eye::Left ? RowDetail::LeftConfidence : RowDetail::RightConfidence;
}

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
        counts_[static_cast<std::size_t>(part)].add(line, what);
    }

    /// The same of an eye, where the cell is neither blank nor a mark of a loss: whoever wrote it
    /// meant something that is not understood.
    template <typename What>
    void add_not_understood(gaze::Eye eye, std::uint64_t line, const What& what) {
        add(direction_of(eye), line, what);
        not_understood_line_ = line;
    }
    /// Whether that was so of an eye in this line, the latest.
    [[nodiscard]] bool not_understood_at(std::uint64_t line) const {
        return not_understood_line_ == line;
    }

    /// A row has this.
    void has(RowDetail detail) { details_[static_cast<std::size_t>(detail)].known = true; }
    /// A row has not, for `what`: "column 'x': 'NaN'". Reported where another row has.
    template <typename What>
    void lacks(RowDetail detail, std::uint64_t line, const What& what) {
        details_[static_cast<std::size_t>(detail)].unknown.add(line, what);
    }

    /// Adds a finding for each part and detail that is concerned.
    void report_to(gaze::TraceReport& report) const;

  private:
    struct Count {
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
        std::uint64_t last_line = 0;
        std::string first;

        template <typename What>
        void add(std::uint64_t line, const What& what) {
            if (rows == 0 || line < first_line) {
                first_line = line;
                first = what();
            }
            rows += last_line == line ? 0U : 1U;
            last_line = line;
        }
    };
    struct Detail {
        bool known = false;  ///< in any row
        Count unknown;
    };
    std::array<Count, kRowParts> counts_;
    std::array<Detail, kRowDetails> details_;
    std::uint64_t not_understood_line_ = 0;
};

}  // namespace gazeloop::drivers
