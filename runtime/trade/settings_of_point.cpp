#include "runtime/trade/settings_of_point.h"

#include <cassert>
#include <ranges>

namespace gazeloop::trade {

SettingsOfPoint::~SettingsOfPoint() {
    for (const Kept& kept : before_ | std::views::reverse) {
        // What it was is a value that it takes.
        [[maybe_unused]] const auto done = settings_.set(kept.key, kept.text, kept.origin);
        assert(done);
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
