#pragma once

#include <string_view>

namespace gazeloop::report::page {

/// A file of this folder, or Chart.js, built into the program. Precondition: CMakeLists.txt names
/// it.
[[nodiscard]] std::string_view page_file(std::string_view name);

}  // namespace gazeloop::report::page
