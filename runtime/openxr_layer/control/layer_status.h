#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gazeloop::openxr_layer {

/// Whether the layer is on for this user, what it gives, and what applications saw of it last.
[[nodiscard]] nlohmann::ordered_json layer_status_json();
/// The same in words.
[[nodiscard]] std::string layer_status_text();

}  // namespace gazeloop::openxr_layer
