#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/background_process.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Monado as a service of its own, with a simulated headset whose head does not move, in a runtime
/// folder of its own, so that no other service can be meant.
class MonadoService {
  public:
    /// Where ./dev test has put it; nothing: it is not there.
    static std::optional<std::string> folder();

    /// What a program needs to be a client of a service in the scratch folder, started or not.
    static Environment client_environment(const ScratchFolder& scratch);

    /// Starts it and waits until it takes clients. `more`: which compositor, which display.
    MonadoService(const ScratchFolder& scratch, const Environment& more);

    [[nodiscard]] bool ready() const { return ready_; }
    [[nodiscard]] BackgroundProcess& process() { return process_; }

  private:
    BackgroundProcess process_;
    bool ready_;
};

}  // namespace gazeloop::tests
