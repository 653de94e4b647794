#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_trace.h"

/// A whole file, header and all.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    (void)gazeloop::fuzz::read_checked("", {data, size}, "auto");
    return 0;
}
