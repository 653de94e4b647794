#pragma once

#include <string_view>

namespace gazeloop::trade {

/// A file of this folder, built into the program. Precondition: CMakeLists.txt names it.
[[nodiscard]] std::string_view sweep_file(std::string_view name);

}  // namespace gazeloop::trade
