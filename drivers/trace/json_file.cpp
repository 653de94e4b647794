#include "drivers/trace/json_file.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "runtime/json_nesting.h"

namespace gazeloop::drivers {

Expected<std::optional<nlohmann::json>> read_json_object(const std::filesystem::path& file) {
    constexpr std::size_t kLargest = 1 << 20;
    constexpr std::size_t kDeepest = 32;  // copies of values follow their nesting on the stack
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::optional<nlohmann::json>{};
    }
    std::string text(kLargest, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    const bool too_deep = nested_deeper_at(text, kDeepest).has_value();
    nlohmann::json object =
        too_deep ? nlohmann::json() : nlohmann::json::parse(text, nullptr, false);
    if (too_deep || !object.is_object()) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: not a JSON object of at most 1 MiB{}", file.string(),
                              too_deep ? fmt::format(", nested {} deep at most", kDeepest) : "")});
    }
    return object;
}

std::optional<double> number_in(const nlohmann::json& object, std::string_view key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? std::optional{found->get<double>()}
                                                       : std::nullopt;
}

std::string text_in(const nlohmann::json& object, std::string_view key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

}  // namespace gazeloop::drivers
