#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace gazeloop::doctor {

enum class Verdict {
    Ok,
    Warning,        ///< it works, but less or worse
    Failure,        ///< it does not work
    NotApplicable,  ///< nothing to check here, or not now
};
inline constexpr std::array<std::string_view, 4> kVerdictNames{"ok", "warning", "failure",
                                                               "not applicable"};

[[nodiscard]] constexpr std::string_view name(Verdict verdict) {
    return kVerdictNames[static_cast<std::size_t>(verdict)];
}

/// What one check found.
struct Finding {
    std::string check;  ///< AREA.NAME, stable
    Verdict verdict = Verdict::Ok;
    std::string found{};                              ///< for a person
    std::string remedy{};                             ///< one sentence; empty if there is none
    nlohmann::json facts = nlohmann::json::object();  ///< for a program
    bool stops_loop = false;                          ///< with Failure: the loop cannot run
};

void to_json(nlohmann::json& json, const Finding& finding);
void from_json(const nlohmann::json& json, Finding& finding);

/// Whether nothing found stops the loop.
[[nodiscard]] bool loop_can_run(std::span<const Finding> findings);

/// Everything as an aligned table, the outcome in its first line.
[[nodiscard]] std::string findings_text(std::span<const Finding> findings);

/// {"loop_can_run": ..., "counts": {...}, "checks": [...]}.
[[nodiscard]] nlohmann::json findings_json(std::span<const Finding> findings);

}  // namespace gazeloop::doctor
