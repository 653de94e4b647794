#include "runtime/latency/budget_event.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/time/milliseconds.h"

namespace gazeloop::latency {

FixedText<240> text_of(const BudgetEvent& event, std::string_view budget) {
    const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) / time::kNsPerMs; };
    std::array<char, 480> text{};
    char* end = fmt::format_to_n(text.data(), 240, "{} {} {:.2f} ms: p95 {:.2f} ms",
                                 kMonitorPartNames[event.part],
                                 event.broken ? "above the allowed" : "within the allowed",
                                 ms(event.limit_ns), ms(event.p95_ns))
                    .out;
    if (!event.broken) {
        end = fmt::format_to_n(end, 60, ", after {:.1f} s", ms(event.lasted_ns) / 1e3).out;
    }
    end = fmt::format_to_n(end, 80, " ({} frames of the last {:.1f} s; budget ", event.frames,
                           ms(event.window_ns) / 1e3)
              .out;
    const std::string_view name = budget.substr(0, 90);
    end = fmt::format_to_n(end, 92, "{})", name).out;
    return FixedText<240>({text.data(), static_cast<std::size_t>(end - text.data())});
}

}  // namespace gazeloop::latency
