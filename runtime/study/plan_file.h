#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/settings/settings.h"
#include "runtime/study/plan.h"

namespace gazeloop::study {

/// As TOML; plan_of() reads the same plan of it, to the bit.
[[nodiscard]] std::string plan_text(const Plan& plan);

/// `name`: of the file, for messages. Errors (BadInput), with the line where there is one: no TOML,
/// no plan of this version, an unknown key (nearest named), a value of another kind or out of
/// range, larger than kLargestPlan; a setting that `known` has not, or not with this value. All
/// that the plan sets is set there. Null: the settings are not looked at, since an analysis may be
/// of answers that are older than they.
[[nodiscard]] Expected<Plan> plan_of(std::string_view text, std::string_view name,
                                     settings::Settings* known = nullptr);

/// Errors: as plan_of(), and a file that cannot be read.
[[nodiscard]] Expected<Plan> read_plan(const std::filesystem::path& file,
                                       settings::Settings* known);

inline constexpr std::size_t kLargestPlan = std::size_t{1} << 20U;  ///< bytes

}  // namespace gazeloop::study
