#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::drivers {

/// The JSON object in a file; none where there is no such file. Errors (BadInput): no JSON object
/// of at most 1 MiB that is nested 32 deep at most.
[[nodiscard]] Expected<std::optional<nlohmann::json>> read_json_object(
    const std::filesystem::path& file);

/// `count` finite numbers in an array; none where the object has something else there.
template <std::size_t Count>
[[nodiscard]] std::optional<std::array<double, Count>> numbers_in(const nlohmann::json& object,
                                                                  std::string_view key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array() || found->size() != Count) {
        return std::nullopt;
    }
    std::array<double, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i) {
        if (!(*found)[i].is_number()) {
            return std::nullopt;
        }
        numbers[i] = (*found)[i].template get<double>();
    }
    return numbers;
}

/// The same of a single number.
[[nodiscard]] std::optional<double> number_in(const nlohmann::json& object, std::string_view key);
/// The text there; empty where there is none.
[[nodiscard]] std::string text_in(const nlohmann::json& object, std::string_view key);

}  // namespace gazeloop::drivers
