#pragma once

#include <span>
#include <string>

#include "runtime/settings/settings.h"

namespace gazeloop::settings {

/// A value with the option that sets it.
struct NamedAssignment {
    std::string_view key;
    std::string_view text;
    std::string_view origin;
};

/// Where values come from, in the order in which they count: the last one wins.
struct Layers {
    bool standard_files = false;  ///< the system's and the user's configuration
    std::span<const std::string> files{};
    std::span<const std::string> assignments{};  ///< "KEY=VALUE", of --set
    std::span<const NamedAssignment> named{};
};

/// Errors: as Settings::load() and set(); Usage for an assignment without '='. What came before the
/// error stays set.
Expected<void> apply(const Layers& layers, Settings& settings);

}  // namespace gazeloop::settings
