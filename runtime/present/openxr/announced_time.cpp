#include "runtime/present/openxr/announced_time.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "runtime/time/span.h"

namespace gazeloop::present {
namespace {

constexpr std::int64_t kFarFromNow_ns = 1'000'000'000;
constexpr int kNewLine = 3;

// A display of 10 kHz to 1 Hz.
constexpr std::int64_t kShortestPeriod_ns = 100'000;
constexpr std::int64_t kLongestPeriod_ns = 1'000'000'000;

std::int64_t difference_ns(std::int64_t to, std::int64_t from) {
    return time::saturated(static_cast<__int128>(to) - from);
}

}  // namespace

AnnouncedTime::Oddity AnnouncedTime::judge(std::optional<std::int64_t> display_ns,
                                           std::int64_t now_ns) {
    if (!display_ns) {
        grown_ahead_ = 0;
        return Oddity::None;
    }
    const auto before_ns = std::exchange(before_ns_, display_ns);
    const std::int64_t ahead_ns = difference_ns(*display_ns, now_ns);
    if (ahead_ns > kFarFromNow_ns || ahead_ns < -kFarFromNow_ns) {
        grown_ahead_ = 0;
        return ahead_ns > 0 ? Oddity::FarAhead : Oddity::FarBack;
    }
    const bool grown = before_ns && *display_ns > *before_ns;
    grown_ahead_ = ahead_ns < 0 ? 0 : grown ? grown_ahead_ + 1 : 1;
    if (good_ns_ && *display_ns <= *good_ns_ && grown_ahead_ < kNewLine) {
        return Oddity::WentBack;
    }
    return Oddity::Good;
}

AnnouncedTime::Judgement AnnouncedTime::next(std::int64_t announced,
                                             std::optional<std::int64_t> display_ns,
                                             std::int64_t now_ns) {
    const Oddity now = judge(display_ns, now_ns);
    Judgement judgement{.good = now == Oddity::Good, .change = std::nullopt};
    if (now != oddity_) {
        judgement.change = change(now, announced, display_ns, now_ns);
    }
    oddity_ = now;
    if (judgement.good) {
        good_ns_ = display_ns;
        lead_ns_ = difference_ns(*display_ns, now_ns);
        odd_ = 0;
    } else {
        ++odd_;
    }
    judgement.likely_ns =
        judgement.good ? *display_ns : time::saturated(static_cast<__int128>(now_ns) + lead_ns_);
    return judgement;
}

std::optional<frame::Event> AnnouncedTime::change(Oddity now, std::int64_t announced,
                                                  std::optional<std::int64_t> display_ns,
                                                  std::int64_t now_ns) const {
    constexpr const char* kUnknown = "when such frames are shown is unknown";
    const auto seconds = [](std::int64_t ns) { return std::abs(static_cast<double>(ns)) * 1e-9; };
    switch (now) {
        case Oddity::Good:
            return frame::Event{
                frame::kDisplayTimeGoodEvent,
                fmt::format("the announced display times are good again, {} were not", odd_)};
        case Oddity::None:
            return frame::Event{
                frame::kDisplayTimeOddEvent,
                fmt::format("the announced display time is none ({}): {}", announced, kUnknown)};
        case Oddity::FarAhead:
        case Oddity::FarBack:
            return frame::Event{frame::kDisplayTimeOddEvent,
                                fmt::format("the announced display time lies {:.3f} s {}: {}",
                                            seconds(difference_ns(*display_ns, now_ns)),
                                            now == Oddity::FarAhead ? "ahead" : "back", kUnknown)};
        case Oddity::WentBack:
            return frame::Event{
                frame::kDisplayTimeOddEvent,
                fmt::format("the announced display time went back by {:.3f} ms: {}",
                            seconds(difference_ns(*good_ns_, *display_ns)) * 1e3, kUnknown)};
    }
    return std::nullopt;
}

AnnouncedPeriod::Judgement AnnouncedPeriod::next(std::int64_t period_ns) {
    // Some runtimes know no period at first; 0 says so.
    const bool good = period_ns >= kShortestPeriod_ns && period_ns <= kLongestPeriod_ns;
    const bool odd = !good && period_ns != 0;
    Judgement judgement{.period_ns = good ? period_ns : 0, .change = std::nullopt};
    if (odd && !odd_) {
        judgement.change = frame::Event{
            frame::kPeriodOddEvent,
            fmt::format("the announced display period is {} ns, which no display has: it counts "
                        "as unknown",
                        period_ns)};
    }
    odd_ = odd;
    return judgement;
}

}  // namespace gazeloop::present
