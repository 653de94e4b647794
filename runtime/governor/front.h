#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::governor {

/// One measured way to draw frames: a method, its settings, and what they cost and lose.
struct Level {
    std::string method{};
    /// Of the method, others than those in force: key, text.
    std::vector<std::pair<std::string, std::string>> settings{};
    double ms = 0.0;    ///< of a frame, where it was measured
    double loss = 0.0;  ///< the front's figure there; 0: identical to the reference

    /// "kfr kfr.sigma=1.8 kfr.alpha=4".
    [[nodiscard]] std::string text() const;

    friend bool operator==(const Level&, const Level&) = default;
};

/// Most levels that one front has: each has a renderer of its own while it is in use.
inline constexpr std::size_t kMostLevels = 8;

/// Points of a trade that no other one beats in both cost and quality, the best picture first: each
/// takes less time and loses more than the one before.
struct Front {
    std::string figure{};  ///< of which `loss` is a value: contrast, flip
    std::vector<Level> levels{};

    friend bool operator==(const Front&, const Front&) = default;
};

/// Why something is no front, and by which level.
struct FrontFault {
    std::size_t level = 0;  ///< 0 also where all are at fault
    std::string message;
};

/// None: it is one. The rest of this program takes no other.
[[nodiscard]] std::optional<FrontFault> fault_of(const Front& front);

/// A front as one line of text, for a setting.
[[nodiscard]] std::string front_text(const Front& front);
/// That line again. Errors (BadInput): it is not one, or no front.
Expected<Front> parse_front(std::string_view text);

/// "KEY=VALUE KEY=VALUE". Errors (BadInput): a word that is not.
Expected<std::vector<std::pair<std::string, std::string>>> parse_level_settings(
    std::string_view text);

}  // namespace gazeloop::governor
