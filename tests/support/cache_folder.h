#pragma once

#include <cstdlib>
#include <string>
#include <utility>

namespace gazeloop::tests {

/// Where ./dev keeps what it has fetched and built.
inline std::string cache_folder() {
    const auto text_of = [](const char* variable) {
        const char* const value = std::getenv(variable);
        return std::string(value != nullptr ? value : "");
    };
    for (const auto& [variable, below] :
         {std::pair{"GAZELOOP_CACHE", ""}, {"XDG_CACHE_HOME", "/gazeloop"}}) {
        if (const std::string value = text_of(variable); !value.empty()) {
            return value + below;
        }
    }
    return text_of("HOME") + "/.cache/gazeloop";
}

}  // namespace gazeloop::tests
