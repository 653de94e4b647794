#pragma once

#include <cstdint>

#include "runtime/foveation/eye/mar_line.h"
#include "runtime/gaze/view.h"

namespace gazeloop::openxr_layer {

/// How the pixels of an application with an inset are shared out.
struct InsetPolicy {
    double periphery = 0.5;  ///< pixels per pixel of the full picture, each way, in (0, 1]
    double blend = 0.2;      ///< share of half an inset's sides over which it is blended, in [0, 1)
    double margin_deg = 0.5;  ///< how far off the gaze may be
    foveation::MarLine acuity;
};

struct PictureSize {
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;

    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// The size of the picture around an inset, where the full one has this size: at least a pixel.
[[nodiscard]] PictureSize outer_size(const PictureSize& full, const InsetPolicy& policy);

/// How large an inset is, in pixels of the full picture, which are its own. Beyond it the picture
/// around it has as many pixels as the eye asks for: where a cycle of the acuity line takes two of
/// them (Guenter et al. 2012), further out by the margin, and by the band in which the inset is
/// blended. The whole picture where nothing can be left out. `view`: the full picture's. Beyond
/// that place the eye always asks for less, because the line rises and pixels of a plane become
/// smaller. Precondition: is_valid(view).
[[nodiscard]] PictureSize inset_size(const gaze::EyeView& view, const InsetPolicy& policy);

/// Where an inset lies in the full picture: on whole pixels of it, so that its pixels are those of
/// the full one.
struct InsetPlace {
    std::uint32_t x_px = 0;  ///< of its left upper corner
    std::uint32_t y_px = 0;
    gaze::FieldOfView fov;
};

/// Around a fovea, and inside the picture. Preconditions: is_valid(view), 1 <= size <= the view's.
[[nodiscard]] InsetPlace place_inset(const gaze::EyeView& view, const PictureSize& size,
                                     const gaze::PixelPosition& fovea);

/// A part of a picture, as shares of its sides; origin top-left.
struct PicturePart {
    double x = 0.0;
    double y = 0.0;
    double width = 1.0;
    double height = 1.0;
};

/// What of a field of view another one in the same plane covers. Precondition: is_valid() of views
/// of both.
[[nodiscard]] PicturePart part_of(const gaze::FieldOfView& whole, const gaze::FieldOfView& inner);

}  // namespace gazeloop::openxr_layer
