#include "runtime/settings/settings_for_now.h"

#include <cassert>
#include <ranges>

namespace gazeloop::settings {

// NOLINTNEXTLINE(bugprone-exception-escape): only memory can be missing
SettingsForNow::~SettingsForNow() {
    for (const Kept& kept : std::views::reverse(before_)) {
        [[maybe_unused]] const auto restored = settings_.set(kept.key, kept.text, kept.origin);
        assert(restored);  // it was in force
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
