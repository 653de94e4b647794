#pragma once

#include <string>

#include "drivers/device/device_source.h"
#include "drivers/steam_frame/eye_service.h"

namespace gazeloop::drivers::steam_frame {

/// Gaze of a Steam Frame, whose eye service may come and go.
class SteamFrameSource final : public DeviceSource {
  public:
    explicit SteamFrameSource(const SteamFrameOptions& options);

    [[nodiscard]] std::string description() const override;
};

}  // namespace gazeloop::drivers::steam_frame
