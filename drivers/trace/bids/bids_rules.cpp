#include "drivers/trace/bids/bids_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace gazeloop::drivers {
namespace {

using Json = nlohmann::json;

/// Which of the two objects a rule is about.
enum class Of { Physio, ScreenEvents };

struct Rule {
    Of of;
    std::string_view key;  ///< with '/' between an object's and its member's
    std::string_view must;
    bool (*holds)(const Json& value);
};

bool one_of(const Json& value, std::initializer_list<std::string_view> words) {
    return value.is_string() &&
           std::ranges::find(words, std::string_view{value.get_ref<const std::string&>()}) !=
               words.end();
}

bool is_positive(const Json& value) { return value.is_number() && value.get<double>() > 0.0; }

bool is_text(const Json& value) {
    return value.is_string() && !value.get_ref<const std::string&>().empty();
}

bool are_columns(const Json& value) {
    constexpr std::array<std::string_view, 3> kFirst{"timestamp", "x_coordinate", "y_coordinate"};
    if (!value.is_array() || value.size() < kFirst.size()) {
        return false;
    }
    std::vector<std::string_view> names;
    for (const Json& column : value) {
        if (!is_text(column)) {
            return false;
        }
        const std::string_view name = column.get_ref<const std::string&>();
        if (std::ranges::find(names, name) != names.end() ||
            (names.size() < kFirst.size() && name != kFirst[names.size()])) {
            return false;
        }
        names.push_back(name);
    }
    return true;
}

bool are_positive(const Json& value, std::size_t count) {
    return value.is_array() && value.size() == count && std::ranges::all_of(value, is_positive);
}

bool is_distance(const Json& value) {
    return is_positive(value) ||
           (value.is_array() && value.size() == 3 &&
            std::ranges::all_of(value, [](const Json& number) { return number.is_number(); }));
}

bool is_origin(const Json& value) {
    return value.is_array() && value.size() == 2 && one_of(value[0], {"top", "bottom"}) &&
           one_of(value[1], {"left", "right"});
}

constexpr std::array kRules{
    Rule{Of::Physio, "PhysioType", "\"eyetrack\"",
         [](const Json& value) { return one_of(value, {"eyetrack"}); }},
    Rule{Of::Physio, "RecordedEye", "\"left\", \"right\" or \"cyclopean\"",
         [](const Json& value) { return one_of(value, {"left", "right", "cyclopean"}); }},
    Rule{Of::Physio, "SampleCoordinateSystem",
         "\"gaze-on-screen\", \"eye-in-head\", \"gaze-in-world\" or \"custom\"",
         [](const Json& value) {
             return one_of(value, {"gaze-on-screen", "eye-in-head", "gaze-in-world", "custom"});
         }},
    Rule{Of::Physio, "SamplingFrequency", "a number above 0", is_positive},
    Rule{Of::Physio, "StartTime", "a number", [](const Json& value) { return value.is_number(); }},
    Rule{Of::Physio, "Columns",
         "distinct names, of which \"timestamp\", \"x_coordinate\", \"y_coordinate\" are the first",
         are_columns},
    Rule{Of::Physio, "x_coordinate/Units", "a unit", is_text},
    Rule{Of::Physio, "y_coordinate/Units", "a unit", is_text},
    Rule{Of::ScreenEvents, "StimulusPresentation/ScreenDistance",
         "a distance in metres, or three of them", is_distance},
    Rule{Of::ScreenEvents, "StimulusPresentation/ScreenOrigin",
         "[\"top\" or \"bottom\", \"left\" or \"right\"]", is_origin},
    Rule{Of::ScreenEvents, "StimulusPresentation/ScreenResolution", "two numbers of pixels",
         [](const Json& value) { return are_positive(value, 2); }},
    Rule{Of::ScreenEvents, "StimulusPresentation/ScreenSize", "two lengths in metres",
         [](const Json& value) { return are_positive(value, 2); }},
};

const Json* at(const Json& object, std::string_view key) {
    const std::size_t slash = key.find('/');
    const auto found = object.is_object() ? object.find(key.substr(0, slash)) : object.end();
    if (!object.is_object() || found == object.end()) {
        return nullptr;
    }
    return slash == std::string_view::npos ? &*found : at(*found, key.substr(slash + 1));
}

std::string shown(const Json& value) {
    constexpr std::size_t kLongest = 60;
    constexpr std::size_t kMost = 8;
    // Nothing nested is written out, which a hostile file could make too deep for the stack.
    if (value.is_object() || (value.is_array() && (value.size() > kMost ||
                                                   std::ranges::any_of(value, [](const Json& one) {
                                                       return one.is_structured();
                                                   })))) {
        return "of another form";
    }
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (text.size() > kLongest) {
        text.resize(kLongest);
        text += "...";
    }
    return text;
}

}  // namespace

std::vector<std::string> broken_bids_rules(const Json& physio, const Json& events) {
    const Json* const system = at(physio, "SampleCoordinateSystem");
    const bool on_screen = system != nullptr && one_of(*system, {"gaze-on-screen"});
    std::vector<std::string> broken;
    for (const Rule& rule : kRules) {
        if (rule.of == Of::ScreenEvents && !on_screen) {
            continue;
        }
        const Json* const value = at(rule.of == Of::Physio ? physio : events, rule.key);
        if (value != nullptr && rule.holds(*value)) {
            continue;
        }
        broken.push_back(fmt::format(
            "{}{} must be {}; {}", rule.key,
            rule.of == Of::ScreenEvents ? " (of the events' JSON, for gaze-on-screen)" : "",
            rule.must,
            value == nullptr ? "it is missing" : fmt::format("it is {}", shown(*value))));
    }
    return broken;
}

}  // namespace gazeloop::drivers
