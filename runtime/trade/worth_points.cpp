#include "runtime/trade/worth_points.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "runtime/methods/registry.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::trade {
namespace {

constexpr std::string_view kLeftOut = "render.require";

/// What a part is changed to, in turn; as text.
std::vector<std::string> other_values(const settings::SettingRow& row, bool is_filter) {
    const std::string now = settings::text_of(row);
    std::vector<std::string> others;
    if (std::holds_alternative<bool*>(row.slot)) {
        others = {now == "true" ? "false" : "true"};
    } else if (const auto* const choice = std::get_if<settings::Choice>(&row.slot)) {
        others = choice->names;
    } else if (const auto* const whole = std::get_if<settings::Whole>(&row.slot);
               whole != nullptr && is_filter) {
        others = {std::to_string(whole->least)};
    }
    std::erase(others, now);
    return others;
}

}  // namespace

Expected<std::vector<SweepPoint>> worth_points(const std::string& method,
                                               const settings::Settings& settings) {
    const methods::Method* const found = methods::find_method(method);
    const std::vector<std::string> known = methods::rendered_methods();
    if (found == nullptr || std::ranges::find(known, method) == known.end()) {
        return std::unexpected(
            Error{ErrorKind::Usage, "--worth: " + settings::unknown_name("method", method, known)});
    }
    const auto has_effect = [&](const settings::OnlyWhile& only) {
        return only.key.empty() ||
               std::ranges::any_of(settings.rows(), [&](const settings::SettingRow& other) {
                   return other.key == only.key &&
                          std::ranges::find(only.values, settings::text_of(other)) !=
                              only.values.end();
               });
    };
    std::vector<SweepPoint> points;
    if (method != "full") {  // which every sweep has
        points.push_back({.method = method});
    }
    for (const settings::SettingRow& row : settings.rows()) {
        const bool filter = is_filter(row.key);
        const bool is_part = filter ? has_effect(row.only_while)
                                    : row.key == kLeftOut || methods::is_setting_of(row, *found);
        if (!is_part) {
            continue;
        }
        for (const std::string& value : other_values(row, filter)) {
            points.push_back({.method = method, .settings = {{row.key, value}}});
        }
    }
    return points;
}

}  // namespace gazeloop::trade
