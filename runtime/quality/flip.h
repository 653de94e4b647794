#pragma once

#include "runtime/error.h"
#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// What LDR-FLIP finds: 0 is identical, 1 the largest difference of colours.
struct FlipResult {
    double mean = 0.0;
    Plane map;  ///< per pixel, [0, 1]
};

/// The pixels per degree that FLIP's authors assume where nothing is known of the display.
inline constexpr double kFlipUsualPixelsPerDegree = 67.0206;
inline constexpr double kFlipLeastPixelsPerDegree = 0.01;
inline constexpr double kFlipMostPixelsPerDegree = 300.0;

/// LDR-FLIP (Andersson et al. 2020, "FLIP: a difference evaluator for alternating images"): how
/// different two pictures look to someone who flips between them and looks at each place in turn.
/// So it knows no gaze, and no display but its pixels per degree. Symmetric. What a picture holds
/// beyond [0, 1] is cut. Errors (Usage): pixels per degree out of range. Precondition:
/// check_pictures accepts the two.
Expected<FlipResult> ldr_flip(const render::LinearPicture& reference,
                              const render::LinearPicture& test, double pixels_per_degree,
                              const RowWork& work);

}  // namespace gazeloop::quality
