#include "runtime/render/srgb.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::render {
namespace {

std::array<float, 256> decoded_codes() {
    std::array<float, 256> table{};
    for (std::size_t code = 0; code < table.size(); ++code) {
        table[code] = static_cast<float>(srgb_decoded(static_cast<double>(code) / 255.0));
    }
    return table;
}

}  // namespace

double srgb_encoded(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c < 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

double srgb_decoded(double encoded) {
    const double c = std::clamp(encoded, 0.0, 1.0);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

glm::vec3 linear_of(const std::array<std::uint8_t, 3>& codes) {
    static const std::array<float, 256> kDecoded = decoded_codes();
    return {kDecoded[codes[0]], kDecoded[codes[1]], kDecoded[codes[2]]};
}

}  // namespace gazeloop::render
