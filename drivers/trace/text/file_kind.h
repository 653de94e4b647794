#pragma once

#include <string_view>

namespace gazeloop::drivers {

/// What a file is, by its first bytes, where that is nothing that a table of text could begin with:
/// the kind and the remedy, "UTF-16 text: save it as UTF-8". Empty where it may be a table.
[[nodiscard]] std::string_view kind_of_no_table(std::string_view start);

}  // namespace gazeloop::drivers
