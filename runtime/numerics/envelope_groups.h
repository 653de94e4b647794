#pragma once

#include <string>
#include <vector>

#include "runtime/foveation/picture/image_size.h"
#include "runtime/numerics/envelope.h"

namespace gazeloop::numerics {

/// The rows of one map and picture size with the fovea on, or off, the screen, over all sigmas and
/// gazes.
struct EnvelopeGroup {
    std::string map;
    foveation::ImageSize image;
    bool on_screen = false;
    std::size_t rows = 0;

    // From the row that comes closest to its target, among those with useful parameters if there
    // are any.
    double cpu_px = 0.0;     ///< the larger of forward and inverse
    double device_px = 0.0;  ///< likewise
    double bound_px = 0.0;   ///< likewise
    double conditioning_px = 0.0;
    double target_px = 0.0;

    // The largest of any row.
    double seam_px = 0.0;
    double fall_px = 0.0;
    double texels = 0.0;

    std::uint64_t not_finite = 0;
    std::uint64_t beyond_bound = 0;
    std::size_t useless = 0;      ///< rows whose parameters make no useful map
    std::string why_useless{};    ///< of the last of them
    std::string useless_where{};  ///< its sigma and fovea
    bool met = true;
};

/// In the order of the rows.
std::vector<EnvelopeGroup> grouped(const Envelope& envelope);

}  // namespace gazeloop::numerics
