#pragma once

#include <string>

#include "drivers/device/device_source.h"
#include "drivers/psvr2/headset.h"

namespace gazeloop::drivers::psvr2 {

/// Gaze of a PlayStation VR2 over USB, which may come and go.
class Psvr2Source final : public DeviceSource {
  public:
    explicit Psvr2Source(const Psvr2Options& options);

    [[nodiscard]] std::string description() const override;
};

}  // namespace gazeloop::drivers::psvr2
