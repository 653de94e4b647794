#pragma once

namespace gazeloop::run {

/// From here on SIGINT and SIGTERM only set a flag. A second one of the same kind kills as usual.
void catch_interrupts();

/// Whether one of them has come.
[[nodiscard]] bool interrupted();

}  // namespace gazeloop::run
