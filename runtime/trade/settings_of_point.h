#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/settings/settings.h"
#include "runtime/trade/sweep_points.h"

namespace gazeloop::trade {

/// A point's settings while this lives, and those before in the end.
class SettingsOfPoint {
  public:
    explicit SettingsOfPoint(settings::Settings& settings) : settings_(settings) {}
    SettingsOfPoint(const SettingsOfPoint&) = delete;
    SettingsOfPoint& operator=(const SettingsOfPoint&) = delete;
    ~SettingsOfPoint();

    /// Errors: as Settings::set().
    Expected<void> set(const SweepPoint& point);

  private:
    struct Kept {
        std::string key;
        std::string text;
        std::string origin;
    };
    settings::Settings& settings_;
    std::vector<Kept> before_;
};

}  // namespace gazeloop::trade
