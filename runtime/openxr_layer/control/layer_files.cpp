#include "runtime/openxr_layer/control/layer_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "runtime/openxr_layer/instance_creation.h"
#include "runtime/openxr_layer/layer_configuration.h"
#include "runtime/openxr_layer/private_file.h"
#include "runtime/openxr_layer/provided_extensions.h"
#include "runtime/openxr_layer/user_folders.h"

namespace gazeloop::openxr_layer {
namespace {

namespace fs = std::filesystem;

Error bad(std::string message) { return {ErrorKind::BadInput, std::move(message)}; }

Expected<void> written(const fs::path& file, std::string_view text) {
    if (!write_private(file, text)) {
        return std::unexpected(bad(fmt::format("{}: cannot be written", file.string())));
    }
    return {};
}

}  // namespace

Expected<fs::path> layer_library() {
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure).parent_path();
    const fs::path built = program / "openxr_layer/libXrApiLayer_gazeloop.so";
    const fs::path installed = (program / GAZELOOP_LAYER_FROM_PROGRAM).lexically_normal();
    for (const fs::path& library : {built, installed}) {
        if (fs::is_regular_file(library, failure)) {
            return library;
        }
    }
    return std::unexpected(
        bad(fmt::format("the OpenXR API layer is neither {} nor {}: build it (./dev build), or "
                        "install it (cmake --install)",
                        built.string(), installed.string())));
}

Expected<fs::path> user_manifest() {
    const auto data = user_data();
    if (!data) {
        return std::unexpected(bad("neither XDG_DATA_HOME nor HOME names a folder"));
    }
    return *data / "openxr/1/api_layers/implicit.d/XrApiLayer_gazeloop.json";
}

Expected<void> enable(const std::vector<std::string>& assignments) {
    const auto library = layer_library();
    const auto manifest = user_manifest();
    if (!library || !manifest) {
        return std::unexpected(library ? manifest.error() : library.error());
    }
    if (!assignments.empty()) {
        const auto text = settings_file(assignments);
        const auto file = layer_config_file();
        if (!text || !file) {
            return std::unexpected(text ? bad("neither XDG_CONFIG_HOME nor HOME names a folder")
                                        : text.error());
        }
        if (auto done = written(*file, *text); !done) {
            return done;
        }
    }
    nlohmann::ordered_json extensions = nlohmann::ordered_json::array();
    for (const auto& [name, version] : kProvidedExtensions) {
        extensions.push_back({{"name", name}, {"extension_version", std::to_string(version)}});
    }
    const nlohmann::ordered_json json{
        {"file_format_version", "1.0.0"},
        {"api_layer",
         {{"name", kLayerName},
          {"library_path", library->string()},
          {"api_version", "1.0"},
          {"implementation_version", "1"},
          {"description", "Gives applications eye gaze from gazeloop's sources, and records them"},
          {"instance_extensions", extensions},
          {"disable_environment", "GAZELOOP_LAYER_DISABLE"}}}};
    try {
        return written(*manifest, json.dump(4) + "\n");
    } catch (const nlohmann::json::exception&) {
        return std::unexpected(bad(fmt::format(
            "{}: a path that is no UTF-8, which the OpenXR loader cannot be told: install gazeloop "
            "in another folder",
            library->string())));
    }
}

Expected<bool> disable() {
    const auto manifest = user_manifest();
    if (!manifest) {
        return std::unexpected(manifest.error());
    }
    std::error_code failure;
    const bool removed = fs::remove(*manifest, failure);
    if (failure) {
        return std::unexpected(bad(fmt::format("{}: {}", manifest->string(), failure.message())));
    }
    return removed;
}

Expected<bool> decide(const std::string& executable, Permissions::Answer answer) {
    const auto file = Permissions::file();
    if (!file) {
        return std::unexpected(bad("neither XDG_CONFIG_HOME nor HOME names a folder"));
    }
    auto permissions = Permissions::read(*file);
    if (!permissions) {
        return std::unexpected(std::move(permissions.error()));
    }
    std::error_code failure;
    const fs::path whole = fs::canonical(executable, failure);
    // What is decided on a program that has gone can be forgotten.
    if (failure && answer != Permissions::Answer::Unknown) {
        return std::unexpected(bad(fmt::format("{}: {}; name the application's executable file",
                                               executable, failure.message())));
    }
    const std::string name = failure ? executable : whole.string();
    if (permissions->of(name) == answer) {
        return false;
    }
    permissions->set(name, answer);
    if (auto done = written(*file, permissions->text()); !done) {
        return std::unexpected(done.error());
    }
    return true;
}

}  // namespace gazeloop::openxr_layer
