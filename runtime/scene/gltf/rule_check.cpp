#include "runtime/scene/gltf/rule_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string_view>

#include "runtime/scene/gltf/document_shape.h"
#include "runtime/scene/gltf/json_text.h"

namespace gazeloop::scene::gltf {
namespace {

using nlohmann::json;
using enum Rule::Kind;

std::size_t length_of(const json& document, std::string_view list) {
    const json::json_pointer pointer(fmt::format("/{}", list));
    const json* const found = document.contains(pointer) ? &document.at(pointer) : nullptr;
    return found != nullptr && found->is_array() ? found->size() : 0;
}

class RuleCheck {
  public:
    RuleCheck(const json& document, Notes& notes) : notes_(notes) {
        for (const std::string_view list :
             {"accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes",
              "nodes", "samplers", "scenes", "skins", "textures",
              "extensions/KHR_lights_punctual/lights"}) {
            lengths_[list] = length_of(document, list);
        }
        if (const auto used = document.find("extensionsUsed");
            used != document.end() && used->is_array()) {
            for (const json& name : *used) {
                if (name.is_string()) {
                    declared_.insert(name.get<std::string>());
                }
            }
        }
    }

    void check(json& value, const Rule& rule) {
        switch (rule.kind) {
            case Boolean:
                expect(value.is_boolean(), value, "true or false");
                break;
            case Integer:
                check_integer(value, rule);
                break;
            case Number:
                check_number(value, rule);
                break;
            case Text:
                expect(value.is_string(), value, "a string");
                expect(rule.words.empty() ||
                           std::ranges::find(rule.words, value.get_ref<const std::string&>()) !=
                               rule.words.end(),
                       value, fmt::format("one of {}", fmt::join(rule.words, ", ")));
                break;
            case Index:
                check_index(value, rule);
                break;
            case Object:
                expect(value.is_object(), value, "an object");
                check_object(value, *rule.shape);
                break;
            case List:
                check_list(value, rule);
                break;
            case Map:
                expect(value.is_object() && !value.empty(), value, "an object that is not empty");
                for (auto& [name, element] : value.items()) {
                    inside(name, [&] { check(element, *rule.element); });
                }
                break;
        }
    }

    /// The names of extensions that stand somewhere and have no effect.
    [[nodiscard]] const std::map<std::string, std::string>& unsupported() const {
        return unsupported_;
    }

  private:
    template <typename Step>
    void inside(std::string_view name, Step step) {
        const std::size_t before = place_.size();
        place_ += '/';
        for (const char c : name) {  // RFC 6901
            c == '~' ? place_ += "~0" : c == '/' ? place_ += "~1" : place_ += c;
        }
        step();
        place_.resize(before);
    }

    void expect(bool held, const json& value, std::string_view wanted) const {
        if (!held) {
            refuse(place_, fmt::format("is {}, must be {}", cited(value), wanted));
        }
    }

    static bool is_within(double number, const Rule& rule) {
        return std::isfinite(number) && number <= rule.max &&
               (rule.above_min ? number > rule.min : number >= rule.min);
    }

    void check_integer(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a whole number");
        const double number = value.get<double>();
        expect(number == std::floor(number) && std::abs(number) <= kMostInteger, value,
               "a whole number");
        if (!rule.numbers.empty()) {
            expect(std::ranges::find(rule.numbers, number) != rule.numbers.end(), value,
                   fmt::format("one of {}", fmt::join(rule.numbers, ", ")));
        } else {
            expect(is_within(number, rule), value,
                   fmt::format("from {:.0f} to {:.0f}", rule.min, rule.max));
        }
        store(value, number);
    }

    static void store(json& value, double whole) {
        if (whole >= 0.0) {
            value = static_cast<std::uint64_t>(whole);
        } else {
            value = static_cast<std::int64_t>(whole);
        }
    }

    void check_number(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a number");
        const double number = value.get<double>();
        // What is used in single precision must be finite there.
        constexpr double kLargest = std::numeric_limits<float>::max();
        expect(is_within(number, rule) && std::abs(number) <= kLargest, value,
               fmt::format("{} {} and at most {}", rule.above_min ? "above" : "at least",
                           std::max(rule.min, -kLargest), std::min(rule.max, kLargest)));
        value = number;
    }

    void check_index(json& value, const Rule& rule) const {
        expect(value.is_number(), value, "a whole number");
        const std::size_t length = lengths_.at(rule.list);
        const double number = value.get<double>();
        if (!(number >= 0.0 && number < static_cast<double>(length) &&
              number == std::floor(number))) {
            refuse(place_, fmt::format("{} is no index of {}, of which there are {}", cited(value),
                                       rule.list, length));
        }
        store(value, number);
    }

    void check_list(json& value, const Rule& rule) {
        expect(value.is_array(), value, "a list");
        const bool length_fits =
            rule.lengths.empty()
                ? !value.empty()
                : std::ranges::find(rule.lengths, value.size()) != rule.lengths.end();
        expect(length_fits, value,
               rule.lengths.empty()
                   ? "a list that is not empty"
                   : fmt::format("a list of {} numbers", fmt::join(rule.lengths, " or ")));
        for (std::size_t i = 0; i < value.size(); ++i) {
            inside(std::to_string(i), [&] { check(value[i], *rule.element); });
        }
    }

    void check_object(json& value, const Shape& shape) {
        if (!shape.is_read) {
            value = json::object();
            return;
        }
        for (const Property& property : shape.properties) {
            const auto found = value.find(property.name);
            if (found != value.end()) {
                inside(property.name, [&] { check(*found, property.rule); });
            } else if (property.required) {
                refuse(place_, fmt::format("lacks '{}'", property.name));
            }
        }
        for (auto at = value.begin(); at != value.end();) {
            at = keeps(at.key(), at.value(), shape) ? std::next(at) : value.erase(at);
        }
    }

    bool keeps(const std::string& name, json& value, const Shape& shape) {
        if (std::ranges::find(shape.properties, name, &Property::name) != shape.properties.end()) {
            return true;
        }
        if (name == "extensions") {
            inside(name, [&] { check_extensions(value, shape); });
            return true;
        }
        if (name != "extras") {
            notes_.add("unknown " + name, place_ + "/" + name,
                       fmt::format("'{}' has no meaning here: left out", name));
        }
        return false;
    }

    void check_extensions(json& value, const Shape& shape) {
        expect(value.is_object(), value, "an object");
        for (auto at = value.begin(); at != value.end();) {
            const std::string& name = at.key();
            const auto known = std::ranges::find(shape.extensions, name,
                                                 [](const auto& entry) { return entry.first; });
            inside(name, [&] {
                expect(at.value().is_object(), at.value(), "an object");
                if (!declared_.contains(name)) {
                    notes_.add("undeclared " + name, place_,
                               fmt::format("{} is not listed in extensionsUsed", name));
                }
                if (known != shape.extensions.end()) {
                    check_object(at.value(), *known->second);
                } else {
                    unsupported_.try_emplace(name, place_);
                }
            });
            at = known != shape.extensions.end() ? std::next(at) : value.erase(at);
        }
    }

    Notes& notes_;
    std::map<std::string_view, std::size_t> lengths_;
    std::set<std::string, std::less<>> declared_;
    std::map<std::string, std::string> unsupported_;
    std::string place_;
};

}  // namespace

std::map<std::string, std::string> check_shape(json& document, Notes& notes) {
    RuleCheck check(document, notes);
    check.check(document, {.kind = Object, .shape = &document_shape()});
    return check.unsupported();
}

}  // namespace gazeloop::scene::gltf
