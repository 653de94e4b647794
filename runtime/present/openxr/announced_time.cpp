#include "runtime/present/openxr/announced_time.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "runtime/time/span.h"

namespace gazeloop::present {
namespace {

constexpr std::int64_t kFarFromNowNs = 10'000'000'000;

std::int64_t difference_ns(std::int64_t to, std::int64_t from) {
    return time::saturated(static_cast<__int128>(to) - from);
}

}  // namespace

std::optional<std::string> AnnouncedTime::next(std::int64_t display_ns, std::int64_t now_ns) {
    const auto before_ns = std::exchange(before_ns_, display_ns);
    const std::int64_t ahead_ns = difference_ns(display_ns, now_ns);
    const bool was_near =
        std::exchange(near_, ahead_ns > -kFarFromNowNs && ahead_ns < kFarFromNowNs);
    if (was_near && !near_) {
        return fmt::format("the announced display time lies {:.3f} s {}",
                           std::abs(static_cast<double>(ahead_ns)) * 1e-9,
                           ahead_ns > 0 ? "ahead" : "back");
    }
    if (before_ns && display_ns <= *before_ns) {
        return fmt::format("the announced display time went back by {:.3f} ms",
                           static_cast<double>(difference_ns(*before_ns, display_ns)) * 1e-6);
    }
    return std::nullopt;
}

}  // namespace gazeloop::present
