#include "runtime/settings/settings_for_now.h"

namespace gazeloop::settings {

SettingsForNow::~SettingsForNow() {
    for (auto kept = before_.rbegin(); kept != before_.rend(); ++kept) {
        (void)settings_.set(kept->key, kept->text, kept->origin);
    }
}

Expected<void> SettingsForNow::set(const std::string& key, const std::string& text,
                                   std::string_view origin) {
    for (const SettingRow& row : settings_.rows()) {
        if (row.key == key) {
            before_.push_back({key, text_of(row), settings_.origin(key)});
        }
    }
    return settings_.set(key, text, origin);
}

}  // namespace gazeloop::settings
