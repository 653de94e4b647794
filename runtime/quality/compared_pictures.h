#pragma once

#include "runtime/error.h"
#include "runtime/gaze/view.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// Brighter than any picture, also in half floats, and small enough that squares of contrasts stay
/// finite.
inline constexpr float kMostLight = 1e6F;

/// Whether two pictures can be compared as what this view shows. Errors (BadInput): no pixels,
/// fewer or more of them than the size says, sizes that differ from each other or from the view's,
/// a value that is not a number or infinite; the message says which picture, where the first such
/// pixel is and how many there are.
Expected<void> check_pictures(const render::LinearPicture& reference,
                              const render::LinearPicture& test, const gaze::EyeView& view);

}  // namespace gazeloop::quality
