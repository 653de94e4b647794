#include "runtime/trade/settings_of_point.h"

namespace gazeloop::trade {

SettingsOfPoint::~SettingsOfPoint() {
    for (auto kept = before_.rbegin(); kept != before_.rend(); ++kept) {
        (void)settings_.set(kept->key, kept->text, kept->origin);
    }
}

Expected<void> SettingsOfPoint::set(const SweepPoint& point) {
    for (const auto& [key, text] : point.settings) {
        for (const settings::SettingRow& row : settings_.rows()) {
            if (row.key == key) {
                before_.push_back({key, settings::text_of(row), settings_.origin(key)});
            }
        }
        if (auto done = settings_.set(key, text, "trade"); !done) {
            return done;
        }
    }
    return {};
}

}  // namespace gazeloop::trade
