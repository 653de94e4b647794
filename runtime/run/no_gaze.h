#pragma once

#include <string>
#include <string_view>

namespace gazeloop::run {

/// What helps where a live source, as --gaze has it, gave no sample in a whole run.
[[nodiscard]] std::string no_gaze_remedy(std::string_view gaze);

}  // namespace gazeloop::run
