#include "runtime/scene/gltf/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "runtime/json_nesting.h"

namespace gazeloop::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNesting = 64;
constexpr std::size_t kMostText = std::size_t{1} << 30U;

void check_nesting(std::string_view text) {
    if (const auto at = nested_deeper_at(text, kMostNesting)) {
        refuse("",
               fmt::format("its JSON is nested deeper than {} at byte {}: this is no scene that "
                           "a program writes",
                           kMostNesting, *at));
    }
}

/// Names that one object has twice, of which the parser keeps the last in silence. In a pass of its
/// own: the parser's callback looks at all that came before in a list at the end of each object.
class DuplicateNames final : public nlohmann::json_sax<json> {
  public:
    explicit DuplicateNames(Notes& notes) : notes_(notes) {}

    bool start_object(std::size_t /*elements*/) override {
        names_.emplace_back();
        return true;
    }
    bool key(string_t& name) override {
        if (!names_.back().insert(name).second) {
            notes_.add(
                "duplicate " + name, "",
                fmt::format("one object has two members {}: the last one counts", cited(name)));
        }
        return true;
    }
    bool end_object() override {
        names_.pop_back();
        return true;
    }
    bool null() override { return true; }
    bool boolean(bool /*value*/) override { return true; }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool string(string_t& /*value*/) override { return true; }
    bool binary(binary_t& /*value*/) override { return true; }
    bool start_array(std::size_t /*elements*/) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;  // json::parse() has thrown it before
    }

  private:
    Notes& notes_;
    std::vector<std::set<std::string, std::less<>>> names_;
};

}  // namespace

std::string cited(const json& value) {
    constexpr std::size_t kMost = 200;
    if (value.is_object() || value.is_array()) {
        return value.is_object() ? "an object" : fmt::format("a list of {}", value.size());
    }
    const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    return text.size() > kMost ? fmt::format("{:.{}}...", text, kMost) : text;
}

nlohmann::json parse_json(std::string_view text, Notes& notes) {
    if (text.size() > kMostText) {
        refuse("", fmt::format("its JSON has {} bytes, more than 1 GiB: keep buffers in .bin files "
                               "or a .glb",
                               text.size()));
    }
    if (text.starts_with("\xEF\xBB\xBF")) {
        notes.add("byte order mark", "",
                  "starts with a byte order mark, which the standard forbids");
    }
    check_nesting(text);
    try {
        json document = json::parse(text);
        DuplicateNames duplicates(notes);
        json::sax_parse(text, &duplicates);
        if (!document.is_object()) {
            refuse("", fmt::format("its JSON is {}, must be an object", cited(document)));
        }
        return document;
    } catch (const json::parse_error& error) {
        const std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        const std::string_view before = text.substr(0, at);
        const auto line = 1 + std::ranges::count(before, '\n');
        const std::size_t column = at - (before.rfind('\n') + 1) + 1;
        refuse("", at >= text.size()
                       ? fmt::format("is not JSON: it ends too early, in line {}", line)
                       : fmt::format("is not JSON: line {}, byte {}: this cannot stand there", line,
                                     column));
    } catch (const json::exception&) {
        refuse("", "is not JSON that can be used: it has a number that is too large");
    }
}

}  // namespace gazeloop::scene::gltf
