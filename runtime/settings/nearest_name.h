#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gazeloop::settings {

/// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours), for
/// "did you mean". None if that distance is more than a third of the text's length plus one.
std::optional<std::string> nearest_name(std::string_view text,
                                        std::span<const std::string> candidates);

/// "unknown WHAT 'TEXT'; did you mean 'NAME'?; known: a, b, c".
std::string unknown_name(std::string_view what, std::string_view text,
                         std::span<const std::string> candidates);
/// The same for keys of the form GROUP.NAME, which are too many for a message: known are those of
/// the text's group, or else the groups.
std::string unknown_key(std::string_view text, std::span<const std::string> keys);

}  // namespace gazeloop::settings
