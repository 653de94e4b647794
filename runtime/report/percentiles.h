#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::report {

/// Which percentiles a report shows.
class Percentiles {
  public:
    Percentiles() = default;  ///< 50, 90, 95, 99, 99.9

    /// Percents separated by commas, each above 0 and below 100, ascending, 20 at most. Errors
    /// (Usage): which of them is wrong, why, and what it should be.
    static Expected<Percentiles> parse(std::string_view text);

    [[nodiscard]] const std::vector<double>& percents() const { return percents_; }
    /// "p99.9": the shortest name that is exact.
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::vector<double> percents_{50.0, 90.0, 95.0, 99.0, 99.9};
};

}  // namespace gazeloop::report
