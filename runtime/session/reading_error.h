#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::session {

/// BadInput: what is wrong with the file.
Error bad_session(const std::filesystem::path& file, std::string_view what);

/// The exception that is being handled, as an error that names the file. Only for FormatError and
/// DatabaseError; any other exception is thrown on. Precondition: called in a handler.
Error reading_error(const std::filesystem::path& file);

}  // namespace gazeloop::session
