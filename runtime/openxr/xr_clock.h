#pragma once

#include <cstdint>
#include <optional>

#include "runtime/openxr/instance.h"

namespace gazeloop::openxr {

/// The runtime's time line in host time, CLOCK_MONOTONIC (XR_KHR_convert_timespec_time).
/// `instance` must outlive this.
class XrClock {
  public:
    explicit XrClock(const Instance& instance);

    /// None where the runtime, or int64, takes it for no time.
    [[nodiscard]] std::optional<std::int64_t> host_ns(XrTime time) const;

    /// None where the runtime does not know that time, or it is not positive.
    [[nodiscard]] std::optional<XrTime> xr_time(std::int64_t host_ns) const;

  private:
    XrInstance instance_;
    PFN_xrConvertTimeToTimespecTimeKHR to_timespec_;
    PFN_xrConvertTimespecTimeToTimeKHR from_timespec_;
};

}  // namespace gazeloop::openxr
