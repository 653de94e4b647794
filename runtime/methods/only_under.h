#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// For settings that only pictures by these methods depend on, and by `fixed`, which may stand for
/// any of them.
[[nodiscard]] inline settings::OnlyWhile only_under(std::vector<std::string> methods) {
    methods.emplace_back("fixed");
    return {.key = "render.method", .values = std::move(methods)};
}

}  // namespace gazeloop::methods
