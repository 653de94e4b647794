#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace gazeloop::tests {

/// Gives up root's rights, to which no file is closed; whether that worked. Who is not root stays
/// as he is. In a child only.
inline bool become_nobody() {
    constexpr uid_t kNobody = 65534;
    return geteuid() != 0 || (setgid(kNobody) == 0 && setuid(kNobody) == 0);
}

/// Why a test cannot run that become_nobody() is part of; empty: it can.
inline std::string missing_for_nobody() {
    const pid_t child = fork();
    if (child == 0) {
        _exit(become_nobody() ? 0 : 1);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0
               ? ""
               : "root may not become another user here (no CAP_SETUID or CAP_SETGID): run the "
                 "tests as another user";
}

}  // namespace gazeloop::tests
