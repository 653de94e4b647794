#pragma once

#include <cstddef>
#include <random>

namespace gazeloop::statistics {

/// Uniform in [0, end), by the upper bits of a product (Lemire 2019), whose bias of end / 2^64 is
/// nothing here. The same with every standard library.
[[nodiscard]] inline std::size_t draw_below(std::mt19937_64& random, std::size_t end) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::size_t>((static_cast<Wide>(random()) * end) >> 64U);
}

}  // namespace gazeloop::statistics
