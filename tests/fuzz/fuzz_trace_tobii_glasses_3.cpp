#include <cstddef>
#include <cstdint>

#include "drivers/trace/formats/tobii_glasses_3.h"
#include "tests/fuzz/fuzz_trace.h"

/// A whole file of JSON lines.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    (void)gazeloop::fuzz::read_checked("", {data, size}, gazeloop::drivers::kTobiiGlasses3);
    return 0;
}
