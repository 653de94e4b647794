#pragma once

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <functional>

namespace gazeloop::session {

/// Starts a process that runs `body` and ends with its result as the exit status.
inline pid_t start_child(const std::function<int()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        int result = 255;
        try {
            result = body();
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
        _exit(result);
    }
    return child;
}

/// The exit status of `body` in a process of its own, -1 if that was killed.
inline int run_in_child(const std::function<int()>& body) {
    int status = 0;
    waitpid(start_child(body), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Gives up root's rights, to which no folder is closed. In a child only.
inline bool become_nobody() {
    constexpr uid_t kNobody = 65534;
    return geteuid() != 0 || setuid(kNobody) == 0;
}

}  // namespace gazeloop::session
