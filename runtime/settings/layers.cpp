#include "runtime/settings/layers.h"

#include <fmt/core.h>

namespace gazeloop::settings {

Expected<void> apply(const Layers& layers, Settings& settings) {
    if (layers.standard_files) {
        if (auto loaded = settings.load_standard_files(); !loaded) {
            return loaded;
        }
    }
    for (const std::string& file : layers.files) {
        if (auto loaded = settings.load(file); !loaded) {
            return loaded;
        }
    }
    for (const std::string& assignment : layers.assignments) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos) {
            return std::unexpected(Error{
                ErrorKind::Usage, fmt::format("--set {}: KEY=VALUE is expected", assignment)});
        }
        if (auto set =
                settings.set(assignment.substr(0, equals), assignment.substr(equals + 1), "--set");
            !set) {
            return set;
        }
    }
    for (const auto& [key, text, origin] : layers.named) {
        if (auto set = settings.set(key, text, origin); !set) {
            return set;
        }
    }
    return {};
}

}  // namespace gazeloop::settings
