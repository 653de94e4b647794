#pragma once

#include <cstdint>
#include <optional>

#include "runtime/openxr_layer/next_functions.h"

namespace gazeloop::openxr_layer {

/// The runtime's time line in host time (CLOCK_MONOTONIC). A runtime without
/// XR_KHR_convert_timespec_time is taken to count in CLOCK_MONOTONIC itself, as all known ones on
/// Linux do, once a display time it announced lay within a second of now; before, and if it does
/// not, times are unknown.
class TimeLine {
  public:
    TimeLine() = default;
    TimeLine(XrInstance instance, const NextFunctions& next)
        : instance_(instance),
          to_timespec_(next.ConvertTimeToTimespecTimeKHR),
          from_timespec_(next.ConvertTimespecTimeToTimeKHR) {}

    [[nodiscard]] std::optional<std::int64_t> host_ns(XrTime time) const;
    [[nodiscard]] std::optional<XrTime> xr_time(std::int64_t host_ns) const;

    /// A display time that the runtime announced at `now_ns`.
    void see_announced(XrTime display, std::int64_t now_ns);

  private:
    [[nodiscard]] bool converts() const {
        return to_timespec_ != nullptr && from_timespec_ != nullptr;
    }

    XrInstance instance_ = XR_NULL_HANDLE;
    PFN_xrConvertTimeToTimespecTimeKHR to_timespec_ = nullptr;
    PFN_xrConvertTimespecTimeToTimeKHR from_timespec_ = nullptr;
    bool is_monotonic_ = false;
};

}  // namespace gazeloop::openxr_layer
