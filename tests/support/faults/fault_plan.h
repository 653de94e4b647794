#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::tests {

/// Which calls a fault layer spoils, and how. Text form, in the environment variable that the layer
/// names: faults separated by ';', each FUNCTION@CALL=EFFECT or FUNCTION@CALL+COUNT=EFFECT. CALL is
/// the first call of that function that is spoilt, from 1; COUNT how many in a row (default 1).
class FaultPlan {
  public:
    /// Ends the process with a message if the text is not of that form, so that no test passes
    /// because its fault was never injected.
    explicit FaultPlan(std::string_view text);

    /// From the environment; without that variable, a plan without faults.
    static FaultPlan from_environment(const char* variable);

    /// Counts a call of the function; the effect that is due at it, if one is.
    std::optional<std::string_view> call(std::string_view function);

  private:
    struct Fault {
        std::string function;
        std::uint64_t first = 1;
        std::uint64_t count = 1;
        std::string effect;
    };
    std::vector<Fault> faults_;
    std::map<std::string, std::uint64_t, std::less<>> calls_;
};

/// Ends the process: a fault that the layer does not know.
[[noreturn]] void refuse_fault(std::string_view function, std::string_view effect);

}  // namespace gazeloop::tests
