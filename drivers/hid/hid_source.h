#pragma once

#include <string>

#include "drivers/device/device_source.h"
#include "drivers/hid/tracker_session.h"

namespace gazeloop::drivers::hid {

/// What top(1) calls the thread that reads.
inline constexpr const char* kHidThreadName = "gaze-hid";

/// Gaze of an eye tracker on HID usage page 0x12, which may come and go. The gaze is directions in
/// the head frame of screen_gaze.h.
class HidSource final : public DeviceSource {
  public:
    explicit HidSource(const HidOptions& options);

    [[nodiscard]] std::string description() const override;

  private:
    std::string path_;
};

}  // namespace gazeloop::drivers::hid
