#pragma once

namespace gazeloop::run {

/// From here on SIGINT and SIGTERM only set a flag. A second one of the same kind kills as usual.
void catch_interrupts();

/// Whether one of them has come.
[[nodiscard]] bool interrupted();

/// As long as it lives, SIGINT and SIGTERM end the program at once, with exit code 130; outputs
/// that are not finished are removed. For what reads and computes for long, has nothing to close,
/// and asks interrupted() nowhere. One at a time.
class EndsWhenInterrupted {
  public:
    EndsWhenInterrupted();
    EndsWhenInterrupted(const EndsWhenInterrupted&) = delete;
    EndsWhenInterrupted& operator=(const EndsWhenInterrupted&) = delete;
    ~EndsWhenInterrupted();
};

}  // namespace gazeloop::run
