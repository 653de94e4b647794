#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/formats/aria.h"
#include "drivers/trace/formats/gazebase_vr.h"
#include "drivers/trace/formats/pico_neo_3.h"
#include "drivers/trace/formats/pupil_core.h"
#include "drivers/trace/formats/pupil_labs.h"
#include "drivers/trace/formats/tobii_pro_lab.h"
#include "tests/fuzz/fuzz_trace.h"

namespace {

using gazeloop::drivers::TraceFormat;

/// The header of a format, with a unit where one is asked for.
std::string header_of(const TraceFormat& format) {
    std::string header = fmt::format("{}\n", fmt::join(format.columns, ";"));
    for (std::size_t at = 0; (at = header.find("[*]", at)) != std::string::npos;) {
        header.replace(at, 3, "[ms]");
    }
    return header;
}

}  // namespace

/// The first byte picks another program's table; the others are rows under its good header.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop::drivers;
    static const std::array formats{&angle_table(), &aria(),       &gazebase_vr(),  &pico_neo_3(),
                                    &pupil_core(),  &pupil_labs(), &tobii_pro_lab()};
    if (size == 0) {
        return 0;
    }
    const TraceFormat& format = *formats[data[0] % formats.size()];
    (void)gazeloop::fuzz::read_checked(header_of(format), {data + 1, size - 1}, format.name);
    return 0;
}
