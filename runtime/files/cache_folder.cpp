#include "runtime/files/cache_folder.h"

#include <pwd.h>
#include <unistd.h>

#include <string>

#include "runtime/environment.h"

namespace gazeloop::files {

std::filesystem::path cache_folder() {
    if (const auto cache = environment_value("GAZELOOP_CACHE")) {
        return *cache;
    }
    if (const auto cache = environment_value("XDG_CACHE_HOME")) {
        return std::filesystem::path(*cache) / "gazeloop";
    }
    const passwd* const user = getpwuid(getuid());
    const std::string home = user != nullptr ? user->pw_dir : "/";
    return std::filesystem::path(environment_value("HOME").value_or(home)) / ".cache" / "gazeloop";
}

}  // namespace gazeloop::files
