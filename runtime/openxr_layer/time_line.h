#pragma once

#include <cstdint>
#include <optional>

#include "runtime/openxr_layer/next_functions.h"

namespace gazeloop::openxr_layer {

/// The runtime's time line in host time (CLOCK_MONOTONIC). A runtime without
/// XR_KHR_convert_timespec_time is taken to count in CLOCK_MONOTONIC itself, as all known ones on
/// Linux do, once a display time it announced lay within a second of now; before, and if it does
/// not, times are unknown. A runtime that has it is asked once a frame: within 100 ms of the
/// announced display time both lines are taken to run alike, which is wrong by 50 us at most
/// while the host's clock is slewed (500 ppm).
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
    /// As the runtime converts it.
    [[nodiscard]] std::optional<std::int64_t> asked_host_ns(XrTime time) const;

    XrInstance instance_ = XR_NULL_HANDLE;
    PFN_xrConvertTimeToTimespecTimeKHR to_timespec_ = nullptr;
    PFN_xrConvertTimespecTimeToTimeKHR from_timespec_ = nullptr;
    bool is_monotonic_ = false;
    /// What converting the display time gave that was announced last.
    struct Near {
        XrTime time = 0;
        std::int64_t host_ns = 0;
    };
    std::optional<Near> near_;
};

}  // namespace gazeloop::openxr_layer
