#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "drivers/device/tracker_device.h"

namespace gazeloop::drivers {

/// What is said of a tracker that was opened `seconds` ago and has given no sample since: that
/// nothing came and why that may be (TrackerDevice::why_silent), or that something else did. None
/// where it has given one.
[[nodiscard]] std::optional<std::string> silence_text(const TrackerCounts& counts, double seconds,
                                                      std::string_view why_silent);

}  // namespace gazeloop::drivers
