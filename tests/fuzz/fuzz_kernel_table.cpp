// Any bytes as a kernel's table (the first one says which kind): an error with file and line, or a
// kernel that rises, stays in [0, 1] and inverts.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "runtime/methods/kernel_table_file.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    if (size == 0) {
        return 0;
    }
    std::istringstream in(std::string(data + 1, data + size));
    const auto kernel = methods::read_kernel_table(in, "fuzz", data[0] % 2 == 1);
    if (!kernel) {
        require(kernel.error().kind == ErrorKind::BadInput &&
                kernel.error().message.starts_with("fuzz:"));
        return 0;
    }
    const std::string line = methods::kernel_samples(*kernel);
    const auto again = methods::read_kernel_samples(line, "fuzz");
    require(again.has_value() && methods::kernel_samples(*again) == line);
    double before = 0.0;
    for (int i = 0; i <= 64; ++i) {
        const double x = i / 64.0;
        const double y = (*kernel)(x);
        require(y >= before && y <= 1.0);
        before = y;
        const double back = kernel->inverse(x);
        require(back >= 0.0 && back <= 1.0);
        require(std::abs((*kernel)(back)-x) <= 1e-9 + 1e-15 * kernel->derivative(back));
    }
    return 0;
}
