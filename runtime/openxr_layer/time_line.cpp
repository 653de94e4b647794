#include "runtime/openxr_layer/time_line.h"

#include "runtime/time/span.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kNear_ns = 100'000'000;

/// From one time to another, where they are near each other.
std::optional<std::int64_t> step_ns(std::int64_t from, std::int64_t to) {
    const std::int64_t step = time::saturated(static_cast<__int128>(to) - from);
    return step > -kNear_ns && step < kNear_ns ? std::optional(step) : std::nullopt;
}

}  // namespace

std::optional<std::int64_t> TimeLine::host_ns(XrTime time) const {
    if (!converts()) {
        return is_monotonic_ ? std::optional<std::int64_t>(time) : std::nullopt;
    }
    if (const auto step = near_ ? step_ns(near_->time, time) : std::nullopt; step && time > 0) {
        return time::saturated(static_cast<__int128>(near_->host_ns) + *step);
    }
    return asked_host_ns(time);
}

std::optional<std::int64_t> TimeLine::asked_host_ns(XrTime time) const {
    timespec host{};
    if (XR_FAILED(to_timespec_(instance_, time, &host))) {
        return std::nullopt;
    }
    return time::saturated(static_cast<__int128>(host.tv_sec) * kSecond_ns + host.tv_nsec);
}

std::optional<XrTime> TimeLine::xr_time(std::int64_t host_ns) const {
    if (host_ns <= 0) {
        return std::nullopt;
    }
    if (!converts()) {
        return is_monotonic_ ? std::optional<XrTime>(host_ns) : std::nullopt;
    }
    if (const auto step = near_ ? step_ns(near_->host_ns, host_ns) : std::nullopt) {
        const XrTime near = time::saturated(static_cast<__int128>(near_->time) + *step);
        if (near > 0) {
            return near;
        }
    }
    const timespec host{host_ns / kSecond_ns, host_ns % kSecond_ns};
    XrTime time = 0;
    return XR_SUCCEEDED(from_timespec_(instance_, &host, &time)) ? std::optional(time)
                                                                 : std::nullopt;
}

void TimeLine::see_announced(XrTime display, std::int64_t now_ns) {
    const std::int64_t ahead_ns = time::saturated(static_cast<__int128>(display) - now_ns);
    if (!converts()) {
        is_monotonic_ = ahead_ns > -kSecond_ns && ahead_ns < kSecond_ns;
        return;
    }
    const auto host_ns = asked_host_ns(display);
    near_ = host_ns ? std::optional(Near{display, *host_ns}) : std::nullopt;
}

}  // namespace gazeloop::openxr_layer
