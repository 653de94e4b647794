#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/gaze/eye.h"

namespace gazeloop::gaze {

/// What a reader of traces found in a file and did about it. "Row" is a row of the file.
enum class TraceFindingKind : std::uint8_t {
    // Rows or eyes that are not used.
    TimeOutlier,     ///< a time that neither neighbour agrees with: the row is dropped
    Repeat,          ///< the same report once more: the row is dropped
    BadTime,         ///< a row without a readable time: it is dropped, or the host's time is taken
    BadCells,        ///< a cell of a valid eye that is no number: that eye of that row is invalid
    CutRow,          ///< a last line that was not finished: it is dropped
    RefusedByBit,    ///< an eye that the tracker's own validity bits do not vouch for
    OtherRecording,  ///< rows of another recording in the same file: they are left out
    NotRead,  ///< an eye, its place, the head or a file beside it, of which something is missing
    // Times that are not as the file has them.
    CounterWrapped,   ///< a clock of limited width began anew from 0: it is counted on
    DeviceClockSet,   ///< the device's clock was set: times go on by the host's clock or the rate
    HostClockSet,     ///< the host's clock was set, or slept: the clocks are fitted anew
    HostTimeOutlier,  ///< a host time that neither neighbour agrees with: it is left out
    ClockStoodStill,  ///< a clock stood: times go on by the other one or the rate
    ClockRates,       ///< the clocks go at rates that are no two crystals': a unit may be wrong
    OddTimes,         ///< times that no eye tracker has, or other than is said elsewhere
    CoarseTimes,      ///< several rows with one time: spread over the clock's step, in their order
    OutOfOrder,       ///< rows in another order than their times: put in order
    SequenceRestarted,  ///< the sequence number wrapped or began anew
    SequenceOutlier,    ///< a sequence number that neither neighbour agrees with
    GapShortened,       ///< longer without a row than is played: played shorter
    // Where the gaze points.
    BehindHead,  ///< an eye that looks behind the head: that eye of that row is invalid
    Axes,        ///< directions that no pair of eyes has, or were corrected on request
    NewOrigin,   ///< the head's pose jumps as no head moves: its origin is another from here
    // The file.
    Text,  ///< quotes, 'sep=', decimal commas and the like, that were read all the same
};
inline constexpr std::array<std::string_view, 24> kTraceFindingNames{
    "time outlier",      "repeat",
    "bad time",          "bad cells",
    "cut row",           "refused by bit",
    "other recording",   "not read",
    "counter wrapped",   "device clock set",
    "host clock set",    "host time outlier",
    "clock stood still", "clock rates",
    "odd times",         "coarse times",
    "out of order",      "sequence restarted",
    "sequence outlier",  "gap shortened",
    "behind head",       "axes",
    "new origin",        "text"};
inline constexpr std::size_t kTraceFindingKinds = kTraceFindingNames.size();
static_assert(kTraceFindingNames[static_cast<std::size_t>(TraceFindingKind::Text)] == "text" &&
              kTraceFindingKinds == static_cast<std::size_t>(TraceFindingKind::Text) + 1);

/// One thing that was found, perhaps in many rows.
struct TraceFinding {
    TraceFindingKind kind{};
    std::uint64_t line = 0;     ///< of the first row concerned; 0: the file as a whole
    std::uint64_t rows = 0;     ///< concerned
    std::uint64_t dropped = 0;  ///< of them, rows that are not used
    std::int64_t span_ns = 0;   ///< of recorded time concerned, or by how much a clock was set
    std::string text;  ///< what was done, without file and line: "steps back by 900 s; ..."
};

/// How many, over the whole file.
struct TraceFindingCount {
    std::uint64_t times = 0;  ///< findings
    std::uint64_t rows = 0;
    std::uint64_t dropped = 0;
    std::int64_t span_ns = 0;
};

/// What the reader of a trace thinks of it. Everything that is not used, or not as the file has it,
/// is in here.
class TraceReport {
  public:
    /// Findings of one kind that are kept in full; later ones are counted.
    static constexpr std::size_t kKeptOfEachKind = 8;

    void add(TraceFinding finding);

    [[nodiscard]] const std::vector<TraceFinding>& findings() const { return findings_; }
    [[nodiscard]] const TraceFindingCount& count(TraceFindingKind kind) const {
        return counts_[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] std::uint64_t rows_dropped() const;

    /// Whether more than 1 % of the rows or 1 s of time are concerned by what was dropped or
    /// changed, rows of another recording or a part of the file were left out, or times or where
    /// the gaze points are in doubt.
    [[nodiscard]] bool worth_a_warning() const;

    std::uint64_t rows = 0;  ///< of the file, after its header, used or not
    /// By gaps in the sequence numbers; none where there are no numbers, or they do not count.
    std::optional<std::uint64_t> lost_by_tracker;
    double rate_hz = 0.0;             ///< sample_rate.h; 0: fewer than two rows
    std::int64_t longest_gap_ns = 0;  ///< between samples, as recorded
    std::string clock;  ///< one line: "device, fitted to the host's: +148 ppm, within 0.2 ms"
    std::string axes;   ///< one line: "agree with anatomy", "both eyes diverge: ..."
    PerEye<std::uint64_t> valid{};  ///< samples with that eye valid

  private:
    std::vector<TraceFinding> findings_;
    std::array<TraceFindingCount, kTraceFindingKinds> counts_{};
};

}  // namespace gazeloop::gaze
