#include "runtime/run/event_log.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <string>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::run {

void EventLog::on_event(time::Stamp time, std::string_view kind, std::string_view text) {
    constexpr std::int64_t kWindow_ns = 10'000'000'000;
    constexpr std::uint64_t kMostInWindow = 3;
    const frame::EventWeight weight = frame::weight_of(kind);
    if (weight == frame::EventWeight::Routine) {
        spdlog::debug("{}: {}", kind, text);
        return;
    }
    Said& said = said_[happenings_.add(time, kind, text)];
    const std::int64_t now_ns = time::monotonic_ns();
    if (said.in_window == 0 || now_ns - said.window_begin_ns >= kWindow_ns) {
        said.window_begin_ns = now_ns;
        said.in_window = 0;
    }
    if (said.in_window == kMostInWindow) {
        ++said.unsaid;
        return;
    }
    ++said.in_window;
    const std::uint64_t unsaid = std::exchange(said.unsaid, 0);
    spdlog::log(weight == frame::EventWeight::Warning ? spdlog::level::warn : spdlog::level::info,
                "{}: {}{}", kind, text,
                unsaid > 0 ? fmt::format(" (and {} times more since the last such line)", unsaid)
                           : std::string());
}

}  // namespace gazeloop::run
