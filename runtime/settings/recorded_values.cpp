#include "runtime/settings/recorded_values.h"

#include <algorithm>

namespace gazeloop::settings {

Expected<void> take_recorded(std::span<const NamedValue> recorded, std::string_view origin,
                             Settings& settings) {
    for (const auto& [key, value] : recorded) {
        const bool of_machine = std::ranges::any_of(settings.rows(), [&](const SettingRow& row) {
            return row.key == key && row.concerns == Concerns::Machine;
        });
        if (of_machine) {
            continue;
        }
        if (auto set = settings.set(key, value, origin); !set) {
            return set;
        }
    }
    return {};
}

bool are_as_recorded(std::span<const NamedValue> recorded, Concerns what,
                     const Settings& settings) {
    return std::ranges::all_of(settings.rows(), [&](const SettingRow& row) {
        if (row.concerns != what || !settings.is_in_use(row)) {
            return true;
        }
        const auto then = std::ranges::find(recorded, row.key, &NamedValue::name);
        return then == recorded.end() ? settings.is_built_in(row.key) : then->value == text_of(row);
    });
}

}  // namespace gazeloop::settings
