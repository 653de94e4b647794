#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/methods/method.h"

namespace gazeloop::methods {

/// All methods, full resolution first.
[[nodiscard]] std::span<const Method> all_methods();

/// A method by its name; null: there is none.
[[nodiscard]] const Method* find_method(std::string_view name);

/// Names of the methods that can be rendered.
[[nodiscard]] std::vector<std::string> rendered_methods();

/// Whether a setting of rows_of() decides a method's pictures. Of another's settings a method may
/// use some: those of kfr are interleaved's, too.
[[nodiscard]] bool is_setting_of(const settings::SettingRow& row, const Method& method);
[[nodiscard]] bool is_setting_of(std::string_view key, std::string_view method);

/// The rows of all methods' settings.
[[nodiscard]] std::vector<settings::SettingRow> rows_of(MethodSettings& values);

}  // namespace gazeloop::methods
