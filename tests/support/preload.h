#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gazeloop::tests {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Environment in which a program loads a library first, after what is loaded first already (a
/// sanitizer's). By name, because the loader takes a space in a path for the end of it.
inline Environment preloaded(const std::filesystem::path& library) {
    const auto joined = [](const char* variable, const std::string& value) {
        const char* const before = std::getenv(variable);
        return std::pair(std::string(variable),
                         before != nullptr ? std::string(before) + ":" + value : value);
    };
    return {joined("LD_PRELOAD", library.filename()),
            joined("LD_LIBRARY_PATH", library.parent_path())};
}

}  // namespace gazeloop::tests
