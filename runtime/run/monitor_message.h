#pragma once

#include <string_view>
#include <variant>

#include "runtime/fixed_text.h"
#include "runtime/latency/monitor_snapshot.h"

namespace gazeloop::run {

/// What happened, as a FrameObserver is told.
struct MonitorEvent {
    time::Stamp time;
    FixedText<32> kind;
    FixedText<240> text;
};

/// What the loop hands to the monitor's thread.
struct MonitorMessage {
    enum class What {
        Interval,  ///< for a line of JSON
        Picture,   ///< for the panel alone
        End,       ///< the last one: for both
    };
    What what = What::Interval;
    latency::MonitorSnapshot snapshot{};
};

using MonitorRecord = std::variant<MonitorMessage, MonitorEvent>;

}  // namespace gazeloop::run
