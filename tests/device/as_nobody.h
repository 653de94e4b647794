#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>

#include "tests/support/nobody.h"

namespace gazeloop::tests {

/// Runs it, in a process of its own, as somebody who is not root; whether it returned true. An
/// exception ends that process: unwinding it would take the parent's devices away.
inline bool as_nobody(const std::function<bool()>& check) noexcept {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const bool passed = become_nobody() && check();
        std::fflush(nullptr);  // what failed, of which _exit would print nothing
        _exit(passed ? 0 : 1);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace gazeloop::tests
