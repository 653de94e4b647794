#pragma once

#include <string_view>
#include <vector>

#include "runtime/methods/registry.h"
#include "runtime/run/program_settings.h"

namespace gazeloop::tests {

/// A method's passes by its name: by the built-in settings, or these besides.
inline render::MakePasses passes_by(std::string_view method,
                                    const std::vector<NamedValue>& set = {}) {
    run::ProgramSettings settings;
    for (const auto& [key, value] : set) {
        value_or_throw(settings.set(key, value, "test"));
    }
    return value_or_throw(
        methods::find_method(method)->passes(settings.values().methods, settings));
}

}  // namespace gazeloop::tests
