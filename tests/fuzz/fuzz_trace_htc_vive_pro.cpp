#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "drivers/trace/htc_vive_pro.h"
#include "tests/fuzz/fuzz_trace.h"

/// Rows under a good header.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string header =
        fmt::format("{}\r\n", fmt::join(gazeloop::drivers::htc_vive_pro().columns, ";"));
    (void)gazeloop::fuzz::read_checked(header, {data, size}, "htc-vive-pro");
    return 0;
}
