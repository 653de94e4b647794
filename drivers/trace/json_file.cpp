#include "drivers/trace/json_file.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace gazeloop::drivers {

Expected<std::optional<nlohmann::json>> read_json_object(const std::filesystem::path& file) {
    constexpr std::size_t kLargest = 1 << 20;
    constexpr int kDeepest = 32;  // copies of values follow their nesting on the stack
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::optional<nlohmann::json>{};
    }
    std::string text(kLargest, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    bool too_deep = false;
    const auto within_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        too_deep = too_deep || depth > kDeepest;
        return depth <= kDeepest;
    };
    nlohmann::json object = nlohmann::json::parse(text, within_depth, false);
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
