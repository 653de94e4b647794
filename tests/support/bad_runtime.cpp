// An OpenXR runtime or Vulkan driver that does not get far. GAZELOOP_TEST_RUNTIME says how it fails
// as it is loaded: crash, hang, exit; else it loads, and is no runtime.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

__attribute__((constructor)) void loaded() {
    const char* const asked = std::getenv("GAZELOOP_TEST_RUNTIME");
    const std::string_view how = asked != nullptr ? asked : "";
    if (how.empty()) {
        return;
    }
    std::fprintf(stderr, "bad runtime: about to %s\n", asked);
    std::fflush(stderr);
    if (how == "crash") {
        std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would make an exit of it
        std::raise(SIGSEGV);
    } else if (how == "exit") {
        _exit(7);
    }
    while (how == "hang") {
        pause();
    }
}

}  // namespace
