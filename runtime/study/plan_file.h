#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/study/plan.h"

namespace gazeloop::study {

/// As TOML; plan_of() reads the same plan of it, to the bit.
[[nodiscard]] std::string plan_text(const Plan& plan);

/// `name`: of the file, for messages. Errors (BadInput), with the line where there is one: no TOML,
/// no plan of this version, an unknown key (nearest named), a value of another kind or out of
/// range, larger than kLargestPlan.
[[nodiscard]] Expected<Plan> plan_of(std::string_view text, std::string_view name);

/// Errors: as plan_of(), and a file that cannot be read.
[[nodiscard]] Expected<Plan> read_plan(const std::filesystem::path& file);

inline constexpr std::size_t kLargestPlan = std::size_t{1} << 20U;  ///< bytes

}  // namespace gazeloop::study
