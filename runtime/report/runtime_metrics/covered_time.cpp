#include "runtime/report/runtime_metrics/covered_time.h"

#include <fmt/format.h>

namespace gazeloop::report {

std::string covered_time(const std::optional<std::int64_t>& first_ns,
                         const std::optional<std::int64_t>& last_ns) {
    constexpr double kNsPerS = 1e9;
    return first_ns && last_ns
               ? fmt::format("{:.3f} to {:.3f} s", static_cast<double>(*first_ns) / kNsPerS,
                             static_cast<double>(*last_ns) / kNsPerS)
               : "no time";
}

}  // namespace gazeloop::report
