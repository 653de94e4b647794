#pragma once

#include <string>
#include <vector>

#include "runtime/settings/settings.h"

namespace gazeloop::settings {

/// Settings that are others while this lives, and as before in the end.
class SettingsForNow {
  public:
    explicit SettingsForNow(Settings& settings) : settings_(settings) {}
    SettingsForNow(const SettingsForNow&) = delete;
    SettingsForNow& operator=(const SettingsForNow&) = delete;
    ~SettingsForNow();

    /// Errors: as Settings::set().
    Expected<void> set(const std::string& key, const std::string& text, std::string_view origin);

  private:
    struct Kept {
        std::string key;
        std::string text;
        std::string origin;
    };
    Settings& settings_;
    std::vector<Kept> before_;
};

}  // namespace gazeloop::settings
