#pragma once

namespace gazeloop::run {

/// From here on SIGINT and SIGTERM end the program at once, with exit code 130; outputs that are
/// not finished are removed. For all that reads and computes and has nothing to close.
void end_when_interrupted();

/// As long as it lives, SIGINT and SIGTERM only set a flag, for what asks interrupted() and has
/// something to close. A second one of the same kind kills as usual. One at a time.
class CatchesInterrupts {
  public:
    CatchesInterrupts();
    CatchesInterrupts(const CatchesInterrupts&) = delete;
    CatchesInterrupts& operator=(const CatchesInterrupts&) = delete;
    ~CatchesInterrupts();
};

/// Whether one of them has come.
[[nodiscard]] bool interrupted();

}  // namespace gazeloop::run
