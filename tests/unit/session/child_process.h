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

}  // namespace gazeloop::session
