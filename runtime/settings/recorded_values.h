#pragma once

#include <span>
#include <string_view>

#include "runtime/error.h"
#include "runtime/named_value.h"
#include "runtime/settings/settings.h"

namespace gazeloop::settings {

/// Sets what a recording lists, except what concerns the machine it was made on. Errors: as
/// Settings::set().
Expected<void> take_recorded(std::span<const NamedValue> recorded, std::string_view origin,
                             Settings& settings);

/// Whether every setting that concerns `what` and is in use has the value that was recorded. A
/// setting that the recording does not list came later than the recording: its built-in value must
/// be what the program did before it was there, and any other value counts as different.
[[nodiscard]] bool are_as_recorded(std::span<const NamedValue> recorded, Concerns what,
                                   const Settings& settings);

}  // namespace gazeloop::settings
