#include "runtime/openxr_layer/time_line.h"

#include "runtime/time/span.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

}  // namespace

std::optional<std::int64_t> TimeLine::host_ns(XrTime time) const {
    if (!converts()) {
        return is_monotonic_ ? std::optional<std::int64_t>(time) : std::nullopt;
    }
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
    const timespec host{host_ns / kSecond_ns, host_ns % kSecond_ns};
    XrTime time = 0;
    return XR_SUCCEEDED(from_timespec_(instance_, &host, &time)) ? std::optional(time)
                                                                 : std::nullopt;
}

void TimeLine::see_announced(XrTime display, std::int64_t now_ns) {
    const std::int64_t ahead_ns = time::saturated(static_cast<__int128>(display) - now_ns);
    if (!converts()) {
        is_monotonic_ = ahead_ns > -kSecond_ns && ahead_ns < kSecond_ns;
    }
}

}  // namespace gazeloop::openxr_layer
