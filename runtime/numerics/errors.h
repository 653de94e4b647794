#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "runtime/numerics/envelope.h"
#include "runtime/numerics/map_under_test.h"

namespace gazeloop::numerics {

/// The questions put to one map, grouped by what is judged of their answers.
struct Probes {
    std::vector<ProbeInput> inputs;
    std::size_t seam_begin = 0;  ///< before it: over the picture; from it: beside the seam
    std::size_t line_begin = 0;  ///< from it: lines outward, kLineLength each
};
inline constexpr std::size_t kLineLength = 256;

/// Half of the positions evenly over the picture, half evenly over the logarithm of the distance
/// from the fovea; then those beside the seam, then four lines.
Probes make_probes(const MapUnderTest& map, foveation::ImageSize image, std::size_t positions,
                   std::mt19937_64& random);

/// How exact the answers are; bounds, conditioning and violations go to the row. Precondition:
/// row.image.
EnvelopeRow::Errors judge(const MapUnderTest& map, const Probes& probes,
                          const std::vector<ProbeOutput>& outputs, EnvelopeRow& row);

}  // namespace gazeloop::numerics
