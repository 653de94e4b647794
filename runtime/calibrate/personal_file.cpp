#include "runtime/calibrate/personal_file.h"

#include <fmt/core.h>
#include <pwd.h>
#include <unistd.h>

#include <cctype>

#include "runtime/environment.h"
#include "runtime/error.h"

namespace gazeloop::calibrate {
namespace {

/// Of a file's name: what a shell or a folder would misread is left out.
std::string plain(std::string_view text) {
    std::string plain;
    for (const char c : text) {
        plain += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    }
    return plain;
}

}  // namespace

std::string login_name() {
    const passwd* const entry = getpwuid(geteuid());
    return entry != nullptr ? entry->pw_name : std::to_string(geteuid());
}

std::filesystem::path personal_file(const std::string& user, std::string_view source) {
    const auto data = environment_value("XDG_DATA_HOME");
    const auto home = environment_value("HOME");
    if (!data && !home) {
        throw SetupError(ErrorKind::Usage,
                         "calibrate: neither XDG_DATA_HOME nor HOME is set: name the file with "
                         "--out FILE");
    }
    const std::filesystem::path folder =
        (data ? std::filesystem::path(*data) : std::filesystem::path(*home) / ".local" / "share") /
        "gazeloop" / "calibration";
    std::error_code error;
    if (std::filesystem::create_directories(folder, error)) {
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
    }
    if (error) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
    }
    return folder /
           fmt::format("{}.{}.toml", plain(user), plain(source.substr(0, source.find(':'))));
}

}  // namespace gazeloop::calibrate
