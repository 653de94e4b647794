#pragma once

#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/governor/front.h"

namespace gazeloop::governor {

/// A front by name (config/governor, built into the program) or by path (ends in .toml). Errors:
/// Usage for an unknown name; the message has the nearest one. BadInput, with the file and where
/// possible the line, for a file that cannot be read or parsed, or holds no front.
Expected<Front> load_front(std::string_view name);

/// The text of such a file. `made_by`: how it was measured, each line a comment.
/// Precondition: it is a front.
[[nodiscard]] std::string front_file(const Front& front, std::string_view made_by);

}  // namespace gazeloop::governor
