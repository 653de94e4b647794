#include "runtime/settings/nearest_name.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace gazeloop::settings {
namespace {

/// Optimal string alignment distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(last.begin(), last.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string unknown(std::string_view what, std::string_view text,
                    const std::optional<std::string>& nearest, std::span<const std::string> known) {
    return fmt::format("unknown {} '{}'{}; known: {}", what, text,
                       nearest ? fmt::format("; did you mean '{}'?", *nearest) : "",
                       fmt::join(known, ", "));
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view text,
                                        std::span<const std::string> candidates) {
    std::optional<std::string> nearest;
    std::size_t least = text.size() / 3 + 2;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(text, candidate);
        if (distance < least) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string unknown_name(std::string_view what, std::string_view text,
                         std::span<const std::string> candidates) {
    return unknown(what, text, nearest_name(text, candidates), candidates);
}

std::string unknown_key(std::string_view text, std::span<const std::string> keys) {
    // With its dot; empty for a key of no group.
    const auto group_of = [](std::string_view key) { return key.substr(0, key.find('.') + 1); };
    const std::string_view group = group_of(text);
    std::vector<std::string> known;
    std::ranges::copy_if(keys, std::back_inserter(known), [&](const std::string& key) {
        return !group.empty() && group_of(key) == group;
    });
    if (known.empty()) {
        for (const std::string& key : keys) {
            known.push_back(group_of(key).empty() ? key : fmt::format("{}*", group_of(key)));
        }
        const auto repeated = std::ranges::unique(known);
        known.erase(repeated.begin(), repeated.end());
    }
    return unknown("key", text, nearest_name(text, keys), known);
}

}  // namespace gazeloop::settings
