#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace gazeloop::scene::gltf {

/// Integers beyond it are not exact in a double.
inline constexpr double kMostInteger = 9007199254740991.0;

struct Shape;

/// What a value may be.
struct Rule {
    enum class Kind : std::uint8_t { Boolean, Integer, Number, Text, Index, Object, List, Map };
    Kind kind = Kind::Boolean;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool above_min = false;                 ///< min itself is not allowed
    std::vector<double> numbers{};          ///< the only ones; empty: all
    std::vector<std::string_view> words{};  ///< the only ones; empty: all
    std::string_view list{};                ///< Index: of which of the document's lists
    const Shape* shape = nullptr;           ///< Object
    std::shared_ptr<const Rule> element{};  ///< List, Map
    std::vector<std::size_t> lengths{};     ///< List: the only ones; empty: 1 or more
};

struct Property {
    std::string_view name;
    Rule rule;
    bool required = false;
};

struct Shape {
    std::vector<Property> properties;
    /// Supported extensions that may be here.
    std::vector<std::pair<std::string_view, const Shape*>> extensions{};
    bool is_read = true;  ///< else nothing in it is looked at
};

/// What the standard allows a document to hold (glTF 2.0 section 5, and the supported extensions).
[[nodiscard]] const Shape& document_shape();

}  // namespace gazeloop::scene::gltf
