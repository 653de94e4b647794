#include "runtime/scene/gltf/json_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>

#include "runtime/scene/gltf/json_text.h"
#include "runtime/scene/gltf/rule_check.h"

namespace gazeloop::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 7> kSupported{
    "KHR_lights_punctual",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",    "KHR_materials_transmission",
    "KHR_materials_unlit",  "KHR_mesh_quantization",
    "KHR_texture_transform"};

void check_version(const json& document) {
    const std::string version = document.at("asset").at("version").get<std::string>();
    const std::string needed = document.at("asset").contains("minVersion")
                                   ? document.at("asset").at("minVersion").get<std::string>()
                                   : "";
    const bool is_2 = version.starts_with("2.") && version.size() > 2 &&
                      std::all_of(version.begin() + 2, version.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
    if (!is_2) {
        refuse("/asset/version",
               fmt::format("is {}: only glTF 2 can be read; export the scene as glTF 2.0",
                           cited(version)));
    }
    if (!needed.empty() && needed != "2.0") {
        refuse("/asset/minVersion",
               fmt::format("asks for glTF {}: only 2.0 can be read; export the scene as glTF 2.0",
                           cited(needed)));
    }
}

std::string_view remedy_for(std::string_view extension) {
    if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
        extension == "KHR_meshopt_compression") {
        return "export the scene without mesh compression (gltf-transform copy does)";
    }
    if (extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" ||
        extension == "EXT_texture_avif") {
        return "export its textures as PNG or JPEG";
    }
    return "export the scene without it";
}

/// The names in a list of the document, at the place where they stand.
template <typename Step>
void for_each_name(const json& document, const char* list, Step step) {
    if (const auto names = document.find(list); names != document.end()) {
        for (std::size_t i = 0; i < names->size(); ++i) {
            step((*names)[i].get<std::string>(), fmt::format("/{}/{}", list, i));
        }
    }
}

/// Before anything else, since a file that needs another extension breaks other rules because of
/// it.
void check_required(const json& document, Notes& notes) {
    const auto required = document.find("extensionsRequired");
    if (required == document.end() || !required->is_array()) {
        return;  // the rules say what is wrong with it
    }
    std::set<std::string> used;
    if (const auto list = document.find("extensionsUsed");
        list != document.end() && list->is_array()) {
        for (const json& name : *list) {
            if (name.is_string()) {
                used.insert(name.get<std::string>());
            }
        }
    }
    for (std::size_t i = 0; i < required->size(); ++i) {
        const std::string place = fmt::format("/extensionsRequired/{}", i);
        if (!(*required)[i].is_string()) {
            continue;
        }
        const auto name = (*required)[i].get<std::string>();
        if (!is_supported_extension(name)) {
            refuse(place, fmt::format("the file requires {}, which is not supported; {}",
                                      cited(name), remedy_for(name)));
        }
        if (!used.contains(name)) {
            notes.add("required but unused " + name, place,
                      fmt::format("{} is not listed in extensionsUsed", name));
        }
    }
}

}  // namespace

bool is_supported_extension(std::string_view name) {
    return std::ranges::find(kSupported, name) != kSupported.end();
}

void apply_rules(json& document, Notes& notes) {
    check_required(document, notes);
    if (!document.contains("asset")) {
        refuse("", "lacks 'asset': this is no glTF file");
    }
    std::map<std::string, std::string> unsupported = check_shape(document, notes);
    check_version(document);

    for_each_name(document, "extensionsUsed", [&](const std::string& name, const std::string& at) {
        if (!is_supported_extension(name)) {
            unsupported.try_emplace(name, at);
        }
    });
    for (const auto& [name, at] : unsupported) {
        notes.add("extension " + name, at,
                  is_supported_extension(name)
                      ? fmt::format("{} has no meaning here: left out", name)
                      : fmt::format("{} is not supported: shown without it", name));
    }
}

}  // namespace gazeloop::scene::gltf
