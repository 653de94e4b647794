#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runtime/fixed_text.h"
#include "runtime/frame/event.h"
#include "runtime/latency/monitor_snapshot.h"
#include "runtime/time/stamp.h"

namespace gazeloop::latency {

/// A part of the budget that has been broken, or is kept again: see BudgetMonitor.
struct BudgetEvent {
    time::Stamp time;  ///< the frame that decided it was handed to the compositor
    std::size_t part = kAgePart;
    bool broken = false;         ///< else kept again
    std::int64_t p95_ns = 0;     ///< of the window
    std::int64_t limit_ns = 0;   ///< of the part
    std::uint64_t frames = 0;    ///< of the window, that know the part
    std::int64_t window_ns = 0;  ///< see MonitorSnapshot
    std::int64_t lasted_ns = 0;  ///< kept again: since it was broken

    [[nodiscard]] const frame::EventKind& kind() const {
        return broken ? frame::kBudgetBrokenEvent : frame::kBudgetKeptEvent;
    }
};

/// What a user reads of it; of one part and budget always the same but for numbers. Allocates
/// nothing.
[[nodiscard]] FixedText<240> text_of(const BudgetEvent& event, std::string_view budget);

}  // namespace gazeloop::latency
