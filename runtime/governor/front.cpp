#include "runtime/governor/front.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace gazeloop::governor {
namespace {

constexpr double kLeast_ms = 1e-4;
constexpr double kMost_ms = 1e6;
constexpr double kMostLoss = 1e6;
/// What front_text() puts between levels, and between a level's parts.
constexpr char kBetweenLevels = ';';
constexpr char kBetweenParts = ',';

bool is_word(std::string_view text) {
    return !text.empty() && text.find_first_of(" \t\n;,") == std::string_view::npos;
}

std::string fault_of_level(const Level& level) {
    if (!is_word(level.method)) {
        return fmt::format("method = '{}': the name of a method is needed", level.method);
    }
    for (const auto& [key, text] : level.settings) {
        if (!is_word(key) || !is_word(text)) {
            return fmt::format(
                "'{}={}': a level's settings are single words without commas and semicolons: leave "
                "such a point out",
                key, text);
        }
    }
    if (!(level.ms >= kLeast_ms && level.ms <= kMost_ms)) {
        return fmt::format("ms = {}: must lie in [{}, {}]", level.ms, kLeast_ms, kMost_ms);
    }
    if (!(level.loss >= 0.0 && level.loss <= kMostLoss)) {
        return fmt::format("loss = {}: must lie in [0, {}]", level.loss, kMostLoss);
    }
    return {};
}

std::string settings_text(const Level& level) {
    std::string text;
    for (const auto& [key, value] : level.settings) {
        text += fmt::format(" {}={}", key, value);
    }
    return text;
}

std::vector<std::string> parts_of(std::string_view text, char between) {
    std::vector<std::string> parts;
    std::istringstream in{std::string(text)};
    for (std::string part; std::getline(in, part, between);) {
        parts.push_back(part);
    }
    return parts;
}

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

std::unexpected<Error> refuse(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

}  // namespace

std::string Level::text() const { return method + settings_text(*this); }

std::optional<FrontFault> fault_of(const Front& front) {
    if (!is_word(front.figure)) {
        return FrontFault{
            0, fmt::format("figure = '{}': the name of a trade's figure is needed", front.figure)};
    }
    if (front.levels.empty() || front.levels.size() > kMostLevels) {
        return FrontFault{front.levels.empty() ? 0 : kMostLevels,
                          fmt::format("a front has 1 to {} levels, this one {}", kMostLevels,
                                      front.levels.size())};
    }
    for (std::size_t at = 0; at < front.levels.size(); ++at) {
        const Level& level = front.levels[at];
        if (std::string fault = fault_of_level(level); !fault.empty()) {
            return FrontFault{at, std::move(fault)};
        }
        if (at == 0) {
            continue;
        }
        const Level& better = front.levels[at - 1];
        if (!(level.ms < better.ms) || !(level.loss > better.loss)) {
            return FrontFault{
                at, fmt::format("{} ({} ms, loss {}) is no point of a front after {} ({} ms, loss "
                                "{}): each level must take less time and lose more than the one "
                                "before: leave one of them out",
                                level.text(), level.ms, level.loss, better.text(), better.ms,
                                better.loss)};
        }
    }
    return std::nullopt;
}

std::string front_text(const Front& front) {
    std::string text = front.figure;
    for (const Level& level : front.levels) {
        text += fmt::format("{}{}{}{}{}{}", kBetweenLevels, level.text(), kBetweenParts, level.ms,
                            kBetweenParts, level.loss);
    }
    return text;
}

Expected<std::vector<std::pair<std::string, std::string>>> parse_level_settings(
    std::string_view text) {
    std::vector<std::pair<std::string, std::string>> settings;
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
            return refuse(fmt::format("'{}' is no KEY=VALUE", word));
        }
        settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    return settings;
}

Expected<Front> parse_front(std::string_view text) {
    const std::vector<std::string> levels = parts_of(text, kBetweenLevels);
    Front front{.figure = levels.empty() ? "" : levels.front()};
    for (std::size_t at = 1; at < levels.size(); ++at) {
        const std::vector<std::string> parts = parts_of(levels[at], kBetweenParts);
        const auto ms = parts.size() == 3 ? number(parts[1]) : std::nullopt;
        const auto loss = parts.size() == 3 ? number(parts[2]) : std::nullopt;
        if (!ms || !loss) {
            return refuse(fmt::format(
                "level {} of the front: '{}' is not METHOD KEY=VALUE...,MS,LOSS", at, levels[at]));
        }
        const std::size_t blank = std::min(parts[0].find(' '), parts[0].size());
        auto settings = parse_level_settings(std::string_view(parts[0]).substr(blank));
        if (!settings) {
            return refuse(fmt::format("level {} of the front: {}", at, settings.error().message));
        }
        front.levels.push_back({.method = parts[0].substr(0, blank),
                                .settings = std::move(*settings),
                                .ms = *ms,
                                .loss = *loss});
    }
    if (const auto fault = fault_of(front)) {
        return refuse(fmt::format("level {} of the front: {}", fault->level + 1, fault->message));
    }
    return front;
}

}  // namespace gazeloop::governor
