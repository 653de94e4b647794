#include "runtime/methods/registry.h"

#include <algorithm>
#include <array>

namespace gazeloop::methods {

// One line per method, here and below; each lies in NAME_method.cpp.
Method full_method();
Method kfr_method();
Method acuity_method();
Method layers_method();
Method rings_method();
Method sparse_method();
Method quad_method();
Method kfr3d_method();
Method interleaved_method();
Method fixed_method();

std::span<const Method> all_methods() {
    static const std::array kMethods{
        full_method(),   kfr_method(),  acuity_method(), layers_method(),      rings_method(),
        sparse_method(), quad_method(), kfr3d_method(),  interleaved_method(), fixed_method()};
    return kMethods;
}

const Method* find_method(std::string_view name) {
    const auto methods = all_methods();
    const auto at = std::ranges::find(methods, name, &Method::name);
    return at == methods.end() ? nullptr : &*at;
}

std::vector<std::string> rendered_methods() {
    std::vector<std::string> names;
    for (const Method& method : all_methods()) {
        if (method.passes != nullptr) {
            names.emplace_back(method.name);
        }
    }
    return names;
}

bool is_setting_of(const settings::SettingRow& row, const Method& method) {
    if (row.only_while.key.empty()) {
        return row.key.starts_with(std::string(method.name) + '.') ||
               (row.key == "acuity.mar" && method.follows_acuity);
    }
    return std::ranges::find(row.only_while.values, method.name) != row.only_while.values.end();
}

bool is_setting_of(std::string_view key, std::string_view method) {
    const Method* const found = find_method(method);
    MethodSettings any;
    const std::vector<settings::SettingRow> rows = rows_of(any);
    const auto row = std::ranges::find(rows, key, &settings::SettingRow::key);
    return found != nullptr && row != rows.end() && is_setting_of(*row, *found);
}

std::vector<settings::SettingRow> rows_of(MethodSettings& values) {
    std::vector<settings::SettingRow> rows;
    for (const Method& method : all_methods()) {
        if (method.rows != nullptr) {
            auto more = method.rows(values);
            rows.insert(rows.end(), more.begin(), more.end());
        }
    }
    return rows;
}

}  // namespace gazeloop::methods
