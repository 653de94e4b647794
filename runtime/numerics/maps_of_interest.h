#pragma once

#include <string>
#include <vector>

#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/foveation/log_polar/radial_kernel.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/gaze/view.h"

namespace gazeloop::numerics {

struct NamedKernel {
    std::string name;
    foveation::RadialKernel kernel;
};

/// A kernel of every kind, the power kernels from end to end of alpha's range; `quick`: only a few.
std::vector<NamedKernel> kernels_under_test(bool quick);

/// Asymmetric, as headsets are.
gaze::EyeView headset_view(foveation::ImageSize image);

}  // namespace gazeloop::numerics
