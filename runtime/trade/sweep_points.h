#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::trade {

/// One way to render: a method, and the settings that make this point another than its neighbours.
struct SweepPoint {
    std::string method;
    std::vector<std::pair<std::string, std::string>> settings{};  ///< key, text

    /// "kfr.sigma=1.8 kfr.alpha=4"; empty without settings.
    [[nodiscard]] std::string settings_text() const;

    friend bool operator==(const SweepPoint&, const SweepPoint&) = default;
};

/// One setting and the values that it takes in turn.
struct Varied {
    std::string key;
    std::vector<std::string> values;
};

/// "KEY=V1,V2,..." Errors (Usage): no key, no value, an empty value.
Expected<Varied> parse_varied(const std::string& text);

/// Most points that one sweep has.
inline constexpr std::size_t kMostSweepPoints = 1000;

/// Each method with every combination of the settings that are its own ("kfr.sigma" is kfr's), or
/// every method's: the filters of render.*. The last one varies fastest. Errors (Usage): no method,
/// a key varied twice, a key that is no method's here, more than kMostSweepPoints.
Expected<std::vector<SweepPoint>> sweep_points(const std::vector<std::string>& methods,
                                               const std::vector<Varied>& varied);

/// Whether a key is one of the filters of render.* that any method's pictures may pass through.
[[nodiscard]] bool is_filter(std::string_view key);

}  // namespace gazeloop::trade
