#pragma once

#include <filesystem>

namespace gazeloop::files {

/// Where what can be made again is kept: $GAZELOOP_CACHE, else gazeloop in $XDG_CACHE_HOME, else in
/// ~/.cache. It need not be there.
[[nodiscard]] std::filesystem::path cache_folder();

}  // namespace gazeloop::files
