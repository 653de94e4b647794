#pragma once

#include <vector>

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

/// Weights of the pixels around one; an odd number, the middle one is the pixel itself.
using Kernel = std::vector<float>;

/// The plane filtered along rows by one kernel and along columns by another. Beyond its edges it
/// goes on as at them.
[[nodiscard]] Plane convolved(const Plane& plane, const Kernel& along_rows,
                              const Kernel& along_columns, const RowWork& work);

}  // namespace gazeloop::quality
