#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "runtime/report/perfetto/trace_event.h"

namespace gazeloop::report::perfetto {

/// What the trace's times are.
enum class TraceClock : std::uint8_t {
    Monotonic,  ///< CLOCK_MONOTONIC
    Own,        ///< of no clock of a machine: they count from 0
};

/// Writes a native Perfetto trace, packet by packet, in memory that its length does not change.
///
/// All packets are of one sequence, whose first one clears its state, so that texts may be named by
/// number. With Monotonic that packet is a ClockSnapshot which makes CLOCK_MONOTONIC the trace's
/// clock and the sequence's default. No other clock stands beside it, since a session does not know
/// what BOOTTIME was: to say that they are equal is false once the machine has slept. With Own
/// there is neither, and readers take the times as they are.
class TraceWriter {
  public:
    using Sink = std::function<void(std::string_view)>;

    /// `sink` takes the file's bytes, piece by piece; what it throws passes through.
    TraceWriter(TraceClock clock, Sink sink);

    NameId name(std::string_view text);
    KeyId key(std::string_view text);
    TextId text(std::string_view text);

    /// To be added before its events.
    void add(const TrackDescription& track);
    /// Precondition: drawable_time(event.ns). Events of one track come in the order of their times,
    /// and slices within it nest.
    void add(const TraceEvent& event);

    /// Hands over what is left. A trace without events is one, too.
    void finish();

    /// Of the file so far.
    [[nodiscard]] std::uint64_t bytes() const { return handed_over_ + buffer_.size(); }

  private:
    using Table = std::map<std::string, std::uint64_t, std::less<>>;

    std::uint64_t intern(Table& table, std::uint32_t field, std::string_view text);
    void start(std::int64_t first_ns);
    void hand_over();

    TraceClock clock_;
    Sink sink_;
    std::string buffer_;
    bool started_ = false;
    std::uint64_t handed_over_ = 0;
    Table names_;
    Table keys_;
    Table texts_;
};

}  // namespace gazeloop::report::perfetto
