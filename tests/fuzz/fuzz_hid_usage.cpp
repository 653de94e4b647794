// Whatever a device says of itself must not confuse gazeloop doctor.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runtime/doctor/checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const bool found = gazeloop::doctor::describes_eye_tracker(bytes);
    // What was found before a byte cannot be undone by the bytes after it.
    for (std::size_t cut = 0; cut < size && cut < 64; ++cut) {
        if (gazeloop::doctor::describes_eye_tracker(bytes.substr(0, cut)) && !found) {
            __builtin_trap();
        }
    }
    return 0;
}
