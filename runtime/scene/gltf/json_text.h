#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

/// A file's JSON. Refuses what is no JSON of glTF 2.x: syntax, nesting deeper than 64, over 1 GiB.
/// Notes names that are there twice, and a byte order mark.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, Notes& notes);

/// At most 200 characters of what a file says, for messages.
[[nodiscard]] std::string cited(const nlohmann::json& value);

}  // namespace gazeloop::scene::gltf
