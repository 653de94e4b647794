#include "runtime/session/session_info.h"

#include <algorithm>

namespace gazeloop::session {

std::optional<std::string_view> SessionInfo::config(std::string_view key) const {
    const auto found = std::ranges::find(header.config, key, &NamedValue::name);
    return found == header.config.end() ? std::nullopt
                                        : std::optional<std::string_view>(found->value);
}

}  // namespace gazeloop::session
