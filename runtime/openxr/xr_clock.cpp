#include "runtime/openxr/xr_clock.h"

namespace gazeloop::openxr {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

std::optional<std::int64_t> in_ns(const timespec& time) {
    std::int64_t seconds_ns = 0;
    std::int64_t ns = 0;
    if (__builtin_mul_overflow(std::int64_t{time.tv_sec}, kSecondNs, &seconds_ns) ||
        __builtin_add_overflow(seconds_ns, std::int64_t{time.tv_nsec}, &ns)) {
        return std::nullopt;
    }
    return ns;
}

}  // namespace

XrClock::XrClock(const Instance& instance)
    : instance_(instance.handle()),
      to_timespec_(xr_function<PFN_xrConvertTimeToTimespecTimeKHR>(
          instance.handle(), "xrConvertTimeToTimespecTimeKHR")),
      from_timespec_(xr_function<PFN_xrConvertTimespecTimeToTimeKHR>(
          instance.handle(), "xrConvertTimespecTimeToTimeKHR")) {}

std::optional<std::int64_t> XrClock::host_ns(XrTime time) const {
    timespec host{};
    return XR_SUCCEEDED(to_timespec_(instance_, time, &host)) ? in_ns(host) : std::nullopt;
}

std::optional<XrTime> XrClock::xr_time(std::int64_t host_ns) const {
    const timespec host{host_ns / kSecondNs, host_ns % kSecondNs};
    XrTime time = 0;
    if (host_ns <= 0 || XR_FAILED(from_timespec_(instance_, &host, &time)) || time <= 0) {
        return std::nullopt;
    }
    return time;
}

}  // namespace gazeloop::openxr
