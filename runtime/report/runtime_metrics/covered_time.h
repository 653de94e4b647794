#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gazeloop::report {

/// "100.250 to 160.500 s", of host times, for a message that says why two files do not meet.
[[nodiscard]] std::string covered_time(const std::optional<std::int64_t>& first_ns,
                                       const std::optional<std::int64_t>& last_ns);

}  // namespace gazeloop::report
