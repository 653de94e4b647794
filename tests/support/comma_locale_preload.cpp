// Preloaded: a library that sets the user's locale as it is loaded, and again when a recording is
// opened, as some runtimes and input methods do.
#include <dlfcn.h>
#include <sqlite3.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>

namespace {

__attribute__((constructor)) void set_comma() {
    if (std::setlocale(LC_ALL, std::getenv("GAZELOOP_TEST_LOCALE")) == nullptr) {
        std::fputs("there is no such locale\n", stderr);
        std::abort();
    }
}

}  // namespace

extern "C" int sqlite3_open_v2(const char* file, sqlite3** database, int flags, const char* vfs) {
    set_comma();
    const auto next =
        reinterpret_cast<decltype(&sqlite3_open_v2)>(dlsym(RTLD_NEXT, "sqlite3_open_v2"));
    return next(file, database, flags, vfs);
}
