#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace gazeloop::tests {

/// Time on a processor of this process's thread of that name, seconds; 0 where there is none.
inline double thread_seconds(const std::string& name) {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream comm(entry.path() / "comm");
        std::string found;
        std::getline(comm, found);
        if (found == name) {
            std::ifstream schedstat(entry.path() / "schedstat");
            double ns = 0.0;
            schedstat >> ns;
            return ns * 1e-9;
        }
    }
    return 0.0;
}

}  // namespace gazeloop::tests
