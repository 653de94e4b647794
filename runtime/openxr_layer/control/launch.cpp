#include "runtime/openxr_layer/control/launch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/environment.h"
#include "runtime/openxr/runtime_choice.h"
#include "runtime/openxr_layer/control/layer_files.h"
#include "runtime/openxr_layer/instance_creation.h"
#include "runtime/openxr_layer/layer_configuration.h"
#include "runtime/profiles/profiles.h"

namespace gazeloop::openxr_layer {
namespace {

/// Where the loader looks for explicit layers if nobody tells it otherwise.
constexpr const char* kUsualFolders =
    "/usr/local/share/openxr/1/api_layers/explicit.d:/usr/share/openxr/1/api_layers/explicit.d:"
    "/etc/openxr/1/api_layers/explicit.d";

/// The data folders that everybody has who sets none.
constexpr const char* kUsualDataFolders = "/usr/local/share:/usr/share";

void set(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }

/// The loader finds an installed layer in the data folder of its prefix, which must be among those
/// it searches.
void search_data_of(const std::filesystem::path& program) {
    const std::string data =
        (program.parent_path() / GAZELOOP_DATA_FROM_PROGRAM).lexically_normal().string();
    const std::string folders = environment_value("XDG_DATA_DIRS").value_or(kUsualDataFolders);
    const std::vector<std::string> searched = split_list(folders);
    if (std::ranges::find(searched, data) == searched.end()) {
        set("XDG_DATA_DIRS", fmt::format("{}:{}", data, folders));
    }
}

}  // namespace

Error launch(const std::vector<std::string>& command, const std::vector<std::string>& assignments) {
    const auto library = layer_library();
    if (!library) {
        return library.error();
    }
    std::string lines = environment_value(kSettingsVariable).value_or("");
    for (const std::string& assignment : assignments) {
        lines += fmt::format("{}{}", lines.empty() ? "" : "\n", assignment);
    }
    set(kSettingsVariable, lines);
    auto configuration = load_configuration();
    if (!configuration) {
        return std::move(configuration.error());
    }
    if (const auto gaze = check_gaze(*configuration); !gaze) {
        return gaze.error();
    }
    const auto display = profiles::load_display(configuration->values.profile.display);
    if (!display) {
        return display.error();
    }
    try {
        openxr::choose_runtime(*display);
    } catch (const SetupError& error) {
        return {error.kind(), error.what()};
    }
    // Of the build the manifest lies beside the library; installed ones are switched on by
    // variable.
    set("GAZELOOP_LAYER", "1");
    unsetenv("GAZELOOP_LAYER_DISABLE");
    const auto folder = library->parent_path();
    if (std::error_code failure;
        std::filesystem::exists(folder / "XrApiLayer_gazeloop.json", failure)) {
        set("XR_API_LAYER_PATH",
            fmt::format("{}:{}", folder.string(),
                        environment_value("XR_API_LAYER_PATH").value_or(kUsualFolders)));
        const auto layers = environment_value("XR_ENABLE_API_LAYERS");
        set("XR_ENABLE_API_LAYERS",
            fmt::format("{}{}{}", layers.value_or(""), layers ? ":" : "", kLayerName));
    } else {
        search_data_of(std::filesystem::read_symlink("/proc/self/exe", failure));
    }
    std::vector<char*> words;
    words.reserve(command.size() + 1);
    for (const std::string& word : command) {
        words.push_back(const_cast<char*>(word.c_str()));
    }
    words.push_back(nullptr);
    execvp(words.front(), words.data());
    return {ErrorKind::BadInput,
            fmt::format("{}: cannot be run ({})", command.front(), std::strerror(errno))};
}

}  // namespace gazeloop::openxr_layer
