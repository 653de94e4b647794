#pragma once

#include <array>

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// A picture's channels as an sRGB display is sent them, in [0, 1]; what lies beyond is cut.
[[nodiscard]] std::array<Plane, 3> encoded_channels(const render::LinearPicture& picture,
                                                    const RowWork& work);

}  // namespace gazeloop::quality
