#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gazeloop::trade {

/// What the processor's packages take, by the counters of Linux' powercap (RAPL). They are of whole
/// packages, whoever lets them work, without memory modules and graphics cards, and move about once
/// in a millisecond (kernel.org: admin-guide/pm/powercap).
class ProcessorEnergy {
  public:
    explicit ProcessorEnergy(const std::filesystem::path& powercap = "/sys/class/powercap");

    /// Why there are no counters, with the remedy; empty: there are.
    [[nodiscard]] const std::string& unavailable() const { return unavailable_; }

    /// Taken since construction, all packages, J. Must be called more often than a counter wraps (a
    /// minute at least, by its stated range, of any processor). None: a counter cannot be read.
    [[nodiscard]] std::optional<double> joules();

  private:
    struct Package {
        std::filesystem::path counter;
        std::uint64_t range_uj = 0;  ///< the counter's greatest value
        std::uint64_t last_uj = 0;
    };

    std::string unavailable_;
    std::vector<Package> packages_;
    std::uint64_t taken_uj_ = 0;
};

}  // namespace gazeloop::trade
