// Any bytes as a measurement's file: refused by name, or figures that can be.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/probe/measurement.h"
#include "runtime/probe/region.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (const auto region = probe::parse_region("lamp", text)) {
        require(region->width > 0 && region->height > 0);
    }
    const auto read = probe::parse_measurement(text, "fuzz");
    if (!read) {
        require(read.error().kind == ErrorKind::BadInput &&
                read.error().message.starts_with("fuzz:"));
        return 0;
    }
    if (read->eye_lost) {
        require(read->eye_lost->trials > 0 && std::isfinite(read->eye_lost->mean_ms) &&
                read->eye_lost->uncertain_ms.value_or(0.0) >= 0.0);
    }
    return 0;
}
