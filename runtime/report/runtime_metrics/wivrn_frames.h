#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/error.h"
#include "runtime/report/runtime_metrics/wivrn_csv_reader.h"

namespace gazeloop::report {

/// The events of one frame of WiVRn's compositor: of one video stream, or of the frame.
class WivrnTimes {
  public:
    [[nodiscard]] std::optional<std::int64_t> operator[](WivrnEvent event) const {
        const std::int64_t ns = ns_[static_cast<std::size_t>(event)];
        return ns == kNone ? std::nullopt : std::optional(ns);
    }
    /// Of several times of one event, what ends counts last, and the rest first: a frame is shown
    /// when it is shown first.
    void add(WivrnEvent event, std::int64_t ns);

  private:
    static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
    std::array<std::int64_t, kWivrnEventCount> ns_ = [] {
        std::array<std::int64_t, kWivrnEventCount> none{};
        none.fill(kNone);
        return none;
    }();
};

struct WivrnFrame {
    /// More video streams than WiVRn has (left, right, transparency).
    static constexpr std::size_t kMostStreams = 4;

    std::optional<std::uint64_t> number{};  ///< none: the place is free
    WivrnTimes of_frame{};
    std::array<WivrnTimes, kMostStreams> streams{};
    bool joined = false;

    /// Of all streams together: what begins with the first one, what ends with the last one. It is
    /// blitted and displayed with the last one of those that were.
    [[nodiscard]] WivrnTimes together() const;
    /// Of one stream, with what is stamped of the frame. Precondition: below kMostStreams.
    [[nodiscard]] WivrnTimes of_stream(std::size_t stream) const;
};

/// The frames of a WiVRn timing file near a time that goes on; memory is bounded.
class WivrnFrames {
  public:
    static constexpr std::size_t kKept = 1024;

    explicit WivrnFrames(WivrnCsvReader file);

    /// Reads on until the file's rows are from after this time (host time), which never goes back
    /// by much. A few absurd times among them change nothing. Errors: those of the file.
    [[nodiscard]] Expected<void> read_until(std::int64_t until_ns);

    /// The frame whose first display is nearest to this time; null where none is within
    /// `tolerance_ns`.
    [[nodiscard]] WivrnFrame* nearest(std::int64_t display_ns, std::int64_t tolerance_ns);

    [[nodiscard]] const WivrnCsvReader& file() const { return file_; }
    [[nodiscard]] std::optional<std::int64_t> first_ns() const { return first_ns_; }
    [[nodiscard]] std::optional<std::int64_t> last_ns() const { return last_ns_; }
    /// Rows of streams beyond the most that are kept apart.
    [[nodiscard]] std::uint64_t other_streams() const { return other_streams_; }

  private:
    void take(const WivrnRow& row);

    WivrnCsvReader file_;
    bool at_end_ = false;
    std::optional<std::int64_t> first_ns_;
    std::optional<std::int64_t> last_ns_;
    std::uint64_t other_streams_ = 0;
    std::vector<WivrnFrame> frames_;  ///< by number modulo size
    std::vector<std::int64_t>
        display_ns_;  ///< of each, of its first display; apart, to be searched
};

}  // namespace gazeloop::report
