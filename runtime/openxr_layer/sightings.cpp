#include "runtime/openxr_layer/sightings.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "runtime/openxr_layer/private_file.h"
#include "runtime/openxr_layer/user_folders.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::size_t kMostSightingBytes = std::size_t{64} * 1024;

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, std::string Sighting::*>, 9> kTexts{{
    {"application", &Sighting::application},
    {"executable", &Sighting::executable},
    {"seen", &Sighting::seen_utc},
    {"runtime", &Sighting::runtime},
    {"eye_gaze", &Sighting::eye_gaze},
    {"source", &Sighting::source},
    {"permission", &Sighting::permission},
    {"read_gaze", &Sighting::read_gaze_utc},
    {"recording", &Sighting::recording},
}};

std::optional<Sighting> parse(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) {
        return std::nullopt;
    }
    Sighting sighting;
    for (const auto& [name, member] : kTexts) {
        const auto found = json.find(name);
        if (found == json.end() || !found->is_string()) {
            return std::nullopt;
        }
        sighting.*member = found->get<std::string>();
    }
    const auto pid = json.find("pid");
    sighting.pid = pid != json.end() && pid->is_number_integer() ? pid->get<int>() : 0;
    return sighting;
}

}  // namespace

bool keep(const Sighting& sighting) {
    const auto folder = layer_state();
    if (!folder) {
        return false;
    }
    Json json;
    for (const auto& [name, member] : kTexts) {
        json[name] = sighting.*member;
    }
    json["pid"] = sighting.pid;
    const std::string& executable = sighting.executable;
    const auto file =
        fmt::format("{:016x}.json", XXH3_64bits(executable.data(), executable.size()));
    // Names come from outside and may be no UTF-8.
    return write_private(*folder / file,
                         json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<Sighting> sightings() {
    std::vector<Sighting> all;
    const auto folder = layer_state();
    std::error_code failure;
    if (!folder || !std::filesystem::is_directory(*folder, failure)) {
        return all;
    }
    for (const auto& entry : std::filesystem::directory_iterator(*folder, failure)) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        const auto text = read_small(entry.path(), kMostSightingBytes);
        if (auto sighting = text ? parse(*text) : std::nullopt) {
            all.push_back(std::move(*sighting));
        }
    }
    std::ranges::sort(all, std::greater<>{}, &Sighting::seen_utc);
    return all;
}

std::string utc_now() {
    return fmt::format(
        "{:%Y-%m-%dT%H:%M:%SZ}",
        fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

}  // namespace gazeloop::openxr_layer
