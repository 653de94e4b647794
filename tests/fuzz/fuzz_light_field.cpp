// Any bytes as a light field's file: an error that names it, or a grid that is one and reads the
// same again.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "runtime/scene/light_field_file.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    std::istringstream in(std::string(data, data + size));
    const auto grid = scene::read_light_field(in, "fuzz");
    if (!grid) {
        require(grid.error().kind == ErrorKind::BadInput &&
                grid.error().message.starts_with("fuzz:"));
        return 0;
    }
    require(light_field::check(*grid).has_value());
    std::istringstream text(scene::light_field_text(*grid));
    const auto again = scene::read_light_field(text, "fuzz");
    require(again.has_value() && again->columns == grid->columns && again->rows == grid->rows &&
            again->spacing_m == grid->spacing_m);
    require(std::abs(again->half_tangents.x / grid->half_tangents.x - 1.0) < 1e-9);
    return 0;
}
