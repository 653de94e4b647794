#include "runtime/vulkan/loader_manifest.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace gazeloop::vulkan {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> library_fault(const std::string& library) {
    void* const handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* const why = dlerror();
        return fmt::format("names the library '{}', which cannot be loaded ({})", library,
                           why != nullptr ? why : "unknown");
    }
    dlclose(handle);
    return std::nullopt;
}

}  // namespace

std::optional<std::string> manifest_fault(const fs::path& manifest, std::string_view section) {
    std::error_code error;
    const fs::file_status status = fs::status(manifest, error);
    if (status.type() == fs::file_type::not_found) {
        return "does not exist";
    }
    if (status.type() == fs::file_type::directory) {
        return "is a folder";
    }
    std::ifstream file(manifest);
    if (!file) {
        return fmt::format("cannot be read ({})", std::strerror(errno));
    }
    const nlohmann::json parsed = nlohmann::json::parse(file, nullptr, false);
    if (parsed.is_discarded()) {
        return "is no JSON";
    }
    const auto member = [](const nlohmann::json& of, std::string_view name) {
        return of.is_object() && of.contains(name) ? of[name] : nlohmann::json();
    };
    const nlohmann::json library = member(member(parsed, section), "library_path");
    if (!library.is_string()) {
        return fmt::format("has no {}.library_path", section);
    }
    // A name without a folder is looked for as the system does, others from the manifest's folder.
    const auto name = library.get<std::string>();
    return library_fault(
        name.find('/') == std::string::npos ? name : (manifest.parent_path() / name).string());
}

}  // namespace gazeloop::vulkan
