#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <sstream>

#include "drivers/trace/native_trace.h"
#include "tests/fuzz/fuzz_trace.h"

namespace {

std::string written(const gazeloop::gaze::GazeTrace& trace) {
    std::ostringstream out;
    gazeloop::drivers::write_native_trace(trace, out);
    return out.str();
}

}  // namespace

/// Rows under a good header; what is read must survive being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using gazeloop::fuzz::require;
    static const std::string header =
        fmt::format("{}\n", fmt::join(gazeloop::drivers::native_trace().columns, ","));
    const auto trace = gazeloop::fuzz::read_checked(header, {data, size}, "gazeloop");
    if (trace) {
        const std::string text = written(*trace);
        std::istringstream in(text);
        const auto again = gazeloop::drivers::read_trace(in, "again", {.format = "gazeloop"});
        require(again.has_value() && written(*again) == text);
    }
    return 0;
}
