#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

/// Holds a document against document_shape() as apply_rules() promises. Returns the names of the
/// extensions that stand somewhere and have no effect, each with a place.
[[nodiscard]] std::map<std::string, std::string> check_shape(nlohmann::json& document,
                                                             Notes& notes);

}  // namespace gazeloop::scene::gltf
