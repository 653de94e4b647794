#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace gazeloop::tests {

/// Environment under which OpenXR's core validation layer writes what it has to say to a file.
inline std::vector<std::pair<std::string, std::string>> openxr_validation_to(
    const std::string& file) {
    return {{"XR_CORE_VALIDATION_EXPORT_TYPE", "text"}, {"XR_CORE_VALIDATION_FILE_NAME", file}};
}

/// What a run's program prints when that layer was loaded.
inline constexpr const char* kOpenXrValidationIsOn = "Core Validation output type: text";

/// The messages in that file, which the layer makes with its first one.
inline std::string openxr_validation_messages(const std::string& file) {
    std::ifstream in(file);
    std::string messages;
    for (std::string line; std::getline(in, line);) {
        if (line.find("VUID") != std::string::npos || line.find("[ERROR") != std::string::npos ||
            line.find("[WARNING") != std::string::npos) {
            messages += line + "\n";
        }
    }
    return messages;
}

}  // namespace gazeloop::tests
