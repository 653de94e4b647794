#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

/// The extensions whose meaning is applied. A file that requires another one is refused by its
/// name.
[[nodiscard]] bool is_supported_extension(std::string_view name);

/// Holds a document against the standard's own rules (glTF 2.0 section 5, and those of the
/// supported extensions): what must be there, types, ranges, words, lengths of lists, and that each
/// index points at something. Refuses with the JSON pointer of the first offence.
///
/// Afterwards integers are stored as integers (24.0 is one) and other numbers as doubles; what has
/// no effect here (extras, unknown properties, unsupported optional extensions) is taken out,
/// noted.
void apply_rules(nlohmann::json& document, Notes& notes);

}  // namespace gazeloop::scene::gltf
