#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/numerics/table_builds.h"

namespace gazeloop::vulkan {
class Context;
}

namespace gazeloop::numerics {

struct EnvelopeOptions {
    bool quick = false;  ///< one picture size, fewer maps and draws: for tests
    std::uint64_t seed = 1;
};

/// One map at one gaze: the largest errors over its probes, in pixels of the picture, against
/// double precision.
///
/// Forward: the error of the position that the float shares of a pixel stand for. Inverse: the
/// error of the position computed for the centre of the texel that a pixel lies in. Both are
/// measured where a position has consequences: on the screen, between the centres of the first and
/// the last column, beyond which the sampler clamps.
struct EnvelopeRow {
    std::string map;
    foveation::ImageSize image;
    double sigma = 0.0;  ///< 0: the map has none
    foveation::LpSize lp;
    std::string fovea;
    bool on_screen = false;  ///< the fovea

    struct Errors {
        double forward_px = 0.0;
        double inverse_px = 0.0;
        double seam_px = 0.0;  ///< forward, beside the direction where the angle wraps
        double fall_px = 0.0;  ///< largest step back of u along a line outward
        std::uint64_t not_finite = 0;

        [[nodiscard]] double largest_px() const {
            return std::max({forward_px, inverse_px, seam_px});
        }
    };
    Errors cpu{};     ///< the float mirror
    Errors device{};  ///< the shader

    double forward_bound_px = 0.0;  ///< largest, as derived (foveation::MapError)
    double inverse_bound_px = 0.0;
    double conditioning_px = 0.0;    ///< what float32 u and v cost alone
    double forward_texels = 0.0;     ///< the forward error (device) over the texel's extent
    std::uint64_t beyond_bound = 0;  ///< probes whose error exceeds its own bound
    double stated_px = 0.0;          ///< what every map is to keep: .01 or .05
    double target_px = 0.0;  ///< of the mirror: stated_px, or twice the conditioning if more
    double device_target_px = 0.0;
    std::string
        useless{};  ///< why the parameters make no useful map, whatever its errors; or empty

    [[nodiscard]] bool met() const {
        return cpu.largest_px() <= target_px && device.largest_px() <= device_target_px &&
               std::max(cpu.fall_px, device.fall_px) <= conditioning_px && beyond_bound == 0 &&
               cpu.not_finite + device.not_finite == 0;
    }
    /// Met, but not by stated_px: float32 u and v alone cost too much.
    [[nodiscard]] bool met_for_float32() const { return met() && cpu.largest_px() > stated_px; }
};

/// Counts of maps and gazes. Those whose parameters leave nothing to draw count apart.
struct EnvelopeCounts {
    std::size_t useful = 0;
    std::size_t met = 0;          ///< of the useful ones
    std::size_t for_float32 = 0;  ///< of those met
    std::size_t useless = 0;
};

struct Envelope {
    std::string device;
    std::string driver;
    std::vector<EnvelopeRow> rows;
    std::vector<TableBuild> tables;
    std::uint64_t draws = 0;  ///< of random extreme maps, gazes and positions, on the mirror
    std::uint64_t draws_not_finite = 0;
    std::uint64_t draws_outside = 0;  ///< shares outside [0, 1]
    double seconds = 0.0;

    [[nodiscard]] EnvelopeCounts counts() const;
    [[nodiscard]] bool met() const;
};

/// Measures every map of the library on this device.
Envelope measure_envelope(const vulkan::Context& context, const EnvelopeOptions& options);

}  // namespace gazeloop::numerics
