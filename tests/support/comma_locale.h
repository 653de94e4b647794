#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace gazeloop::tests {

/// A locale with a decimal comma.
struct CommaLocale {
    std::string folder;  ///< for LOCPATH
    std::string name;
};

/// Makes one in a folder, since machines rarely have one installed (Debian: package locales).
/// Nothing where that does not work.
inline std::optional<CommaLocale> make_comma_locale(const std::string& folder) {
    const CommaLocale locale{folder, "de_DE.UTF-8"};
    const std::string command = "localedef --no-archive -i de_DE -f UTF-8 '" + folder + "/" +
                                locale.name + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0 ? std::optional(locale) : std::nullopt;
}

}  // namespace gazeloop::tests
