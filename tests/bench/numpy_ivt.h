#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace gazeloop::bench {

/// What plain I-VT in numpy (ivt.py) costs, ns of processor time per sample.
struct NumpyIvt {
    double whole_ns = 0.0;   ///< of a whole recording at once
    double online_ns = 0.0;  ///< of samples that come one by one
};

/// Measured on these directions, 1000 per second, over and over for `seconds`. None where there is
/// no numpy, which is said on stderr. Throws std::runtime_error where it finds no saccade.
[[nodiscard]] std::optional<NumpyIvt> numpy_ivt(std::span<const glm::dvec3> directions,
                                                double seconds);

}  // namespace gazeloop::bench
